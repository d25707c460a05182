//! Tag lines of OBJ files: how sharp edges and vertices are, and what becomes of the boundary.
//!
//! ```text
//! t crease 2/1/0 V1 V2 S              an edge, by two vertices, and its sharpness
//! t corner 1/1/0 V S                  a vertex and its sharpness
//! t interpolateboundary 1/0/0 K       K = 1: tips of single triangles are corners; 2: the boundary is a smooth curve
//! ```
//!
//! The second word says how many whole numbers, numbers and words follow. Vertices are counted from 0, other than in `f`
//! lines. Writers of such lines have no word for infinity: a sharpness of 10 and more means it.

use super::notes::{self, Note, NoteKind};
use super::text::{Words, float, integer, shown};
use crate::error::{ReadError, ReadErrorKind};
use crate::id::{Edge, VertexId};
use crate::mesh::{BoundaryPolicy, Mesh, Sharpness};

/// From this sharpness on a tag line means infinitely sharp.
const INFINITE_FROM: f64 = 10.0;

const CREASE: &str = "'t crease 2/1/0 V1 V2 S' with vertices counted from 0 and a sharpness";
const CORNER: &str = "'t corner 1/1/0 V S' with a vertex counted from 0 and a sharpness";
const SHARPNESS: &str = "a sharpness, 0 (smooth) or more";
const BOUNDARY: &str = "'t interpolateboundary 1/0/0 K' with 1 (edges and corners) or 2 (edges only)";

/// The tag lines of a file as they stand in it, for whoever wants them: see [`TagLines::parse`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TagLines {
    /// What follows the `t`, with the number of the line.
    lines: Vec<(usize, String)>,
}

/// What tag lines say.
///
/// ```
/// use vvmesh::{Edge, Mesh, VertexId, io};
/// let file = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nt crease 2/1/0 0 2 1.5\n";
/// let loaded = io::read_obj(file)?;
/// let mut mesh = Mesh::from_face_list(&loaded.faces)?;
/// loaded.tag_lines.parse()?.put_on(&mut mesh)?;
/// let edge = Edge::new(VertexId::new(0), VertexId::new(2));
/// assert_eq!(mesh.tags().sharpness(edge).value(), 1.5);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjTags {
    /// What becomes of the boundary, if a line says it.
    pub boundary: Option<BoundaryPolicy>,
    /// Tags of other names, which are ignored.
    pub notes: Vec<Note>,
    /// Edges in the order of the file.
    creases: Vec<Tag<2>>,
    corners: Vec<Tag<1>>,
}

#[derive(Clone, Debug, PartialEq)]
struct Tag<const VERTICES: usize> {
    line: usize,
    vertices: [i64; VERTICES],
    sharpness: Sharpness,
}

impl TagLines {
    /// Whether the file has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Reads the lines.
    ///
    /// # Errors
    /// With the line: a tag of a known name that is not of the form it should be, or a sharpness that is none.
    pub fn parse(&self) -> Result<ObjTags, ReadError> {
        let mut tags = ObjTags::default();
        for (line, text) in &self.lines {
            tags.line(text, *line).map_err(|kind| ReadError::at(*line, kind))?;
        }
        Ok(tags)
    }

    pub(super) fn push(&mut self, line: usize, text: String) {
        self.lines.push((line, text));
    }
}

impl ObjTags {
    /// Tags a mesh of the faces of the same file, in the order of the lines; polygons may have been cut since. The
    /// boundary is left to [`Mesh::apply_boundary_policy`].
    ///
    /// # Errors
    /// With the line: a vertex or an edge that the mesh does not have. Tags of lines above are on the mesh then.
    pub fn put_on(&self, mesh: &mut Mesh) -> Result<(), ReadError> {
        for &Tag { line, vertices, sharpness } in &self.creases {
            let [a, b] = existing(mesh, vertices, line)?;
            if a == b || !mesh.set_sharpness(Edge::new(a, b), sharpness) {
                return Err(ReadError::at(line, ReadErrorKind::NoEdge([a, b])));
            }
        }
        for &Tag { line, vertices, sharpness } in &self.corners {
            let [v] = existing(mesh, vertices, line)?;
            mesh.set_vertex_sharpness(v, sharpness);
        }
        Ok(())
    }

    fn line(&mut self, text: &str, line: usize) -> Result<(), ReadErrorKind> {
        let words: Vec<&[u8]> = Words::new(text.as_bytes()).collect();
        let malformed = |expected| ReadErrorKind::Tag { expected, found: format!("t {}", shown(text.as_bytes())) };
        match words[..] {
            [b"crease", b"2/1/0", a, b, s] => {
                let vertices = [integer(a)?, integer(b)?];
                self.creases.push(Tag { line, vertices, sharpness: sharpness(s)? });
            }
            [b"corner", b"1/1/0", v, s] => {
                self.corners.push(Tag { line, vertices: [integer(v)?], sharpness: sharpness(s)? });
            }
            [b"interpolateboundary", b"1/0/0", b"1"] => self.boundary = Some(BoundaryPolicy::Corners),
            [b"interpolateboundary", b"1/0/0", b"2"] => self.boundary = Some(BoundaryPolicy::Smooth),
            [b"crease", ..] => return Err(malformed(CREASE)),
            [b"corner", ..] => return Err(malformed(CORNER)),
            [b"interpolateboundary", ..] => return Err(malformed(BOUNDARY)),
            [name, ..] => notes::count(&mut self.notes, NoteKind::Unknown(format!("t {}", shown(name))), line),
            [] => notes::count(&mut self.notes, NoteKind::Unknown("t".into()), line),
        }
        Ok(())
    }
}

fn sharpness(word: &[u8]) -> Result<Sharpness, ReadErrorKind> {
    let malformed = |_| ReadErrorKind::Tag { expected: SHARPNESS, found: shown(word) };
    let sharpness = Sharpness::new(float(word)?).map_err(malformed)?;
    Ok(if sharpness.value() >= INFINITE_FROM { Sharpness::INFINITE } else { sharpness })
}

fn existing<const N: usize>(mesh: &Mesh, vertices: [i64; N], line: usize) -> Result<[VertexId; N], ReadError> {
    let count = mesh.vertex_count();
    for index in vertices {
        if usize::try_from(index).is_ok_and(|index| index < count) {
            continue;
        }
        let of = "vertex (counted from 0)";
        return Err(ReadError::at(line, ReadErrorKind::IndexOutOfRange { of, index, count }));
    }
    Ok(vertices.map(|index| VertexId::new(index as usize)))
}
