//! Vertices by a value that they carry.

use std::fmt;
use std::sync::Arc;

use super::{Criterion, shortest};
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// How a value is compared with a threshold.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Comparison {
    /// `>`
    Above,
    /// `>=`
    AtLeast,
    /// `<`
    Below,
    /// `<=`
    AtMost,
}

impl Comparison {
    /// All of them; none begins with one that stands before it.
    pub(crate) const ALL: [Self; 4] = [Self::AtLeast, Self::AtMost, Self::Above, Self::Below];

    /// Whether a value is so; NaN never is.
    #[must_use]
    pub fn holds(self, value: f64, threshold: f64) -> bool {
        match self {
            Self::Above => value > threshold,
            Self::AtLeast => value >= threshold,
            Self::Below => value < threshold,
            Self::AtMost => value <= threshold,
        }
    }

    /// Its sign.
    pub(crate) fn sign(self) -> &'static str {
        match self {
            Self::Above => ">",
            Self::AtLeast => ">=",
            Self::Below => "<",
            Self::AtMost => "<=",
        }
    }
}

/// The vertices whose value in a named field compares to a threshold.
///
/// A mesh carries no fields, so the [values](Field::of_values) are given apart, those of a channel of
/// [`Attributes`](crate::attributes::Attributes) for instance; without them nothing can be selected. A value that is NaN, for
/// none, is never selected. In an expression a field has a name alone, and
/// [`with_fields`](crate::select::Expression::with_fields) gives the values.
///
/// Complexity: O(vertices).
///
/// ```
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::{Comparison, Criterion, Field};
/// use vvmesh::{VertexId, shapes};
///
/// let hot = Field::new("heat", Comparison::Above, 20.0)?.of_values([19.0, 20.0, 21.0, f64::NAN]);
/// assert_eq!(hot.select(&shapes::tetrahedron(), &mut Scratch::new())?.vertices(), [VertexId::new(2)]);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Field {
    name: String,
    comparison: Comparison,
    threshold: f64,
    values: Option<Arc<[f64]>>,
}

impl Field {
    /// The vertices at which a field compares to a finite threshold.
    ///
    /// # Errors
    /// If the threshold is not finite.
    pub fn new(name: impl Into<String>, comparison: Comparison, threshold: f64) -> Result<Self, ConfigError> {
        if threshold.is_finite() {
            return Ok(Self { name: name.into(), comparison, threshold, values: None });
        }
        let expected = "expected a finite number".to_owned();
        Err(ConfigError { name: "threshold", value: shortest(threshold), expected })
    }

    /// The same with the values of the field, one a vertex.
    #[must_use]
    pub fn of_values(self, values: impl Into<Arc<[f64]>>) -> Self {
        Self { values: Some(values.into()), ..self }
    }

    /// The name of the field.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
}

impl Criterion for Field {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let vertex_count = mesh.vertex_count();
        let Some(values) = self.values.as_ref().filter(|values| values.len() == vertex_count) else {
            let values = self.values.as_ref().map(|values| values.len());
            return Err(SelectError::NoField { name: self.name.clone(), values, vertex_count });
        };
        Ok(Selection::of_those(vertex_count, |v| self.comparison.holds(values[v.index()], self.threshold)))
    }
}

/// As an expression has it: `field:NAME>VALUE`, with `>`, `>=`, `<` or `<=`.
impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "field:{}{}{}", self.name, self.comparison.sign(), shortest(self.threshold))
    }
}
