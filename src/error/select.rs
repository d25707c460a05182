//! A selection could not be read or made.

use std::fmt;
use std::io;
use std::path::PathBuf;

use super::ConfigError;
use crate::id::{Edge, Triangle, VertexId};

/// A criterion could not be applied to a mesh.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum SelectError {
    /// A criterion names a vertex that the mesh has not.
    NoVertex {
        /// The vertex that was named.
        vertex: VertexId,
        /// How many vertices the mesh has.
        vertex_count: usize,
    },
    /// A criterion names an edge that the mesh has not.
    NoEdge(Edge),
    /// A criterion names a face that the mesh has not.
    NoFace(Triangle),
    /// A criterion names a face by a number that its list has not.
    NoFaceNumber {
        /// The number.
        number: usize,
        /// How many faces are listed.
        face_count: usize,
    },
    /// An expression has one value for each of several levels, and none was chosen.
    NoLevel {
        /// How many values.
        level_count: usize,
    },
    /// A criterion names a field that was not given, or not for this mesh.
    NoField {
        /// The name of the field.
        name: String,
        /// How many values were given, if any were.
        values: Option<usize>,
        /// How many vertices the mesh has.
        vertex_count: usize,
    },
}

impl fmt::Display for SelectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoVertex { vertex, vertex_count } => {
                write!(f, "there is no vertex {}: {}", vertex.index(), there_are(*vertex_count, ["vertex", "vertices"]))
            }
            Self::NoEdge(edge) => write!(f, "there is no edge {edge}"),
            Self::NoFace(face) => write!(f, "there is no face {face}; if there was one, it was split"),
            Self::NoFaceNumber { number, face_count } => {
                write!(f, "there is no face {number}: {}", there_are(*face_count, ["face", "faces"]))
            }
            Self::NoLevel { level_count } => {
                write!(f, "the expression has {level_count} values, one for each level; choose a level")
            }
            Self::NoField { name, values: None, .. } => write!(f, "there is no field `{name}`"),
            Self::NoField { name, values: Some(values), vertex_count } => {
                write!(f, "the field `{name}` is of {values} vertices, the mesh has {vertex_count}")
            }
        }
    }
}

impl std::error::Error for SelectError {}

/// Which ids there are.
fn there_are(count: usize, [one, many]: [&str; 2]) -> String {
    match count {
        0 => format!("the mesh has no {many}"),
        1 => format!("the mesh has 1 {one}, id 0"),
        _ => format!("the mesh has {count} {many}, ids 0 to {}", count - 1),
    }
}

/// What is wrong with a selection that is given as text.
#[derive(Debug)]
#[non_exhaustive]
pub enum ExpressionErrorKind {
    /// Something else should stand here.
    Expected {
        /// What should.
        expected: String,
        /// What does.
        found: String,
    },
    /// There is no criterion of this name.
    UnknownCriterion {
        /// The name.
        name: String,
        /// How the known criteria are written.
        known: Vec<&'static str>,
    },
    /// An argument is not what its criterion takes.
    Value(ConfigError),
    /// A criterion looks through a camera, and there is none.
    NoCamera {
        /// Its name.
        criterion: &'static str,
    },
    /// More parentheses and `!` stand inside each other than allowed.
    TooDeep {
        /// How many are allowed.
        allowed: usize,
    },
    /// A file of ids could not be read.
    File {
        /// The file.
        path: PathBuf,
        /// What the reader said.
        cause: io::Error,
    },
    /// A file of ids holds something else.
    FileLine {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        error: ConfigError,
    },
}

/// A selection given as text has no meaning, and the place at which that was found.
#[derive(Debug)]
pub struct ExpressionError {
    /// The place in the text, in characters, from 1.
    pub column: usize,
    /// What is wrong there.
    pub kind: ExpressionErrorKind,
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "column {}: ", self.column)?;
        match &self.kind {
            ExpressionErrorKind::Expected { expected, found } => write!(f, "expected {expected}, found {found}"),
            ExpressionErrorKind::UnknownCriterion { name, known } => {
                write!(f, "there is no criterion `{name}`; known are `{}`", known.join("`, `"))
            }
            ExpressionErrorKind::Value(error) => error.fmt(f),
            ExpressionErrorKind::NoCamera { criterion } => {
                write!(f, "`{criterion}` looks through a camera, and there is none")
            }
            ExpressionErrorKind::TooDeep { allowed } => {
                write!(f, "at most {allowed} parentheses and `!` may stand inside each other; write fewer")
            }
            ExpressionErrorKind::File { path, cause } => write!(f, "{} could not be read: {cause}", path.display()),
            ExpressionErrorKind::FileLine { path, line, error } => {
                write!(f, "{}, line {line}: {error}", path.display())
            }
        }
    }
}

impl std::error::Error for ExpressionError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.kind {
            ExpressionErrorKind::File { cause, .. } => Some(cause),
            _ => None,
        }
    }
}
