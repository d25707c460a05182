//! Which schemes and methods go together, and what holds of those that do.
//!
//! One table says it. What it refuses is refused when a [`Subdivider`](super::Subdivider) is made, with its reason; what it
//! promises is tested for every pair and every criterion. Criteria are no part of it, as any method takes whatever
//! they answer with.

use std::fmt;

use crate::accuracy::Accuracy;
use crate::adaptive::Incremental;
use crate::error::ConfigError;
use crate::scheme::AnyScheme;

/// One of the methods, chosen while the program runs.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum AnyMethod {
    /// [`Uniform`](crate::adaptive::Uniform).
    Uniform,
    /// [`Simple`](crate::adaptive::Simple).
    Simple,
    /// [`Incremental`].
    Incremental(Incremental),
    /// [`Subdivider::red_green`](super::Subdivider::red_green).
    RedGreen,
    /// [`Subdivider::red_green_restricted`](super::Subdivider::red_green_restricted).
    RedGreenRestricted,
    /// [`Subdivider::dynamic`](super::Subdivider::dynamic).
    Dynamic,
    /// [`Subdivider::mobile`](super::Subdivider::mobile).
    Mobile(Accuracy),
}

impl AnyMethod {
    /// The words for all of them.
    pub const NAMES: [&str; TABLE.len()] = {
        let mut names = [""; TABLE.len()];
        let mut k = 0;
        while k < TABLE.len() {
            names[k] = TABLE[k].0;
            k += 1;
        }
        names
    };

    /// The method of this name; of *incremental* with a hyphen and the number of rings behind it, if they are not one.
    ///
    /// ```
    /// use vvmesh::subdivide::AnyMethod;
    /// assert_eq!(AnyMethod::named("incremental-2", None)?.to_string(), "incremental-2");
    /// assert_eq!(AnyMethod::named("incremental", None)?, AnyMethod::named("incremental-1", None)?);
    /// assert!(AnyMethod::named("mobile", None).is_err());
    /// # Ok::<(), vvmesh::error::ConfigError>(())
    /// ```
    ///
    /// # Errors
    /// For another name, for no ring, and without an accuracy for *mobile*, which reads it alone.
    pub fn named(name: &str, accuracy: Option<Accuracy>) -> Result<Self, ConfigError> {
        let rings = name.strip_prefix("incremental-").and_then(|rings| rings.parse().ok());
        Ok(match name {
            "uniform" => Self::Uniform,
            "simple" => Self::Simple,
            "incremental" => Self::Incremental(Incremental::new(1)?),
            "red-green" => Self::RedGreen,
            "red-green-restricted" => Self::RedGreenRestricted,
            "dynamic" => Self::Dynamic,
            "mobile" => Self::Mobile(accuracy.ok_or_else(|| ConfigError {
                name: "accuracy",
                value: "none".into(),
                expected: "a distance from the limit; `mobile` moves what is farther from it".into(),
            })?),
            _ => match rings {
                Some(rings) => Self::Incremental(Incremental::new(rings)?),
                None => return Err(unknown(name)),
            },
        })
    }

    /// The word for it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Simple => "simple",
            Self::Incremental(_) => "incremental",
            Self::RedGreen => "red-green",
            Self::RedGreenRestricted => "red-green-restricted",
            Self::Dynamic => "dynamic",
            Self::Mobile(_) => "mobile",
        }
    }
}

/// As [`AnyMethod::named`] reads it, always with the number of rings.
impl fmt::Display for AnyMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Incremental(method) => write!(f, "incremental-{}", method.rings()),
            _ => f.write_str(self.name()),
        }
    }
}

/// What holds of a scheme with a method, for any selections; the mesh conforms in any case.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Promise {
    /// The mesh is that of uniform refinement.
    Uniform,
    /// Each selected vertex has the position and the neighbours of uniform refinement, bit for bit, if each selection lies in
    /// the one that follows the step before.
    Selected,
    /// Every vertex is where uniform refinement of some number of levels has it, bit for bit.
    Levels,
    /// The same but for rounding.
    NearlyLevels,
    /// What the [certificate](crate::certify) names is that of uniform refinement, bit for bit.
    Certified,
    /// What may move and is farther from its limit than asked for moves, and nothing else does.
    Accuracy,
}

/// What the table has for a pair: a promise, or why there is none.
type Cell = Result<Promise, &'static str>;

const UNBISECTED: Cell =
    Err("one that splits triangles in four; the triangles of this one conform without being bisected");
const ON_ITS_LIMIT: Cell =
    Err("the limit is known to be near under `loop` alone; this one leaves every vertex on it from the \
                                start, so none would ever be mobile");
const OTHER_FACES: Cell = Err("the four cases are those of faces that `loop` splits in four");

/// For every method what holds of it with each scheme, in the order of [`AnyScheme::NAMES`].
const TABLE: [(&str, [Cell; AnyScheme::NAMES.len()]); 7] = {
    use Promise::{Accuracy, Certified, Levels, NearlyLevels, Selected, Uniform};
    [
        ("uniform", [Ok(Uniform); 6]),
        ("simple", by_split(Ok(Certified), Ok(NearlyLevels), Ok(Levels))),
        ("incremental", [Ok(Selected); 6]),
        ("red-green", by_split(Ok(Certified), UNBISECTED, UNBISECTED)),
        ("red-green-restricted", by_split(Ok(Levels), UNBISECTED, UNBISECTED)),
        ("dynamic", by_split(Ok(Levels), UNBISECTED, UNBISECTED)),
        ("mobile", [Ok(Accuracy), ON_ITS_LIMIT, ON_ITS_LIMIT, ON_ITS_LIMIT, OTHER_FACES, OTHER_FACES]),
    ]
};

/// A row in which all schemes that split in four are alike.
const fn by_split(in_four: Cell, sqrt3: Cell, four_eight: Cell) -> [Cell; 6] {
    [in_four, in_four, in_four, in_four, sqrt3, four_eight]
}

/// What holds of a scheme with the method of this name, without rings or accuracy.
///
/// ```
/// use vvmesh::scheme::{Loop, Sqrt3};
/// use vvmesh::subdivide::{Promise, promise};
/// assert_eq!(promise(&Loop::default().into(), "incremental"), Ok(Promise::Selected));
/// let refused = promise(&Sqrt3::default().into(), "mobile").unwrap_err();
/// assert!(refused.to_string().starts_with("scheme = sqrt3: "));
/// ```
///
/// # Errors
/// If they do not go together, with the reason, and for another name.
pub fn promise(scheme: &AnyScheme, method: &str) -> Result<Promise, ConfigError> {
    let (_, row) = TABLE.iter().find(|(name, _)| *name == method).ok_or_else(|| unknown(method))?;
    let cells = AnyScheme::NAMES.iter().zip(row);
    let cell = cells.filter(|(name, _)| **name == scheme.name()).map(|(_, cell)| *cell).next();
    let refusal = |reason: &str| ConfigError { name: "scheme", value: scheme.name().into(), expected: reason.into() };
    cell.expect("every scheme has a column").map_err(refusal)
}

fn unknown(name: &str) -> ConfigError {
    ConfigError { name: "method", value: name.into(), expected: format!("one of {}", AnyMethod::NAMES.join(", ")) }
}
