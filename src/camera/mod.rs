//! Who looks at a mesh, from where, and how much of the picture a part of it takes.
//!
//! **Deliberately not here**: which part of a mesh that selects ([`crate::select`]), and what hides behind what.

mod text;

use std::fmt;

use glam::{DVec2, DVec3};

use crate::angle::Angle;
use crate::error::ConfigError;
use crate::number::shortest;

/// What is nearer to the eye than this part of its distance to the point looked at is behind the near plane.
const NEAR: f64 = 1e-3;

/// Below this the sine of the angle between the line of sight and the direction upwards is rounding.
const PARALLEL: f64 = 1e-12;

/// A pinhole camera with square pixels.
///
/// It reads and prints as `eye=x,y,z,at=x,y,z,up=x,y,z,fov=DEG,size=WxH`: from where, to where, what is up in the picture, the
/// angle that its height takes, and its size in pixels. Its near plane is at a thousandth of the distance from `eye` to `at`;
/// what is nearer is not seen.
///
/// ```
/// use vvmesh::{Camera, glam::DVec3};
/// let camera: Camera = "eye=0,0,2,at=0,0,0,up=0,1,0,fov=90,size=640x480".parse()?;
/// // At distance 2 the 480 rows are 4 long.
/// assert!((camera.pixel_length([DVec3::ZERO, DVec3::X]) - 120.0).abs() < 1e-9);
/// assert!((camera.pixel_area([DVec3::ZERO, DVec3::X, DVec3::Y]) - 7200.0).abs() < 1e-9);
/// assert_eq!(camera.to_string().parse(), Ok(camera));
/// # Ok::<(), vvmesh::error::ConfigError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Camera {
    eye: DVec3,
    at: DVec3,
    up: DVec3,
    field_of_view: Angle,
    size: [u32; 2],
    /// To the right of the picture, upwards in it, and into it; of length 1, at right angles to each other.
    axes: [DVec3; 3],
    /// How many pixels a length of 1 takes at distance 1.
    scale: f64,
    near: f64,
}

impl Camera {
    /// A camera at `eye` that looks to `at`, with `up` upwards in the picture; the height of the picture takes an angle, and
    /// the picture has so many columns and rows.
    ///
    /// # Errors
    /// If a coordinate is not finite, `eye` is `at`, `up` is parallel to the line between them, the angle is not between 0 and
    /// 180 degrees, or a size is 0.
    pub fn new(eye: DVec3, at: DVec3, up: DVec3, field_of_view: Angle, size: [u32; 2]) -> Result<Self, ConfigError> {
        let refuse = |name, value, expected: &str| Err(ConfigError { name, value, expected: expected.to_owned() });
        for (name, vector) in [("eye", eye), ("at", at), ("up", up)] {
            if !vector.is_finite() {
                return refuse(name, vector.to_string(), "expected finite coordinates");
            }
        }
        let Some(forward) = unit(at - eye) else {
            return refuse("at", at.to_string(), "expected another point than the eye, not too far from it");
        };
        let right = forward.cross(unit(up).unwrap_or(DVec3::ZERO));
        if right.length() <= PARALLEL {
            return refuse("up", up.to_string(), "expected a direction across the line of sight");
        }
        let right = right.normalize();
        let degrees = field_of_view.deg();
        let rows_over_distance = 2.0 * (0.5 * field_of_view.rad()).tan();
        let scale = f64::from(size[1]) / rows_over_distance;
        if !(degrees > 0.0 && degrees < 180.0 && scale.is_finite()) {
            return refuse("fov", shortest(degrees), "expected degrees above 0 and below 180");
        }
        if size.contains(&0) {
            let [width, height] = size;
            return refuse("size", format!("{width}x{height}"), "expected at least 1x1 pixels");
        }
        let axes = [right, right.cross(forward), forward];
        let near = NEAR * (at - eye).dot(forward);
        Ok(Self { eye, at, up, field_of_view, size, axes, scale, near })
    }

    /// From where it looks.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The direction from the eye through a point of the picture: columns from its left border, rows from its upper one. Not of
    /// length 1.
    ///
    /// ```
    /// use vvmesh::{Camera, glam::DVec3};
    /// let camera: Camera = "eye=0,0,2,at=0,0,0,up=0,1,0,fov=90,size=640x480".parse()?;
    /// let upper_left = camera.direction_through([0.0, 0.0]);
    /// assert!(upper_left.normalize().distance(DVec3::new(-4.0 / 3.0, 1.0, -1.0).normalize()) < 1e-15);
    /// # Ok::<(), vvmesh::error::ConfigError>(())
    /// ```
    #[must_use]
    pub fn direction_through(&self, [column, row]: [f64; 2]) -> DVec3 {
        let [right, up, into] = self.axes;
        let [half_width, half_height] = self.size.map(|pixels| f64::from(pixels) / 2.0);
        into * self.scale + right * (column - half_width) + up * (half_height - row)
    }

