//! Where subdivision ends: limit positions, tangents and normals, at vertices for every scheme that has them and on the Loop
//! surface everywhere.
//!
//! The points around a vertex are mapped to those of the next level by a fixed matrix. Its left eigenvector for the
//! eigenvalue 1 gives the limit of the vertex, those for the next eigenvalues two tangents; each is a row of weights, a
//! mask. A [`Limit`] writes them into a [`MaskSink`] or applies them to a mesh.
//!
//! | scheme | position | tangents |
//! |---|---|---|
//! | [`LoopLimit`] | smooth, crease, boundary, corner, dart | the same; none at the tip of a cone |
//! | [`ButterflyLimit`] | the vertex | inside for valences 4 to 7, on boundaries up to 18 |
//! | [`ModifiedButterflyLimit`] | the vertex | all but sectors of two faces and more at a corner |
//! | [`Sqrt3Limit`] | inside, boundary | the same |
//!
//! The matrix is fixed only where nothing is semi-sharp: a vertex that is, or has such an edge, has no limit that is known
//! until the steps that [`Neighborhood::semi_sharp_steps`] counts are made.
//!
//! Read in this order: [`Limit`], [`LoopLimit`], the other three, [`AnyLimit`], [`Normals`], [`LimitSurface`].
//!
//! **Deliberately not here**: points between the vertices for other schemes than Loop, whose surfaces are no polynomials.

mod any;
mod butterfly;
mod dart;
mod loop_;
mod modified_butterfly;
mod normals;
mod sqrt3;
mod surface;
mod two_ring;

pub use any::AnyLimit;
pub use butterfly::ButterflyLimit;
pub use loop_::LoopLimit;
pub use modified_butterfly::ModifiedButterflyLimit;
pub use normals::Normals;
pub use sqrt3::Sqrt3Limit;
pub use surface::{Evaluation, LimitSurface, Patch};
pub(crate) use surface::{Fan, Fans, Rule};

use glam::DVec3;

use crate::id::VertexId;
use crate::mesh::{Mesh, Neighborhood};
use crate::parallel;
use crate::scheme::MaskSink;

/// A cross product of tangents is no normal below this, with the spokes of the vertex scaled to at most 1: what is left of
/// parallel tangents after rounding is near 1e-16.
const FLAT: f64 = 1e-12;

/// What is known of the limit of a scheme at the vertices of a mesh.
///
/// A vertex has *sides*, one for each tangent plane it may have: one where the surface runs around it, else one for each
/// sector between two sharp edges that follow one another, in ring order. So a crease vertex has two and a boundary vertex
/// one. Schemes that do not read tags see sharp edges on boundaries only. An isolated vertex has no side.
///
/// A side may still have no tangents, where the scheme is not smooth, and none that span a plane, where the mesh is flat or
/// folded: then no normal is made up.
pub trait Limit {
    /// Writes the mask of the limit position of a vertex. O(valence).
    ///
    /// # Panics
    /// If the scheme reads tags and the vertex is [semi-sharp](Neighborhood::is_semi_sharp).
    fn mask(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink);

    /// How many sides a vertex has. O(valence).
    fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize;

    /// Writes the masks of two tangents of one side of a vertex, of any length; their weights add to 0 and their cross
    /// product points outwards. Answers whether the scheme has any there; if not, nothing is written. O(valence), for
    /// schemes that look further than the ring O(valence) of the neighbours too.
    ///
    /// # Panics
    /// If there is no such side.
    fn tangent_masks(
        &self,
        around: Neighborhood<'_>,
        v: VertexId,
        side: usize,
        first: &mut impl MaskSink,
        second: &mut impl MaskSink,
    ) -> bool;

    /// The side of a vertex that holds the triangle after a slot of its ring; `None` if the vertex has no side. O(valence).
    fn side_at(&self, around: Neighborhood<'_>, v: VertexId, slot: usize) -> Option<usize> {
        match self.side_count(around, v) {
            0 => None,
            1 => Some(0),
            _ => sector_at(around, v, slot),
        }
    }

