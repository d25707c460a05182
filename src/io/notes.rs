//! What a reader did beside reading: things ignored, things kept that no mesh holds.

use std::fmt;

use super::Format;

/// One thing that a reader ignored or set aside.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Note {
    /// What it is.
    pub kind: NoteKind,
    /// How often it stands in the file.
    pub count: usize,
    /// The line, from 1, where it stands first; 0 if there are no lines.
    pub line: usize,
}

/// What a [`Note`] is about.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum NoteKind {
    /// OBJ: tag lines `t ...` (sharp edges, corners and boundary rules of OpenSubdiv), ignored unless the caller has
    /// [their lines](super::TagLines) read.
    Tags,
    /// OBJ: polylines `l ...`, ignored.
    Polylines,
    /// OBJ: points `p ...`, ignored.
    Points,
    /// OBJ: curves and surfaces of free form, ignored.
    FreeForm,
    /// OBJ: a fourth coordinate, the weight of rational surfaces; without meaning for polygons, ignored.
    Weights,
    /// OBJ: how to draw faces or cut them finer (`mg`, `lod`, `usemap` and the like), ignored; PLY: the file of a picture.
    Rendering,
    /// OBJ, and the header of PLY: statements that are none of the format, ignored; the first of them.
    Unknown(String),
    /// Colours of vertices: of OBJ and PLY kept among the attributes, of OFF ignored.
    VertexColors {
        /// Whether they are among the attributes.
        kept: bool,
    },
    /// OFF: normals of vertices, ignored.
    VertexNormals,
    /// OFF: texture coordinates of vertices, ignored.
    VertexTexture,
    /// OFF: colours of faces, ignored.
    FaceColors,
    /// PLY: properties without a place here, ignored.
    Properties {
        /// What has them: `vertex` or `face`.
        of: &'static str,
        /// Their names.
        names: Vec<String>,
    },
    /// PLY: an element that is neither vertex nor face, ignored: its name.
    Element(String),
    /// STL: corners of triangles, welded to one vertex where their positions are equal.
    Welded {
        /// How many vertices they are now.
        vertices: usize,
    },
    /// STL: normals of triangles, ignored.
    FaceNormals,
    /// STL: attribute bytes of triangles that are not 0, ignored.
    AttributeBytes,
    /// STL: solids, read as one.
    Solids,
    /// OFF: the word `OFF` is missing at the start.
    NoHeader,
    /// The ending of the name says another format than the content: the latter.
    Ending(Format),
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, count, line } = self;
        let many = |one: &'static str, many: &'static str| if *count == 1 { one } else { many };
        match kind {
            NoteKind::Tags => write!(f, "{count} tag {} ignored", many("line 't'", "lines 't'"))?,
            NoteKind::Polylines => write!(f, "{count} {} ignored", many("polyline", "polylines"))?,
            NoteKind::Points => write!(f, "{count} {} of points ignored", many("line", "lines"))?,
            NoteKind::FreeForm => write!(f, "{count} {} of free-form geometry ignored", many("line", "lines"))?,
            NoteKind::Rendering => write!(f, "{count} rendering {} ignored", many("statement", "statements"))?,
            NoteKind::Weights => write!(f, "fourth coordinate of {count} {} ignored", many("vertex", "vertices"))?,
            NoteKind::Unknown(first) => {
                write!(f, "{count} unknown {} ignored, first '{first}'", many("statement", "statements"))?;
            }
            NoteKind::VertexColors { kept } => {
                let done = if *kept { "kept as attributes" } else { "ignored" };
                write!(f, "colours of {count} {} {done}", many("vertex", "vertices"))?;
            }
            NoteKind::VertexNormals => write!(f, "normals of {count} {} ignored", many("vertex", "vertices"))?,
            NoteKind::VertexTexture => {
                write!(f, "texture coordinates of {count} {} ignored", many("vertex", "vertices"))?;
            }
            NoteKind::FaceColors => write!(f, "colours of {count} {} ignored", many("face", "faces"))?,
            NoteKind::Properties { of, names } => {
                let of = match *of {
                    "face" => many("face", "faces"),
                    _ => many("vertex", "vertices"),
                };
                let property = if names.len() == 1 { "property" } else { "properties" };
                return write!(f, "{property} '{}' of {count} {of} ignored (line {line})", names.join("', '"));
            }
            NoteKind::Element(name) => {
                return write!(f, "element '{name}' with {count} {} ignored (line {line})", many("row", "rows"));
            }
            NoteKind::Welded { vertices } => {
                return write!(f, "{count} corners welded to {vertices} vertices where their positions are equal");
            }
            NoteKind::FaceNormals => return write!(f, "normals of {count} {} ignored", many("face", "faces")),
            NoteKind::AttributeBytes => {
                return write!(f, "attribute bytes of {count} {} ignored", many("face", "faces"));
            }
            NoteKind::Solids => return write!(f, "{count} solids read as one"),
            NoteKind::NoHeader => return write!(f, "the word OFF is missing at the start; read as OFF all the same"),
            NoteKind::Ending(format) => {
                return write!(f, "the content is {format}, whatever the ending says; read as {format}");
            }
        }
        write!(f, " (line {line}{})", many("", " on"))
    }
}

/// Counts one more of a kind. There are few kinds, so a search is cheaper than a map.
pub(super) fn count(notes: &mut Vec<Note>, kind: NoteKind, line: usize) {
    match notes.iter_mut().find(|note| std::mem::discriminant(&note.kind) == std::mem::discriminant(&kind)) {
        Some(note) => note.count += 1,
        None => notes.push(Note { kind, count: 1, line }),
    }
}
