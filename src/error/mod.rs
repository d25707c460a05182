//! All error types, one file a stage.
//!
//! Each says what was expected, what was found and what to do, and names the place: a line, a vertex, a face, an edge.
//!
//! **Deliberately not here**: findings of [`crate::check`]; those are data, not errors.

mod build;
mod edit;
mod predict;
mod read;
mod refine;
mod select;
mod write;

pub use build::{BuildError, Defect, DefectKind};
pub use edit::{EditError, RingDefect};
pub use predict::PredictError;
pub use read::{ReadError, ReadErrorKind};
pub use refine::{ConfigError, RefineError};
pub use select::{ExpressionError, ExpressionErrorKind, SelectError};
pub use write::{WriteError, WriteErrorKind};

use std::fmt;

/// Any error of this crate, by the stage it comes from.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    Read(ReadError),
    /// Faces do not make a mesh.
    Build(BuildError),
    /// A local edit is not possible.
    Edit(EditError),
    /// Parameters do not make sense.
    Config(ConfigError),
    /// A selection given as text has no meaning.
    Expression(ExpressionError),
    /// A criterion could not be applied to a mesh.
    Select(SelectError),
    /// A refinement step was not made.
    Refine(RefineError),
    /// Nothing can be foretold of a mesh.
    Predict(PredictError),
    /// A file could not be written.
    Write(WriteError),
}

macro_rules! stages {
    ($($stage:ident: $error:ident),*) => {
        $(impl From<$error> for Error {
            fn from(error: $error) -> Self {
                Self::$stage(error)
            }
        })*

        impl fmt::Display for Error {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self { $(Self::$stage(error) => error.fmt(f)),* }
            }
        }

        impl std::error::Error for Error {
            fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
                match self { $(Self::$stage(error) => error.source()),* }
            }
        }
    };
}

stages!(
    Read: ReadError,
    Build: BuildError,
    Edit: EditError,
    Config: ConfigError,
    Expression: ExpressionError,
    Select: SelectError,
    Refine: RefineError,
    Predict: PredictError,
    Write: WriteError
);
