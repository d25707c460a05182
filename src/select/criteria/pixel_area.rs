//! Faces that are large in a picture.

use std::fmt;

use super::{Criterion, at_least_0, faces_that, shortest};
use crate::camera::Camera;
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The faces that cover more than a number of pixels in the picture of a camera: [`Camera::pixel_area`] is above it.
///
/// What is behind the near plane is cut off first. Which side of a face is seen does not matter, nor whether it is hidden or
/// lies beside the picture; `pixel-area:N&frustum` leaves out the latter. Faces without area cover no pixels.
///
/// Complexity: O(faces), and O(n log n) with n faces selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PixelArea {
    camera: Camera,
    above: f64,
}

impl PixelArea {
    /// The faces that cover more than so many pixels.
    ///
    /// # Errors
    /// If the number is not finite, or below 0.
    pub fn new(camera: Camera, above: f64) -> Result<Self, ConfigError> {
        at_least_0("pixels", above).map(|above| Self { camera, above })
    }
}

impl Criterion for PixelArea {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(faces_that(mesh, |corners| self.camera.pixel_area(corners.map(|v| mesh.position(v))) > self.above))
    }
}

/// As an expression has it, which is told the camera apart: `pixel-area:N`.
impl fmt::Display for PixelArea {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "pixel-area:{}", shortest(self.above))
    }
}
