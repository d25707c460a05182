//! Sharp edges and corners of the input: by angle, or from a file.

use std::fmt::Display;
use std::path::Path;

use vvmesh::io::ObjTags;
use vvmesh::mesh::{BoundaryPolicy, Sharpness, SharpnessRule};
use vvmesh::query::measure::{angle_between_rad, triangle_normal};
use vvmesh::{Edge, Mesh, VertexId};

use crate::args::{BoundaryName, CreasesName, TagArguments};
use crate::console::{Failure, note, refuse};
use crate::input;
use crate::table::count;

/// Tags a mesh that was read from a file: what its tag lines say, then what the options say, which win. Answers with the
/// boundary policy.
pub(crate) fn tag(
    mesh: &mut Mesh,
    file: &Path,
    lines: Option<&ObjTags>,
    arguments: &TagArguments,
) -> Result<BoundaryName, Failure> {
    mesh.set_sharpness_rule(match arguments.creases {
        None | Some(CreasesName::Uniform) => SharpnessRule::Uniform,
        Some(CreasesName::Chaikin) => SharpnessRule::Chaikin,
    });
    let policy = match arguments.boundary {
        Some(BoundaryName::Smooth) => BoundaryPolicy::Smooth,
        Some(BoundaryName::Corners) => BoundaryPolicy::Corners,
        Some(BoundaryName::Fixed) => BoundaryPolicy::Fixed,
        None => lines.and_then(|tags| tags.boundary).unwrap_or_default(),
    };
    if let Some(tags) = lines {
        tags.put_on(mesh).map_err(|error| input::at_line_of(file, error))?;
    }
    mesh.apply_boundary_policy(policy);
    if let Some(degrees) = arguments.sharp_angle {
        let sharp = by_angle(mesh, degrees);
        note(format_args!("{} sharp, folded by more than {degrees} degrees", count(sharp, "edge is", "edges are")));
    }
    if let Some(path) = &arguments.sharp {
        from_file(mesh, path)?;
    }
    Ok(match policy {
        BoundaryPolicy::Smooth => BoundaryName::Smooth,
        BoundaryPolicy::Corners => BoundaryName::Corners,
        BoundaryPolicy::Fixed => BoundaryName::Fixed,
    })
}

/// Refuses semi-sharp tags under a scheme whose masks cannot be blended.
pub(crate) fn refuse_unblended(mesh: &Mesh, blends_sharpness: bool, scheme: impl Display) -> Result<(), Failure> {
    if mesh.tags().has_semi_sharp() && !blends_sharpness {
        return refuse(format!(
            "--scheme {scheme} cannot blend masks: give every edge and vertex the sharpness `inf` or 0"
        ));
    }
    Ok(())
}

/// Tags every edge sharp whose two triangles are folded by more than an angle. Answers how many there are.
fn by_angle(mesh: &mut Mesh, degrees: f64) -> usize {
    let normal = |a, b, c| triangle_normal([a, b, c].map(|v| mesh.position(v)));
    let mut sharp = Vec::new();
    for a in mesh.vertices() {
        let ring = mesh.ring(a);
        // By slots, as searching the ring for each neighbour is quadratic in the valence.
        for (slot, &b) in ring.neighbors().iter().enumerate().filter(|&(_, &b)| a < b) {
            let (Some(left), Some(right)) = (ring.slot_after(slot), ring.slot_before(slot)) else { continue };
            let [left, right] = [left, right].map(|slot| ring.neighbors()[slot]);
            let normals = normal(a, b, left).zip(normal(b, a, right));
            if normals.is_some_and(|(n, m)| angle_between_rad(n, m).to_degrees() > degrees) {
                sharp.push(Edge::new(a, b));
            }
        }
    }
    for &edge in &sharp {
        mesh.set_sharp(edge, true);
    }
    sharp.len()
}

/// Tags what a file names: lines `a b` or `a b s` an edge, `a` a corner, `a - s` a vertex, where `s` is a sharpness; `#`
/// starts a comment. A tag replaces the one before.
fn from_file(mesh: &mut Mesh, path: &Path) -> Result<(), Failure> {
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) => return refuse(format!("--sharp: {}: {error}", path.display())),
    };
    for (k, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words: Vec<&str> = line.split_whitespace().collect();
        tag_line(mesh, &words).map_err(|message| Failure(format!("{}:{}: {message}", path.display(), k + 1)))?;
    }
    Ok(())
}

fn tag_line(mesh: &mut Mesh, words: &[&str]) -> Result<(), String> {
    let (a, b, sharpness) = match *words {
        [] => return Ok(()),
        [a] => {
            let a = vertex(mesh, a)?;
            mesh.set_corner(a, true);
            return Ok(());
        }
        [a, "-", s] => {
            let a = vertex(mesh, a)?;
            mesh.set_vertex_sharpness(a, sharpness(s)?);
            return Ok(());
        }
        [a, b] => (a, b, Sharpness::INFINITE),
        [a, b, s] => (a, b, sharpness(s)?),
        _ => return Err(format!("expected `a b`, `a b s`, `a` or `a - s`, found {} words", words.len())),
    };
    let [a, b] = [vertex(mesh, a)?, vertex(mesh, b)?];
    if a == b {
        return Err(format!(
            "the edge runs from vertex {0} to itself; a vertex is a line `{0}` or `{0} - s`",
            a.index()
        ));
    }
    if !mesh.set_sharpness(Edge::new(a, b), sharpness) {
        return Err(format!("there is no edge between vertices {} and {}", a.index(), b.index()));
    }
    Ok(())
}

/// The vertex that a word names.
fn vertex(mesh: &Mesh, word: &str) -> Result<VertexId, String> {
    // A number too great for the machine names no vertex either.
    if word.is_empty() || !word.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(format!("expected the id of a vertex, found `{word}`"));
    }
    let id = word.parse().ok().filter(|&id: &usize| id < mesh.vertex_count());
    id.map(VertexId::new).ok_or_else(|| format!("there is no vertex {word}: the mesh has {}", mesh.vertex_count()))
}

fn sharpness(word: &str) -> Result<Sharpness, String> {
    let number = word.parse().ok().and_then(|number| Sharpness::new(number).ok());
    number.ok_or_else(|| format!("expected a sharpness, 0 (smooth) or more or `inf`, found `{word}`"))
}
