//! Vertices by their distance from others: breadth-first search that costs what it finds.

use crate::id::VertexId;
use crate::rotation::RotationSystem;
use crate::scratch::Scratch;

/// The vertices at most `radius` edges away from one of the seeds, in breadth-first order.
///
/// See [`Disk`] for the order. A radius beyond the farthest vertex gives all vertices of the components with a seed.
/// Seeds may repeat.
///
/// # Panics
/// If there is no such seed.
///
/// # Complexity
/// O(sum of the valences in the disk), independent of the mesh once `scratch` has its size; [`Disk::search`] reuses the
/// result's memory too.
///
/// ```
/// use vvmesh::{VertexId, query, scratch::Scratch, shapes};
/// let mesh = shapes::grid(9, 9);
/// let mut scratch = Scratch::new();
/// let disk = query::r_disk(mesh.rotation(), [VertexId::new(44)], 2, &mut scratch);
/// assert_eq!(disk.layers().map(<[_]>::len).collect::<Vec<_>>(), [1, 6, 12]);
/// assert_eq!(query::r_disk(mesh.rotation(), [VertexId::new(44)], usize::MAX, &mut scratch).vertices().len(), 100);
/// ```
#[must_use]
pub fn r_disk(
    rotation: &RotationSystem,
    seeds: impl IntoIterator<Item = VertexId>,
    radius: usize,
    scratch: &mut Scratch,
) -> Disk {
    let mut disk = Disk::new();
    disk.search(rotation, seeds, radius, scratch);
    disk
}

/// Adds to a list of seeds the vertices of their r-disk, in breadth-first order, and takes repeated ones out.
///
/// Panics and cost are those of [`r_disk`].
///
/// ```
/// use vvmesh::{VertexId, query, scratch::Scratch, shapes};
/// let mut vertices = vec![VertexId::new(4)];
/// query::expand(shapes::octahedron().rotation(), &mut vertices, 1, &mut Scratch::new());
/// assert_eq!(vertices.len(), 5);
/// ```
pub fn expand(rotation: &RotationSystem, vertices: &mut Vec<VertexId>, radius: usize, scratch: &mut Scratch) {
    search(rotation, vertices, radius, scratch, |_| ());
}

/// Expands a list of seeds, and tells how long it is after each layer.
fn search(
    rotation: &RotationSystem,
    vertices: &mut Vec<VertexId>,
    radius: usize,
    scratch: &mut Scratch,
    mut layer_ends: impl FnMut(usize),
) {
    let mut marks = scratch.marks(rotation.vertex_count(), 1);
    vertices.retain(|&seed| {
        // The scratch may have grown on a larger mesh, so it does not notice.
        assert!(rotation.contains(seed), "the seed {seed} is not a vertex");
        marks.insert(seed)
    });
    let (mut start, mut distance) = (0, 0);
    while start < vertices.len() {
        let end = vertices.len();
        layer_ends(end);
        if distance == radius {
            break;
        }
        for k in start..end {
            for &w in rotation.neighbors(vertices[k]) {
                if marks.insert(w) {
                    vertices.push(w);
                }
            }
        }
        (start, distance) = (end, distance + 1);
    }
}

/// The vertices exactly `radius` edges away from the nearest seed, in breadth-first order.
///
/// Empty if none is so far. Panics and cost are those of [`r_disk`].
///
/// ```
/// use vvmesh::{VertexId, query, scratch::Scratch, shapes};
/// let mesh = shapes::octahedron();
/// let top = VertexId::new(4);
/// let bottom = query::r_ring(mesh.rotation(), [top], 2, &mut Scratch::new());
/// assert_eq!(bottom, [VertexId::new(5)]);
/// ```
#[must_use]
pub fn r_ring(
    rotation: &RotationSystem,
    seeds: impl IntoIterator<Item = VertexId>,
    radius: usize,
    scratch: &mut Scratch,
) -> Vec<VertexId> {
    let disk = r_disk(rotation, seeds, radius, scratch);
    disk.layer(radius).to_vec()
}