    /// The limit position of a vertex. O(valence).
    ///
    /// # Panics
    /// If there is no such vertex, or no mask: see [`Limit::mask`].
    #[must_use]
    fn position(&self, mesh: &Mesh, v: VertexId) -> DVec3 {
        let mut sum = WeightedSum::from(mesh, DVec3::ZERO);
        self.mask(mesh.neighborhood(), v, &mut sum);
        sum.value
    }

    /// The limit positions of all vertices, by id. O(vertices + edges).
    ///
    /// # Panics
    /// If a vertex has no mask: see [`Limit::mask`].
    ///
    /// ```
    /// use vvmesh::limit::{Limit, LoopLimit};
    /// let (mesh, limit) = (vvmesh::shapes::icosahedron(), LoopLimit::default());
    /// assert!(limit.positions(&mesh).into_iter().eq(mesh.vertices().map(|v| limit.position(&mesh, v))));
    /// ```
    #[must_use]
    fn positions(&self, mesh: &Mesh) -> Vec<DVec3>
    where
        Self: Sync,
    {
        parallel::list(mesh.vertex_count(), |v| self.position(mesh, VertexId::new(v)))
    }

    /// Two tangents of one side of a vertex, of any length, if the scheme has any there; see [`Limit::tangent_masks`].
    ///
    /// # Panics
    /// If there is no such vertex or no such side.
    #[must_use]
    fn tangents(&self, mesh: &Mesh, v: VertexId, side: usize) -> Option<[DVec3; 2]> {
        // The weights add to 0, so the origin is free; at the vertex least is lost by rounding.
        let [mut first, mut second] = [WeightedSum::from(mesh, mesh.position(v)); 2];
        let any = self.tangent_masks(mesh.neighborhood(), v, side, &mut first, &mut second);
        any.then_some([first.value, second.value])
    }

    /// The unit normal of one side of a vertex, outwards; `None` if there are no tangents, or they vanish or are parallel.
    ///
    /// # Panics
    /// If there is no such vertex or no such side.
    #[must_use]
    fn normal(&self, mesh: &Mesh, v: VertexId, side: usize) -> Option<DVec3> {
        let center = mesh.position(v);
        let spokes = mesh.ring(v).iter().map(|w| (mesh.position(w) - center).abs().max_element());
        let scale = spokes.fold(0.0, f64::max);
        let [first, second] = self.tangents(mesh, v, side)?.map(|tangent| tangent / scale);
        let cross = first.cross(second);
        let length = cross.length();
        (length > FLAT && length.is_finite()).then(|| cross / length)
    }

    /// The unit normals of all sides of all vertices.
    #[must_use]
    fn normals(&self, mesh: &Mesh) -> Normals
    where
        Self: Sync + Sized,
    {
        Normals::new(self, mesh)
    }
}

/// The number of the sector that holds the triangle after a slot.
fn sector_at(around: Neighborhood<'_>, v: VertexId, slot: usize) -> Option<usize> {
    let w = around.ring(v).neighbors()[slot];
    around.sectors(v).position(|sector| sector.neighbors().take(sector.face_count()).any(|u| u == w))
}

/// Applies a mask to the positions of a mesh, taken from an origin.
#[derive(Clone, Copy)]
struct WeightedSum<'a> {
    positions: &'a [DVec3],
    origin: DVec3,
    value: DVec3,
}

impl<'a> WeightedSum<'a> {
    fn from(mesh: &'a Mesh, origin: DVec3) -> Self {
        Self { positions: mesh.positions(), origin, value: DVec3::ZERO }
    }
}

impl MaskSink for WeightedSum<'_> {
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        let sum = vertices.into_iter().map(|v| self.positions[v.index()] - self.origin).sum::<DVec3>();
        self.value += weight * sum;
    }
}
