//! How sharp an edge or a vertex is, and how that fades from step to step.

use std::fmt;

use crate::error::ConfigError;

/// How sharp an edge or a vertex is: 0 is smooth, infinite stays sharp for ever, anything between is *semi-sharp*.
///
/// A step treats what has a sharpness of 1 and more as sharp, and blends smooth and sharp rules below; what it makes of
/// it has 1 less. So an edge of sharpness s is a crease for ⌊s⌋ steps, and a smooth surface with a narrow bend in the end.
///
/// ```
/// use vvmesh::mesh::Sharpness;
/// let sharpness = Sharpness::new(1.5)?;
/// assert_eq!((sharpness.value(), sharpness.weight(), sharpness.steps()), (1.5, 1.0, 2));
/// assert!(Sharpness::new(f64::INFINITY)? == Sharpness::INFINITE);
/// assert!(Sharpness::new(-1.0).is_err() && Sharpness::new(f64::NAN).is_err());
/// # Ok::<(), vvmesh::error::ConfigError>(())
/// ```
///
/// Source: `[derose1998]`, section 3.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug, Default)]
pub struct Sharpness(f64);

impl Sharpness {
    /// Not sharp at all.
    pub const SMOOTH: Self = Self(0.0);
    /// Sharp in every step.
    pub const INFINITE: Self = Self(f64::INFINITY);

    /// A sharpness of 0 or more, which may be infinite.
    ///
    /// # Errors
    /// If it is negative or no number.
    pub fn new(value: f64) -> Result<Self, ConfigError> {
        if value >= 0.0 {
            // Adding 0 makes 0 of -0.
            return Ok(Self(value + 0.0));
        }
        Err(ConfigError {
            name: "sharpness",
            value: value.to_string(),
            expected: "a number, 0 (smooth) or more, or `inf`".into(),
        })
    }

    /// The number, 0 to infinity.
    #[inline]
    #[must_use]
    pub fn value(self) -> f64 {
        self.0
    }

    /// Whether it is above 0.
    #[inline]
    #[must_use]
    pub fn is_sharp(self) -> bool {
        self.0 > 0.0
    }

    /// Whether it is above 0 and not infinite.
    #[inline]
    #[must_use]
    pub fn is_semi_sharp(self) -> bool {
        self.0 > 0.0 && self.0 < f64::INFINITY
    }

    /// How much of the sharp rule a step takes, 0 to 1; the rest is the smooth rule.
    #[inline]
    #[must_use]
    pub fn weight(self) -> f64 {
        self.0.min(1.0)
    }

    /// What a step leaves of it: 1 less, at least 0.
    #[inline]
    #[must_use]
    pub fn decayed(self) -> Self {
        Self((self.0 - 1.0).max(0.0))
    }

    /// After how many steps nothing is left of it. Infinite and what is too great for the type give the greatest number.
    #[must_use]
    pub fn steps(self) -> u32 {
        self.0.ceil() as u32
    }

    /// The greater of two.
    #[must_use]
    pub(super) fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
}

impl fmt::Display for Sharpness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// What the halves of a semi-sharp edge inherit.
///
/// Infinitely sharp edges, boundary edges among them, and smooth ones hand on what they are under both.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum SharpnessRule {
    /// Both halves have 1 less, at least 0.
    #[default]
    Uniform,
    /// Where sharpness varies along a crease it is evened out as Chaikin's algorithm does: each half takes 3/4 of that of
    /// its edge and 1/4 of the mean of the other semi-sharp edges at its end, less 1. With none there, as
    /// [`SharpnessRule::Uniform`].
    Chaikin,
}

impl SharpnessRule {
    /// The sharpness of the half of an edge at one end, from those of the edge and of the others at that end.
    #[must_use]
    pub fn child(self, edge: Sharpness, others: impl IntoIterator<Item = Sharpness>) -> Sharpness {
        if !edge.is_semi_sharp() {
            return edge;
        }
        if self == Self::Uniform {
            return edge.decayed();
        }
        let semi_sharp = others.into_iter().filter(|other| other.is_semi_sharp());
        let (sum, count) = semi_sharp.fold((0.0, 0), |(sum, count), other| (sum + other.0, count + 1));
        if count == 0 { edge.decayed() } else { Sharpness(0.75 * edge.0 + 0.25 * sum / f64::from(count)).decayed() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sharpness(value: f64) -> Sharpness {
        Sharpness::new(value).expect("a sharpness")
    }

    #[test]
    fn only_numbers_from_zero_on_are_taken() {
        assert_eq!(sharpness(-0.0).value().to_bits(), 0);
        for value in [-1e-300, f64::NEG_INFINITY, f64::NAN] {
            let error = Sharpness::new(value).expect_err("no sharpness");
            assert!(error.to_string().starts_with(&format!("sharpness = {value}: ")), "{error}");
        }
        let steps = [0.0, 0.25, 1.0, 1.5, 1e300, f64::INFINITY].map(|value| sharpness(value).steps());
        assert_eq!(steps, [0, 1, 1, 2, u32::MAX, u32::MAX]);
    }

    #[test]
    fn only_what_is_semi_sharp_fades_and_counts() {
        let others = [0.0, f64::INFINITY, 2.0, 3.0].map(sharpness);
        for rule in [SharpnessRule::Uniform, SharpnessRule::Chaikin] {
            for kept in [Sharpness::SMOOTH, Sharpness::INFINITE] {
                assert_eq!(rule.child(kept, others), kept);
            }
            assert_eq!(rule.child(sharpness(0.5), [sharpness(0.5)]), Sharpness::SMOOTH);
            assert_eq!(rule.child(sharpness(1.5), [Sharpness::INFINITE]), sharpness(0.5));
        }
        assert_eq!(SharpnessRule::Uniform.child(sharpness(4.0), others), sharpness(3.0));
        // 3/4 · 4 + 1/4 · 5/2 - 1
        assert_eq!(SharpnessRule::Chaikin.child(sharpness(4.0), others), sharpness(2.625));
    }
}