/// The vertices of an r-disk, layer by layer: layer `d` is the vertices at distance exactly `d`.
///
/// The seeds come first, in their order, each once; then the neighbours of each vertex in the order of its ring, those
/// that were not met before. So the order depends on rings and seeds alone.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Disk {
    vertices: Vec<VertexId>,
    /// Where each layer ends in `vertices`; no layer is empty.
    layer_ends: Vec<usize>,
}

impl Disk {
    /// An empty disk, a buffer for [`Disk::search`].
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Replaces the disk by the one that [`r_disk`] would give, in the memory it already holds.
    ///
    /// # Panics
    /// If there is no such seed.
    pub fn search(
        &mut self,
        rotation: &RotationSystem,
        seeds: impl IntoIterator<Item = VertexId>,
        radius: usize,
        scratch: &mut Scratch,
    ) {
        let Self { vertices, layer_ends } = self;
        vertices.clear();
        vertices.extend(seeds);
        layer_ends.clear();
        search(rotation, vertices, radius, scratch, |end| layer_ends.push(end));
    }

    /// All vertices in breadth-first order.
    #[inline]
    #[must_use]
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// All vertices in breadth-first order, as the vector itself.
    #[inline]
    #[must_use]
    pub fn into_vertices(self) -> Vec<VertexId> {
        self.vertices
    }

    /// The vertices at distance exactly `distance`; empty beyond the last layer. O(1).
    #[must_use]
    pub fn layer(&self, distance: usize) -> &[VertexId] {
        let Some(&end) = self.layer_ends.get(distance) else {
            return &[];
        };
        let start = if distance == 0 { 0 } else { self.layer_ends[distance - 1] };
        &self.vertices[start..end]
    }

    /// The layers from the seeds outwards; none is empty.
    pub fn layers(&self) -> impl ExactSizeIterator<Item = &[VertexId]> + DoubleEndedIterator + Clone {
        (0..self.layer_ends.len()).map(|distance| self.layer(distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn ids(indices: impl IntoIterator<Item = usize>) -> Vec<VertexId> {
        indices.into_iter().map(VertexId::new).collect()
    }

    #[test]
    fn layers_follow_the_rings() {
        let mesh = shapes::grid(4, 4);
        let mut scratch = Scratch::new();
        let v = VertexId::new(12);
        let disk = r_disk(mesh.rotation(), [v], 1, &mut scratch);
        assert_eq!(disk.layer(0), [v]);
        assert_eq!(disk.layer(1), mesh.rotation().neighbors(v));
        assert_eq!(disk.layer(2), []);
    }

    #[test]
    fn seeds_keep_their_order_and_come_once() {
        let mesh = shapes::grid(4, 4);
        let mut scratch = Scratch::new();
        let disk = r_disk(mesh.rotation(), ids([7, 3, 7, 3, 3]), 0, &mut scratch);
        assert_eq!(disk.into_vertices(), ids([7, 3]));
        let empty = r_disk(mesh.rotation(), [], usize::MAX, &mut scratch);
        assert_eq!((empty.vertices().len(), empty.layers().len()), (0, 0));
    }

    #[test]
    fn a_disk_stays_in_its_component_and_ends_with_it() {
        let rotation = RotationSystem::with_isolated(3);
        let mut disk = r_disk(&rotation, ids([1]), usize::MAX, &mut Scratch::new());
        assert_eq!((disk.vertices(), disk.layers().len()), (&ids([1])[..], 1));
        let mesh = shapes::tetrahedron();
        disk.search(mesh.rotation(), ids([2]), 1000, &mut Scratch::new());
        assert_eq!(disk.layers().map(<[_]>::len).collect::<Vec<_>>(), [1, 3]);
        assert_eq!(r_ring(mesh.rotation(), ids([2]), 2, &mut Scratch::new()), []);
    }

    #[test]
    #[should_panic(expected = "the seed v5 is not a vertex")]
    fn an_unknown_seed_is_noticed_even_with_a_scratch_from_a_larger_mesh() {
        let mut scratch = Scratch::new();
        scratch.marks(100, 1);
        let _ = r_disk(shapes::tetrahedron().rotation(), ids([5]), 0, &mut scratch);
    }
}
