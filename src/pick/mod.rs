//! Where a ray meets a mesh, also while it is being refined.
//!
//! A [`FaceTree`] is a hierarchy of boxes around the faces of a mesh. It is made once; after a step of refinement it is told
//! which vertices the step touched, and costs what lies around them.
//!
//! The test of a single face is *watertight*: a ray that meets the inside of a closed surface meets a face, also where it goes
//! exactly through an edge or a vertex. Every position is seen from the ray in the same way, whatever face it is a corner of,
//! and on which side of an edge the ray passes is then told without rounding. Source: `[woop2013]`, with exact signs in place
//! of their fallback to higher precision.
//!
//! Read in this order: [`Ray`], [`Hit`], [`FaceTree`].
//!
//! **Deliberately not here**: what is done at the place that was hit ([`crate::stroke`]).

mod ray;
mod tree;

pub use ray::Ray;
pub use tree::FaceTree;

use glam::DVec3;

use crate::id::Triangle;

/// A place on a mesh that a ray met.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit {
    /// The face.
    pub face: Triangle,
    /// The barycentric coordinates, in the order of the corners: from 0 to 1, adding up to 1 but for rounding.
    pub weights: [f64; 3],
    /// How far it is from the origin of the ray.
    pub distance: f64,
    /// Where it is: what the corners and the coordinates say.
    pub position: DVec3,
}

impl Hit {
    /// Whether it is nearer than another one; of hits at the very same distance the smallest face is.
    fn is_before(&self, other: &Self) -> bool {
        self.distance.total_cmp(&other.distance).then(self.face.cmp(&other.face)).is_lt()
    }
}
