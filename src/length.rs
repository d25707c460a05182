//! Lengths, in the unit of a mesh or relative to its size.
//!
//! **Deliberately not here**: measuring them on a mesh.

use std::fmt;

use crate::error::ConfigError;
use crate::number::shortest;

/// A length, finite and at least 0: absolute, or as a part of the diagonal of a bounding box.
///
/// It prints as it was given.
///
/// ```
/// use vvmesh::Length;
/// let (absolute, relative) = (Length::absolute(0.5)?, Length::percent(0.1)?);
/// assert_eq!((absolute.distance(|| 40.0), relative.distance(|| 40.0)), (0.5, 0.04));
/// assert_eq!((absolute.to_string(), relative.to_string()), ("0.5".to_owned(), "0.1%".to_owned()));
/// # Ok::<(), vvmesh::error::ConfigError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Length(Measure);

#[derive(Clone, Copy, PartialEq, Debug)]
enum Measure {
    Absolute(f64),
    Percent(f64),
}

impl Length {
    /// A length in the unit of the positions.
    ///
    /// # Errors
    /// If it is not finite, or below 0.
    pub fn absolute(length: f64) -> Result<Self, ConfigError> {
        sound("length", length).map(|length| Self(Measure::Absolute(length)))
    }

    /// So many hundredths of the diagonal of the bounding box.
    ///
    /// # Errors
    /// If the number is not finite, or below 0.
    pub fn percent(percent: f64) -> Result<Self, ConfigError> {
        sound("percent", percent).map(|percent| Self(Measure::Percent(percent)))
    }

    /// The length in the unit of the positions; the diagonal is asked for only if it is needed.
    #[must_use]
    pub fn distance(self, diagonal: impl FnOnce() -> f64) -> f64 {
        match self.0 {
            Measure::Absolute(length) => length,
            Measure::Percent(percent) => percent * diagonal() / 100.0,
        }
    }
}

fn sound(name: &'static str, number: f64) -> Result<f64, ConfigError> {
    if number.is_finite() && number >= 0.0 {
        return Ok(number);
    }
    Err(ConfigError { name, value: shortest(number), expected: "expected a finite number, 0 or more".into() })
}

/// In the shortest digits that read back as the same.
impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Measure::Absolute(length) => f.write_str(&shortest(length)),
            Measure::Percent(percent) => write!(f, "{}%", shortest(percent)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_length_is_refused() {
        for number in [-1e-300, f64::NAN, f64::INFINITY] {
            assert!(Length::absolute(number).is_err() && Length::percent(number).is_err(), "{number}");
        }
        assert_eq!(Length::percent(250.0).map(|length| length.distance(|| 2.0)), Ok(5.0));
    }
}