    /// How many pixels a triangle covers: the area of its picture, up to the near plane. It does not matter from which side
    /// it is seen, whether something hides it, or whether it lies beside the picture.
    #[must_use]
    pub fn pixel_area(&self, corners: [DVec3; 3]) -> f64 {
        let corners = corners.map(|corner| self.seen(corner));
        let mut pixels = [DVec2::ZERO; 4];
        let mut count = 0;
        let mut push = |point| {
            pixels[count] = self.pixel(point);
            count += 1;
        };
        for (k, &corner) in corners.iter().enumerate() {
            let next = corners[(k + 1) % 3];
            if self.is_before(corner) {
                push(corner);
            }
            if self.is_before(corner) != self.is_before(next) {
                push(self.at_near(corner, next));
            }
        }
        let Some((&first, others)) = pixels[..count].split_first() else { return 0.0 };
        others.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum::<f64>().abs() / 2.0
    }

    /// How many pixels long the picture of a line between two points is, up to the near plane, whether something hides it or
    /// not.
    #[must_use]
    pub fn pixel_length(&self, ends: [DVec3; 2]) -> f64 {
        let [a, b] = ends.map(|end| self.seen(end));
        let [a, b] = match (self.is_before(a), self.is_before(b)) {
            (true, true) => [a, b],
            (true, false) => [a, self.at_near(a, b)],
            (false, true) => [self.at_near(a, b), b],
            (false, false) => return 0.0,
        };
        self.pixel(a).distance(self.pixel(b))
    }

    /// Beyond which of the five planes of the view a point lies, a bit each: near, left, right, below, above. None if it is
    /// in the picture.
    #[must_use]
    pub fn planes_beyond(&self, point: DVec3) -> u8 {
        let DVec3 { x, y, z } = self.seen(point);
        let [half_width, half_height] = self.size.map(|pixels| f64::from(pixels) / 2.0 / self.scale);
        let beyond =
            [z < self.near, x < -half_width * z, x > half_width * z, y < -half_height * z, y > half_height * z];
        beyond.into_iter().rev().fold(0, |bits, is_beyond| 2 * bits + u8::from(is_beyond))
    }

    /// A point by its distances to the right, upwards and into the picture.
    fn seen(&self, point: DVec3) -> DVec3 {
        let offset = point - self.eye;
        DVec3::from(self.axes.map(|axis| axis.dot(offset)))
    }

    fn is_before(&self, seen: DVec3) -> bool {
        seen.z >= self.near
    }

    /// Where a line crosses the near plane.
    fn at_near(&self, a: DVec3, b: DVec3) -> DVec3 {
        a.lerp(b, (self.near - a.z) / (b.z - a.z)).with_z(self.near)
    }

    fn pixel(&self, seen: DVec3) -> DVec2 {
        seen.truncate() / seen.z * self.scale
    }
}

/// The direction of a vector, if it has one.
fn unit(vector: DVec3) -> Option<DVec3> {
    (vector / vector.abs().max_element()).try_normalize()
}

impl fmt::Display for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, vector) in [("eye", self.eye), ("at", self.at), ("up", self.up)] {
            let [x, y, z] = vector.to_array().map(shortest);
            write!(f, "{name}={x},{y},{z},")?;
        }
        let [width, height] = self.size;
        write!(f, "fov={},size={width}x{height}", shortest(self.field_of_view.deg()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        // At distance 1 the picture is 2 high and 4 wide, 100 pixels each; the near plane is at 0.01.
        Camera::new(DVec3::ZERO, DVec3::X * 10.0, DVec3::Z * 3.0, Angle::from_deg(90.0), [400, 200]).expect("sound")
    }

    #[test]
    fn what_is_behind_takes_no_pixels_and_what_crosses_is_cut() {
        let camera = camera();
        let near = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
        let [far, left, behind] = [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::new(-1.0, 0.0, 0.0)];
        near(camera.pixel_length([far, left]), 100.0);
        assert_eq!(camera.pixel_length([behind, behind + DVec3::Y]), 0.0);
        // At the near plane it is 0.505 to the left.
        near(camera.pixel_length([left, behind]), 5050.0 - 100.0);
        near(camera.pixel_length([behind, left]), 5050.0 - 100.0);
        let up = DVec3::new(1.0, 0.0, 1.0);
        near(camera.pixel_area([far, left, up]), 5000.0);
        assert_eq!(camera.pixel_area([behind, behind + DVec3::Y, behind + DVec3::Z]), 0.0);
        // One corner behind: the quad (0, 0), (-100, 0), (-5050, 4950), (0, 4950).
        near(camera.pixel_area([far, left, behind + DVec3::Z]), 4950.0 * (100.0 + 5050.0) / 2.0);
        let corners = [left, up, behind];
        let areas = [0, 1, 2].map(|k| camera.pixel_area([corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]]));
        near(areas[0], 5050.0 * 5050.0 / 2.0 - 5000.0);
        near(areas[1], areas[0]);
        near(areas[2], areas[0]);
    }

    #[test]
    fn planes_are_told_apart() {
        let camera = camera();
        let cases = [
            ([1.0, 0.0, 0.0], 0),
            ([0.005, 0.0, 0.0], 1),
            ([1.0, 2.1, 0.0], 2),
            ([1.0, -2.1, 0.0], 4),
            ([1.0, 0.0, -1.1], 8),
            ([1.0, 1.9, 1.1], 16),
            ([1.0, 2.1, 1.1], 18),
        ];
        for (point, planes) in cases {
            assert_eq!(camera.planes_beyond(DVec3::from(point)), planes, "{point:?}");
        }
    }
}
