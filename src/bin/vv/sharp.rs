//! Sharp edges and corners of the input: by angle, or from a file.

use std::path::Path;

use vvmesh::mesh::BoundaryPolicy;
use vvmesh::query::measure::{angle_between_rad, triangle_normal};
use vvmesh::{Edge, Mesh, VertexId};

use crate::args::{BoundaryName, TagArguments};
use crate::console::{Failure, note, refuse};
use crate::table::count;

/// Tags a mesh that was read: corners by the boundary policy, sharp edges by angle or from a file.
pub(crate) fn tag(mesh: &mut Mesh, arguments: &TagArguments) -> Result<(), Failure> {
    mesh.apply_boundary_policy(match arguments.boundary {
        None | Some(BoundaryName::Smooth) => BoundaryPolicy::Smooth,
        Some(BoundaryName::Corners) => BoundaryPolicy::Corners,
        Some(BoundaryName::Fixed) => BoundaryPolicy::Fixed,
    });
    if let Some(degrees) = arguments.sharp_angle {
        let sharp = by_angle(mesh, degrees);
        note(format_args!("{} sharp, folded by more than {degrees} degrees", count(sharp, "edge is", "edges are")));
    }
    arguments.sharp.as_deref().map_or(Ok(()), |path| from_file(mesh, path))
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

/// Tags what a file names: lines `a b` or `a b inf` an edge, lines `a` a corner; `#` starts a comment.
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
    let (a, b) = match *words {
        [] => return Ok(()),
        [a] => {
            let a = vertex(mesh, a)?;
            mesh.set_corner(a, true);
            return Ok(());
        }
        [a, b] => (a, b),
        [a, b, s] => {
            sharpness(s)?;
            (a, b)
        }
        _ => return Err(format!("expected `a b`, `a b inf` or `a`, found {} words", words.len())),
    };
    let [a, b] = [vertex(mesh, a)?, vertex(mesh, b)?];
    if a == b {
        return Err(format!("the edge runs from vertex {0} to itself; a corner is a line `{0}`", a.index()));
    }
    if !mesh.set_sharp(Edge::new(a, b), true) {
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

/// Edges are infinitely sharp, or not at all.
fn sharpness(word: &str) -> Result<(), String> {
    match word.parse::<f64>() {
        Ok(s) if s == f64::INFINITY => Ok(()),
        Ok(s) if s.is_finite() => {
            Err(format!("finite sharpness ({word}) is not supported; leave the number out, or write `inf`"))
        }
        _ => Err(format!("expected the sharpness `inf`, found `{word}`")),
    }
}
