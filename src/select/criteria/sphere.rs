//! Vertices near a point of space.

use std::fmt;

use glam::DVec3;

use super::{Criterion, at_least_0, shortest};
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// What lies in a ball or on its surface.
///
/// Complexity: O(vertices).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sphere {
    center: DVec3,
    radius: f64,
}

impl Sphere {
    /// The ball around a point.
    ///
    /// # Errors
    /// If a coordinate is not finite, or the radius not finite and at least 0.
    pub fn new(center: DVec3, radius: f64) -> Result<Self, ConfigError> {
        if !center.is_finite() {
            let expected = "expected finite coordinates".to_owned();
            return Err(ConfigError { name: "center", value: center.to_string(), expected });
        }
        at_least_0("radius", radius).map(|radius| Self { center, radius })
    }

    fn contains(self, position: DVec3) -> bool {
        let offset = position - self.center;
        // Beyond the enclosing box: also every offset that overflowed.
        if offset.abs().max_element() > self.radius {
            return false;
        }
        // A power of two that changes no digit and keeps the squares of the greatest and least numbers in range.
        let scale = match self.radius {
            tiny if tiny < 1e-100 => 2_f64.powi(600),
            huge if huge > 1e100 => 2_f64.powi(-600),
            _ => 1.0,
        };
        (scale * offset).length() <= scale * self.radius
    }
}

impl Criterion for Sphere {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(Selection::of_those(mesh.vertex_count(), |v| self.contains(mesh.position(v))))
    }
}

/// As an expression has it: `sphere:x,y,z,radius`, in shortest numbers that read back the same.
impl fmt::Display for Sphere {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.center.to_array().map(shortest);
        write!(f, "sphere:{x},{y},{z},{}", shortest(self.radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_belongs_to_the_ball_at_every_size() {
        for radius in [0.0, f64::MIN_POSITIVE, 1e-200, 0.1, 1.0, 3e200, f64::MAX] {
            let ball = Sphere::new(DVec3::ZERO, radius).expect("a sound radius");
            assert!(ball.contains(radius * DVec3::Y), "{radius}");
            assert!(!ball.contains((radius * 1.5).max(1e-320) * DVec3::Y), "{radius}");
        }
        let ball = Sphere::new(DVec3::splat(3e200), 5e200).expect("a sound radius");
        assert!(ball.contains(DVec3::new(6e200, 7e200, 3e200)));
        assert!(!ball.contains(DVec3::new(7e200, 7e200, 3e200)));
        let ball = Sphere::new(DVec3::splat(-f64::MAX), f64::MAX).expect("a sound radius");
        assert!(!ball.contains(DVec3::splat(f64::MAX)));
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        for (center, radius) in [(DVec3::NAN, 1.0), (DVec3::ZERO, f64::NAN), (DVec3::ZERO, -1e-9)] {
            assert!(Sphere::new(center, radius).is_err());
        }
    }
}
