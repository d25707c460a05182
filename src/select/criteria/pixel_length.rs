//! Edges that are long in a picture.

use std::fmt;

use super::{Criterion, at_least_0, edges_that, shortest};
use crate::camera::Camera;
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The edges that are longer than a number of pixels in the picture of a camera: [`Camera::pixel_length`] is above it.
///
/// What is behind the near plane is cut off first. What is beside the picture or hidden is not told apart; `frustum` does that
/// for faces. Boundary edges and edges of faces without area are like others.
///
/// Complexity: O(vertices + edges), and O(n log n) with n edges selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PixelLength {
    camera: Camera,
    above: f64,
}

impl PixelLength {
    /// The edges longer than so many pixels.
    ///
    /// # Errors
    /// If the number is not finite, or below 0.
    pub fn new(camera: Camera, above: f64) -> Result<Self, ConfigError> {
        at_least_0("pixels", above).map(|above| Self { camera, above })
    }
}

impl Criterion for PixelLength {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(edges_that(mesh, |ends, _| self.camera.pixel_length(ends.map(|v| mesh.position(v))) > self.above))
    }
}

/// As an expression has it, which is told the camera apart: `pixel-length:N`.
impl fmt::Display for PixelLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "pixel-length:{}", shortest(self.above))
    }
}
