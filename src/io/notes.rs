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
    /// The line, from 1, where it stands first.
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
    /// OBJ: how to draw faces or cut them finer (`mg`, `lod`, `usemap` and the like), ignored.
    Rendering,
    /// OBJ: statements that are none of the format, ignored; the first of them.
    Unknown(String),
    /// Colours of vertices: of OBJ kept among the attributes, of OFF ignored.
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
