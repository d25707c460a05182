//! Rows of tangents, and the normals that they make.

use glam::DVec3;

use super::SubdivisionMatrix;
use super::weights::WeightMatrix;
use crate::id::VertexId;
use crate::limit::Limit;
use crate::mesh::Mesh;
use crate::parallel;
use crate::scheme::Mask;

/// A cross product of tangents is no normal below this, with each tangent divided by the greatest length that its weights
/// can make of the points they weigh: what is left of parallel tangents after rounding is near 1e-16.
const FLAT: f64 = 1e-12;

/// Two tangents for every side of every vertex, as rows of weights that add to 0.
///
/// A side is one of those that a [`Limit`] gives a vertex: one for each tangent plane. Isolated vertices have none.
#[derive(Clone, PartialEq, Debug)]
pub struct TangentRows {
    sides: Vec<(VertexId, usize)>,
    tangents: [WeightMatrix; 2],
}

impl TangentRows {
    pub(super) fn of(matrix: &SubdivisionMatrix, mesh: &Mesh, limit: &impl Limit) -> Self {
        let around = mesh.neighborhood();
        let mut sides = Vec::new();
        let [mut first, mut second] = [matrix.new_rows(), matrix.new_rows()];
        let [mut along, mut across] = [Mask::default(), Mask::default()];
        for v in mesh.vertices() {
            for side in 0..limit.side_count(around, v) {
                along.clear();
                across.clear();
                if limit.tangent_masks(around, v, side, &mut along, &mut across) {
                    sides.push((v, side));
                    matrix.push_row(&mut first, &along);
                    matrix.push_row(&mut second, &across);
                }
            }
        }
        Self { sides, tangents: [first.finish(), second.finish()] }
    }

    /// The vertex of each row and which of its sides it is, by vertex and side.
    #[must_use]
    pub fn sides(&self) -> &[(VertexId, usize)] {
        &self.sides
    }

    /// The matrices of the first and of the second tangents; their cross product points outwards.
    #[must_use]
    pub fn tangents(&self) -> [&WeightMatrix; 2] {
        self.tangents.each_ref()
    }

    /// The unit normals of the limit surface for these positions of the input, in the order of [`TangentRows::sides`];
    /// `None` where the tangents vanish or are parallel. Two products: O(nonzeros).
    ///
    /// # Panics
    /// If there are not as many positions as columns.
    #[must_use]
    pub fn normals(&self, positions: &[DVec3]) -> Vec<Option<DVec3>> {
        assert_eq!(positions.len(), self.tangents[0].column_count(), "there is one position for each input vertex");
        let mut normals = Vec::with_capacity(self.sides.len());
        parallel::append(&mut normals, 0..self.sides.len(), |row| {
            let [first, second] = self.tangents.each_ref().map(|rows| scaled(rows, row, positions));
            let cross = first.cross(second);
            let length = cross.length();
            (length > FLAT && length.is_finite()).then(|| cross / length)
        });
        normals
    }
}

/// A tangent, as a part of the greatest length that it could have. It is not finite if all points are one.
fn scaled(rows: &WeightMatrix, row: usize, positions: &[DVec3]) -> DVec3 {
    // The weights add to 0, so the origin is free; at one of the points least is lost by rounding.
    let origin = rows.row(row).next().map_or(DVec3::ZERO, |(column, _)| positions[column]);
    let (mut tangent, mut weight_sum, mut reach) = (DVec3::ZERO, 0.0, 0.0_f64);
    for (column, weight) in rows.row(row) {
        let spoke = positions[column] - origin;
        tangent += weight * spoke;
        weight_sum += weight.abs();
        reach = reach.max(spoke.length());
    }
    tangent / (weight_sum * reach)
}
