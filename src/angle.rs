//! Angles, so that a number of degrees is never taken for one of radians.
//!
//! **Deliberately not here**: measuring them on a mesh.

use std::fmt;

/// An angle.
///
/// It is kept in degrees, so that a threshold is printed as it was given; [`Angle::from_rad`] rounds.
///
/// ```
/// use vvmesh::Angle;
/// assert_eq!(Angle::from_deg(90.0).rad(), std::f64::consts::FRAC_PI_2);
/// assert_eq!(Angle::from_deg(0.1).to_string(), "0.1°");
/// ```
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub struct Angle {
    degrees: f64,
}

impl Angle {
    /// An angle in degrees.
    #[must_use]
    pub const fn from_deg(degrees: f64) -> Self {
        Self { degrees }
    }

    /// An angle in radians.
    #[must_use]
    pub fn from_rad(radians: f64) -> Self {
        Self { degrees: radians.to_degrees() }
    }

    /// The number of degrees.
    #[must_use]
    pub const fn deg(self) -> f64 {
        self.degrees
    }

    /// The number of radians.
    #[must_use]
    pub fn rad(self) -> f64 {
        self.degrees.to_radians()
    }
}

impl fmt::Display for Angle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}°", self.degrees)
    }
}
