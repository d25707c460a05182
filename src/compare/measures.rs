//! What is measured of a mesh that a method made.

use crate::mesh::Mesh;
use crate::query::measure::{corner_positions, triangle_angles_rad};
use crate::step::{History, SplitKind};

/// What a method made at a level, and what that took.
#[derive(Clone, PartialEq, Debug)]
pub struct Measures {
    /// Faces of the mesh.
    pub faces: usize,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// T-vertices that the step made; see [`Step::t_vertices`](crate::subdivide::Step).
    pub t_vertices: usize,
    /// O-vertices that the step made; see [`Step::o_vertices`](crate::subdivide::Step).
    pub o_vertices: usize,
    /// The greatest valence in the mesh.
    pub max_valence: usize,
    /// How far the vertices of the region are from where uniform refinement has them, at most, of those that the method made;
    /// `None` if it made none.
    pub max_deviation: Option<f64>,
    /// The same in the mean.
    pub mean_deviation: Option<f64>,
    /// How far their limits are from each other, at most, if both meshes were refined uniformly from here on. `None` under
    /// √3 and 4-8, where limits are not known at every level, and where all is semi-sharp.
    pub max_limit_deviation: Option<f64>,
    /// How many of the vertices that the region has in the uniform mesh the method made and has at the same place, bit for bit,
    /// in percent; `None` if the region has no vertex.
    pub equal_percent: Option<f64>,
    /// The greatest difference between the levels of two triangles with a common vertex; under √3 in half steps. What closes
    /// a crack has the level of the triangle that it is a part of.
    pub balance: u32,
    /// The smallest angle of a triangle, in degrees; `None` of a mesh without any.
    pub min_angle_deg: Option<f64>,
    /// In how many passes the step found what to split; see [`Step::passes`](crate::subdivide::Step).
    pub passes: usize,
    /// How long the step took.
    pub seconds: f64,
    /// What the mesh and its history take, names of vertices included.
    pub bytes: usize,
}

/// The greatest valence of a mesh.
pub(super) fn max_valence(mesh: &Mesh) -> usize {
    mesh.vertices().map(|v| mesh.ring(v).valence()).max().unwrap_or(0)
}

/// The smallest angle of a mesh, in degrees.
pub(super) fn min_angle_deg(mesh: &Mesh) -> Option<f64> {
    let angles = mesh.triangles().flat_map(|triangle| triangle_angles_rad(corner_positions(mesh, triangle)));
    angles.reduce(f64::min).map(f64::to_degrees)
}

/// The greatest difference between the levels of triangles around a vertex. The history keeps names.
pub(super) fn balance(mesh: &Mesh, history: &History) -> u32 {
    let closing = history.closing_edges(mesh).unwrap_or_default();
    let by_half_steps = history.split_kind() == Some(SplitKind::Trisect);
    let mut spread: Vec<Option<[u32; 2]>> = vec![None; mesh.vertex_count()];
    for triangle in mesh.triangles() {
        let level = match by_half_steps {
            true => history.generation(triangle),
            false => history.face_level(triangle, &closing).map(|(level, _)| level.into()),
        };
        let level = level.expect("names are kept");
        for v in triangle.corners() {
            let [least, greatest] = spread[v.index()].get_or_insert([level; 2]);
            (*least, *greatest) = ((*least).min(level), (*greatest).max(level));
        }
    }
    spread.into_iter().flatten().map(|[least, greatest]| greatest - least).max().unwrap_or(0)
}

/// Distances, looked at one by one.
#[derive(Default)]
pub(super) struct Deviations {
    count: usize,
    greatest: f64,
    sum: f64,
}

impl Deviations {
    pub(super) fn add(&mut self, distance: f64) {
        self.count += 1;
        self.greatest = self.greatest.max(distance);
        self.sum += distance;
    }

    pub(super) fn greatest(&self) -> Option<f64> {
        (self.count > 0).then_some(self.greatest)
    }

    pub(super) fn mean(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}
