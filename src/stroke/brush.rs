//! How far around a place a pen draws, and how deep.

use crate::error::ConfigError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::pick::Hit;
use crate::query::{ball_disk, path_disk, r_disk};
use crate::scratch::Scratch;
use crate::select::Selection;

/// How far from where a pen points vertices are touched. The corners of the face there always are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Radius {
    /// In space, as far as the surface does not leave the ball: see [`ball_disk`].
    Euclidean(f64),
    /// Along edges, from the corners of the face: see [`path_disk`], also for how much longer that is than along the surface.
    EdgePath(f64),
    /// In edges of the mesh as it is, from the corners of the face. It shrinks as the mesh becomes finer.
    Edges(usize),
}

/// How a pen draws.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Brush {
    radius: Radius,
    level: u8,
    pace: f64,
}

impl Brush {
    /// Touches vertices within a radius; level 1 is wanted of them when the pen comes, one more after every `pace` seconds for
    /// which it dwells, and never more than `level`. With a pace of 0 that is wanted at once.
    ///
    /// # Errors
    /// If a length or the pace is not a finite number, 0 or more.
    pub fn new(radius: Radius, level: u8, pace: f64) -> Result<Self, ConfigError> {
        let length = match radius {
            Radius::Euclidean(length) => ("euclidean", length),
            Radius::EdgePath(length) => ("edge_path", length),
            Radius::Edges(_) => ("edges", 0.0),
        };
        for (name, value) in [length, ("pace", pace)] {
            if !(value.is_finite() && value >= 0.0) {
                let expected = "expected a finite number, 0 or more".to_owned();
                return Err(ConfigError { name, value: value.to_string(), expected });
            }
        }
        Ok(Self { radius, level, pace })
    }

    /// The level that is wanted of what is touched after so many seconds.
    #[must_use]
    pub fn wanted(&self, dwelt: f64) -> u8 {
        let steps = if self.pace > 0.0 { (dwelt / self.pace).floor() } else { f64::INFINITY };
        // The conversion stays within the range of the type.
        self.level.min((steps as u8).saturating_add(1))
    }

    /// The vertices that are touched.
    pub(super) fn touched(&self, mesh: &Mesh, hit: &Hit, scratch: &mut Scratch) -> Selection {
        let (corners, position) = (hit.face.corners(), hit.position);
        let near: Vec<VertexId> = match self.radius {
            Radius::Euclidean(radius) => ball_disk(mesh, corners, position, radius, scratch),
            Radius::EdgePath(radius) => {
                let seeds = corners.map(|v| (v, mesh.position(v).distance(position)));
                let disk = path_disk(mesh, seeds, radius, scratch);
                disk.into_iter().map(|(v, _)| v).chain(corners).collect()
            }
            Radius::Edges(radius) => r_disk(mesh.rotation(), corners, radius, scratch).into_vertices(),
        };
        near.into_iter().collect()
    }

    /// How far the pen may go and still dwell: the radius, in edges the distance of the farthest vertex that is touched.
    pub(super) fn dwelling_distance(&self, mesh: &Mesh, hit: &Hit, touched: &Selection) -> f64 {
        match self.radius {
            Radius::Euclidean(radius) | Radius::EdgePath(radius) => radius,
            Radius::Edges(_) => {
                let distances = touched.vertices().iter().map(|&v| mesh.position(v).distance(hit.position));
                distances.fold(0.0, f64::max)
            }
        }
    }
}
