//! A ray, and how it sees a mesh.

use glam::DVec3;

use super::Hit;
use crate::error::ConfigError;
use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::query::measure::corner_positions;

/// Coordinates that are larger have squares that may overflow.
const LARGE: f64 = 1e150;

/// What rounding may move along or across a ray, as a part of the greatest coordinate: a few of the steps of 2⁻⁵³ that each
/// operation on the way takes.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A half-line: a point and a direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray {
    origin: DVec3,
    direction: DVec3,
}

impl Ray {
    /// The ray from a point in a direction of any length but 0.
    ///
    /// # Errors
    /// If a coordinate is not finite, or the direction is zero.
    pub fn new(origin: DVec3, direction: DVec3) -> Result<Self, ConfigError> {
        let refuse = |name, value: DVec3, expected: &str| {
            Err(ConfigError { name, value: value.to_string(), expected: expected.to_owned() })
        };
        if !origin.is_finite() {
            return refuse("origin", origin, "expected finite coordinates");
        }
        // The greatest coordinate becomes 1 first, so no square overflows or vanishes.
        match (direction / direction.abs().max_element()).try_normalize() {
            Some(unit) if direction.is_finite() => Ok(Self { origin, direction: unit }),
            _ => refuse("direction", direction, "expected finite coordinates that are not all 0"),
        }
    }

    /// Where it begins.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Where it goes, of length 1.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// The ray from the same point the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { origin: self.origin, direction: -self.direction }
    }
}

/// A mesh as a ray sees it: sheared, so that the ray is the third axis.
///
/// A position is seen as a rounded point that depends on nothing but the position and the ray. So what is seen of a mesh is a
/// drawing in the plane that fits together at edges and vertices as the mesh does.
pub(super) struct Sight {
    /// By what coordinates are multiplied: a power of two.
    scale: f64,
    origin: DVec3,
    direction: DVec3,
    /// The axis along which the ray goes farthest comes last.
    axes: [usize; 3],
    shear: [f64; 2],
    /// By how much boxes are widened, so that none is passed by of which a face is hit.
    margin: f64,
}

impl Sight {
    /// What a ray sees of a mesh whose coordinates are at most `reach` after multiplying by `scale`; `None` if it begins so far
    /// away that nothing can be told apart.
    pub(super) fn new(ray: &Ray, scale: f64, reach: f64) -> Option<Self> {
        let (origin, direction) = (ray.origin * scale, ray.direction);
        let reach = origin.abs().max_element().max(reach);
        let z = (0..3).max_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs())).unwrap_or(2);
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let shear = [direction[axes[0]] / direction[z], direction[axes[1]] / direction[z]];
        (reach < LARGE).then_some(Self { scale, origin, direction, axes, shear, margin: ROUNDING * reach })
    }

    /// At which distance the ray enters a box, scaled, and widened by what rounding may do; infinite if it does not.
    pub(super) fn entry(&self, lower: [f64; 3], upper: [f64; 3]) -> f64 {
        let (mut near, mut far) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let (origin, direction) = (self.origin[axis], self.direction[axis]);
            let ends = [lower[axis] - self.margin - origin, upper[axis] + self.margin - origin];
            if direction != 0.0 {
                let [first, last] = ends.map(|end| end / direction);
                near = near.max(first.min(last));
                far = far.min(first.max(last));
            } else if ends[0] > 0.0 || ends[1] < 0.0 {
                return f64::INFINITY;
            }
        }
        if near <= far { near } else { f64::INFINITY }
    }

    /// Where the ray meets a face, from either side, at a scaled distance. A face that is seen edge on, or has no area, is not
    /// met; its neighbours are.
    pub(super) fn meet(&self, mesh: &Mesh, face: Triangle) -> Option<Hit> {
        let corners = corner_positions(mesh, face);
        let [a, b, c] = corners.map(|corner| self.see(corner));
        let sides = [side(b, c), side(c, a), side(a, b)];
        if sides.iter().any(|&side| side < 0.0) && sides.iter().any(|&side| side > 0.0) {
            return None;
        }
        let whole: f64 = sides.iter().sum();
        if whole == 0.0 {
            return None;
        }
        // Divided first, so that at a vertex the distance is the same for all faces around it.
        let weights = sides.map(|side| side / whole);
        let depth = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
        let distance = depth / self.direction[self.axes[2]];
        let position = corners.into_iter().zip(weights).map(|(corner, weight)| corner * weight).sum();
        (distance >= 0.0).then_some(Hit { face, weights, distance, position })
    }

    fn see(&self, position: DVec3) -> [f64; 3] {
        let offset = (position * self.scale - self.origin).to_array();
        let [x, y, z] = self.axes.map(|axis| offset[axis]);
        [x - self.shear[0] * z, y - self.shear[1] * z, z]
    }
}

/// On which side of the line through two points the third axis passes: the cross product of the points, whose sign is exact and
/// turns when they are exchanged.
fn side(a: [f64; 3], b: [f64; 3]) -> f64 {
    let products = [a[0] * b[1], a[1] * b[0]];
    // Rounding keeps the order of numbers, and what is lost counts only where they become equal.
    match products[0] - products[1] {
        0.0 => a[0].mul_add(b[1], -products[0]) - a[1].mul_add(b[0], -products[1]),
        difference => difference,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_side_of_a_line_is_exact() {
        let tiny = f64::EPSILON;
        let (a, b) = ([1.0 + tiny, 1.0, 0.0], [1.0, 1.0 - tiny, 0.0]);
        // (1 + e)(1 - e) − 1 = −e², which products lose.
        assert_eq!((side(a, b), side(b, a)), (-tiny * tiny, tiny * tiny));
        assert_eq!(side(a, a), 0.0);
    }

    #[test]
    fn what_is_no_ray_is_refused() {
        for (origin, direction) in
            [(DVec3::NAN, DVec3::X), (DVec3::ZERO, DVec3::ZERO), (DVec3::ZERO, DVec3::INFINITY), (DVec3::X, DVec3::NAN)]
        {
            assert!(Ray::new(origin, direction).is_err(), "{origin} {direction}");
        }
        for length in [1e-320, 1e-200, 1.0, 1e200, f64::MAX] {
            assert_eq!(Ray::new(DVec3::ZERO, DVec3::Y * length).map(|ray| ray.direction()), Ok(DVec3::Y));
        }
    }
}
