//! A distance from the limit surface that is asked for.
//!
//! **Deliberately not here**: measuring it, or refining until it is reached.

use crate::error::ConfigError;

/// How near to the limit surface is near enough: a distance, finite and above 0.
///
/// ```
/// use vvmesh::Accuracy;
/// assert_eq!(Accuracy::new(0.05)?.distance(), 0.05);
/// assert!([0.0, -1.0, f64::NAN, f64::INFINITY].into_iter().all(|distance| Accuracy::new(distance).is_err()));
/// # Ok::<(), vvmesh::error::ConfigError>(())
/// ```
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Accuracy(f64);

impl Accuracy {
    /// The accuracy of this distance.
    ///
    /// # Errors
    /// If it is not above 0, or not finite: a limit is reached by no number of steps.
    pub fn new(distance: f64) -> Result<Self, ConfigError> {
        if distance > 0.0 && distance.is_finite() {
            return Ok(Self(distance));
        }
        Err(ConfigError { name: "accuracy", value: distance.to_string(), expected: "a finite distance above 0".into() })
    }

    /// The finest accuracy that passes a test, provided that every coarser one passes then too; `None` if none passes. At
    /// most 64 are tried.
    ///
    /// ```
    /// use vvmesh::Accuracy;
    /// let finest = Accuracy::finest(|accuracy| accuracy.distance() >= 0.1).unwrap();
    /// assert_eq!(finest.distance(), 0.1);
    /// ```
    #[must_use]
    pub fn finest(passes: impl Fn(Self) -> bool) -> Option<Self> {
        // Numbers above 0 are ordered as their bits are.
        let accuracy = |bits: u64| Self(f64::from_bits(bits));
        let (mut finer, mut found) = (0, f64::MAX.to_bits());
        if !passes(accuracy(found)) {
            return None;
        }
        while found - finer > 1 {
            let middle = finer + (found - finer) / 2;
            *(if passes(accuracy(middle)) { &mut found } else { &mut finer }) = middle;
        }
        Some(accuracy(found))
    }

    /// The distance.
    #[must_use]
    pub fn distance(self) -> f64 {
        self.0
    }
}
