//! Cutting a mesh along the seams of a corner channel.

use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::rotation::Hubs;

/// Faces around a vertex without a seam between them: so many from a slot on.
pub(super) struct Sector {
    first_slot: usize,
    faces: usize,
    /// Whether they are all around the vertex, and no seam ends there.
    pub(super) is_closed: bool,
}

/// Corners by number: three a triangle, in the order of the mesh.
pub(super) struct Cutter<'a> {
    mesh: &'a Mesh,
    values: &'a [Option<[u32; 3]>],
    /// Where the corners at each vertex start in `corners`, and behind them their number.
    starts: Vec<usize>,
    /// The corners at each vertex, in the order of its ring.
    pub(super) corners: Vec<usize>,
}

/// The corner after a corner of a triangle.
pub(super) fn next(corner: usize) -> usize {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

impl<'a> Cutter<'a> {
    pub(super) fn new(mesh: &'a Mesh, values: &'a [Option<[u32; 3]>]) -> Self {
        let rotation = mesh.rotation();
        let mut starts = vec![0];
        for v in mesh.vertices() {
            starts.push(starts[v.index()] + rotation.ring(v).face_count());
        }
        let hubs = Hubs::among(rotation, mesh.vertices());
        let mut corners = vec![0; 3 * mesh.face_count()];
        for (k, triangle) in mesh.triangles().enumerate() {
            let [a, b, c] = triangle.corners();
            for (corner, (v, w)) in (3 * k..).zip([(a, b), (b, c), (c, a)]) {
                let slot = hubs.slot(rotation, v, w).expect("a triangle has edges");
                corners[starts[v.index()] + slot] = corner;
            }
        }
        Self { mesh, values, starts, corners }
    }

    /// The number of the value at a corner; `None` if its triangle has none.
    pub(super) fn value(&self, corner: usize) -> Option<u32> {
        self.values[corner / 3].map(|values| values[corner % 3])
    }

    fn at(&self, v: VertexId) -> &[usize] {
        &self.corners[self.starts[v.index()]..self.starts[v.index() + 1]]
    }

    /// The corners of a sector, in ring order.
    pub(super) fn corners(&self, v: VertexId, sector: &Sector) -> impl DoubleEndedIterator<Item = usize> + Clone {
        let at = self.at(v);
        let slots = sector.first_slot..sector.first_slot + sector.faces;
        slots.map(move |slot| at[slot % at.len()])
    }

    /// Whether there is no seam between the triangles of two corners that follow one another around a vertex.
    fn are_joined(&self, corner: usize, after: usize) -> bool {
        let ends = |corner, other| self.value(corner).zip(self.value(other));
        ends(corner, next(next(corner))).is_some_and(|ends_here| ends(after, next(after)) == Some(ends_here))
    }

    /// Appends the sectors with values, by first slot.
    pub(super) fn append_sectors(&self, v: VertexId, sectors: &mut Vec<Sector>) {
        let at = self.at(v);
        let is_open = self.mesh.is_boundary(v);
        let starts_here = |slot: &usize| match slot.checked_sub(1) {
            Some(before) => !self.are_joined(at[before], at[*slot]),
            None => is_open || !self.are_joined(at[at.len() - 1], at[0]),
        };
        let cuts: Vec<usize> = (0..at.len()).filter(starts_here).collect();
        if cuts.is_empty() && !at.is_empty() {
            sectors.push(Sector { first_slot: 0, faces: at.len(), is_closed: true });
        }
        for (k, &first_slot) in cuts.iter().enumerate() {
            let end = cuts.get(k + 1).copied().unwrap_or(if is_open { at.len() } else { cuts[0] + at.len() });
            if self.value(at[first_slot]).is_some() {
                sectors.push(Sector { first_slot, faces: end - first_slot, is_closed: false });
            }
        }
    }
}
