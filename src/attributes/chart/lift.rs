//! What of a chart mesh lies over what of the mesh below.

use crate::id::VertexId;
use crate::split::hierarchy::Levels;
use crate::step::Hierarchy;

/// In place of a chart vertex where a list ends.
const END: u32 = u32::MAX;

/// Which chart vertex lies over which vertex of the mesh.
#[derive(Clone, Debug, Default)]
pub(super) struct Lift {
    /// The vertex of the mesh below each chart vertex.
    base: Vec<VertexId>,
    /// For each vertex of the mesh the last chart vertex over it, and for each chart vertex the one before; or [`END`].
    last_over: Vec<u32>,
    before: Vec<u32>,
}

impl Lift {
    /// How many chart vertices there are.
    pub(super) fn len(&self) -> usize {
        self.base.len()
    }

    /// Says over which vertices of a mesh, which has this many, the next chart vertices lie.
    pub(super) fn extend(&mut self, vertex_count: usize, base: impl IntoIterator<Item = VertexId>) {
        self.last_over.resize(vertex_count, END);
        for v in base {
            let chart_vertex = self.base.len() as u32;
            self.before.push(std::mem::replace(&mut self.last_over[v.index()], chart_vertex));
            self.base.push(v);
        }
    }

    /// The vertex of the mesh below a chart vertex.
    pub(super) fn base(&self, chart_vertex: VertexId) -> VertexId {
        self.base[chart_vertex.index()]
    }

    /// The same for all chart vertices, in order.
    pub(super) fn bases(&self) -> &[VertexId] {
        &self.base
    }

    /// The chart vertices over a vertex, the last made first.
    pub(super) fn over(&self, v: VertexId) -> impl Iterator<Item = VertexId> {
        let some = |chart_vertex: u32| (chart_vertex != END).then_some(chart_vertex);
        let before = move |&chart_vertex: &u32| some(self.before[chart_vertex as usize]);
        let last = self.last_over.get(v.index()).and_then(|&last| some(last));
        std::iter::successors(last, before).map(|id| VertexId::new(id as usize))
    }

    /// The face over a triangle of any level of the hierarchy below, corner by corner, among those of the charts' own
    /// hierarchy; `None` if it has no values. O(1) but at level 0, where it costs the valence.
    pub(super) fn face_over(
        &self,
        levels: Levels<'_>,
        below: &Hierarchy,
        corners: [VertexId; 3],
    ) -> Option<[VertexId; 3]> {
        // Around a corner of its own level a triangle is one of the first.
        let start = (0..3).max_by_key(|&k| below.level(corners[k])).unwrap_or(0);
        let corners = [0, 1, 2].map(|k| corners[(start + k) % 3]);
        let mut around = self.over(corners[0]).flat_map(|v| levels.first_triangles(v));
        let mut face = around.find(|face| face.map(|v| self.base(v)) == corners)?;
        face.rotate_right(start);
        Some(face)
    }
}
