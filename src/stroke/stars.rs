//! What is proven of a mesh that is refined to other levels at other places.
//!
//! The [certificate](crate::certify) compares with uniform refinement of as many levels as there were steps. Under a pen every
//! place has its own number of steps, so what is carried here is a level a vertex: that of the uniform mesh in which it has the
//! same ring, and it and its neighbours the same positions and tags, bit for bit. It is carried on by the argument of the
//! theorem of incremental subdivision, whatever the selections are.

use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::Reach;
use crate::step::{History, Lineage};

/// For every vertex the level of the uniform mesh of which it has the star, if it is proven to have that of any.
#[derive(Debug)]
pub(super) struct Stars {
    levels: Vec<Option<u8>>,
    reach: Reach,
}

impl Stars {
    /// Those of an input, for a scheme with this reach.
    pub(super) fn new(mesh: &Mesh, reach: Reach) -> Self {
        Self { levels: vec![Some(0); mesh.vertex_count()], reach }
    }

    /// The level of a star, if there is one.
    pub(super) fn level(&self, v: VertexId) -> Option<u8> {
        self.levels[v.index()]
    }

    /// Goes on to the mesh after a step in whose region these vertices were, ascending.
    ///
    /// The star of a vertex is one level on if all its neighbours are new: then all faces around it were split. That of a new
    /// vertex is, if only the ends of its edge are older. What all that is made of are the stars of the vertex or of the ends,
    /// and if masks reach farther, those of all that the neighbours were made of. Who else was in the region or beside it lost
    /// its star.
    pub(super) fn follow(&mut self, mesh: &Mesh, history: &History, region: &[VertexId]) {
        let first = self.levels.len();
        let is_new = |v: VertexId| v.index() >= first;
        let ends = |x: VertexId| history.parents(x).filter(|_| is_new(x)).as_ref().map(Lineage::vertices);
        let made = (first..mesh.vertex_count()).map(VertexId::new).map(|x| {
            let others = || mesh.ring(x).iter().filter(|&w| ends(x).is_none_or(|mut ends| ends.all(|end| end != w)));
            let of_ends = self.common_level(ends(x)?)?;
            (others().all(is_new) && self.reaches(of_ends, others().filter_map(ends).flatten())).then_some(of_ends + 1)
        });
        let made: Vec<Option<u8>> = made.collect();
        let kept = region.iter().map(|&v| {
            let level = self.level(v)?;
            let mut ring = mesh.ring(v).iter();
            (ring.all(is_new) && self.reaches(level, mesh.ring(v).iter().filter_map(ends).flatten()))
                .then_some(level + 1)
        });
        let kept: Vec<Option<u8>> = kept.collect();

        self.levels.extend(made);
        for &v in region {
            for w in mesh.ring(v).iter().filter(|&w| !is_new(w)) {
                self.levels[w.index()] = None;
            }
        }
        for x in (first..mesh.vertex_count()).map(VertexId::new) {
            for w in mesh.ring(x).iter().filter(|&w| !is_new(w)) {
                self.levels[w.index()] = None;
            }
        }
        for (v, level) in region.iter().zip(kept) {
            self.levels[v.index()] = level;
        }
    }

    /// The level that all of these stars have.
    fn common_level(&self, mut vertices: impl Iterator<Item = VertexId>) -> Option<u8> {
        let level = self.level(vertices.next()?)?;
        vertices.all(|v| self.level(v) == Some(level)).then_some(level)
    }

    /// Whether these stars are of a level, as far as masks read them.
    fn reaches(&self, level: u8, mut vertices: impl Iterator<Item = VertexId>) -> bool {
        self.reach != Reach::BothStars || vertices.all(|v| self.level(v) == Some(level))
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.levels.capacity() * size_of::<Option<u8>>()
    }
}
