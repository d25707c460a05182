//! Vertices by their distance in space and along edges: searches that cost what they find.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;

use super::measure::edge_length;
use crate::id::{Edge, VertexId};
use crate::mesh::Mesh;
use crate::scratch::Scratch;

/// The vertices that are reached from the seeds without leaving a ball, and the seeds, in breadth-first order.
///
/// What lies in the ball but is another part of the surface there, as the back of a thin sheet, is not among them. What lies on
/// the surface of the ball is.
///
/// # Panics
/// If there is no such seed.
///
/// # Complexity
/// O(sum of the valences of what is found), independent of the mesh once `scratch` has its size.
///
/// ```
/// use vvmesh::{VertexId, query, scratch::Scratch, shapes};
/// let mesh = shapes::grid(9, 9);
/// let center = VertexId::new(44);
/// let disk = query::ball_disk(&mesh, [center], mesh.position(center), 1.0, &mut Scratch::new());
/// assert_eq!(disk.len(), 5);
/// ```
#[must_use]
pub fn ball_disk(
    mesh: &Mesh,
    seeds: impl IntoIterator<Item = VertexId>,
    center: DVec3,
    radius: f64,
    scratch: &mut Scratch,
) -> Vec<VertexId> {
    let mut marks = scratch.marks(mesh.vertex_count(), 1);
    let mut found: Vec<VertexId> = seeds.into_iter().filter(|&seed| marks.insert(seed)).collect();
    let mut next = 0;
    while let Some(&v) = found.get(next) {
        next += 1;
        let inside = |w: &VertexId| mesh.position(*w).distance(center) <= radius;
        found.extend(mesh.ring(v).iter().filter(inside).filter(|&w| marks.insert(w)));
    }
    found
}

/// The vertices to which a path along edges leads from a seed that is at most so long, with the length of the shortest,
/// nearest first, then by id. Each seed comes with the length at which it starts.
///
/// The length is never less than the distance along the surface. How much more it is depends on the triangles: on a plane of
/// equilateral ones 2/√3 = 1.155 times at most, on one of squares with diagonals √2 times, and without a bound where they are
/// slivers. Refining does not mend that, as halves of edges lead nowhere else.
///
/// # Panics
/// If there is no such seed.
///
/// # Complexity
/// O(n log n) for the n edges at what is found, independent of the mesh once `scratch` has its size.
///
/// ```
/// use vvmesh::{VertexId, query, scratch::Scratch, shapes};
/// let mesh = shapes::grid(9, 9);
/// let disk = query::path_disk(&mesh, [(VertexId::new(44), 0.0)], 1.0, &mut Scratch::new());
/// assert_eq!(disk.iter().map(|&(_, length)| length).collect::<Vec<_>>(), [0.0, 1.0, 1.0, 1.0, 1.0]);
/// ```
#[must_use]
pub fn path_disk(
    mesh: &Mesh,
    seeds: impl IntoIterator<Item = (VertexId, f64)>,
    radius: f64,
    scratch: &mut Scratch,
) -> Vec<(VertexId, f64)> {
    let mut reached = scratch.marks(mesh.vertex_count(), 1);
    // Bits of numbers that are not negative are ordered as they are.
    let entry = |v: VertexId, length: f64| Reverse((length.to_bits(), v));
    let within = |&(_, length): &(VertexId, f64)| (0.0..=radius).contains(&length);
    let mut open: BinaryHeap<_> = seeds.into_iter().filter(within).map(|(v, length)| entry(v, length)).collect();
    let mut found = Vec::new();
    while let Some(Reverse((bits, v))) = open.pop() {
        if !reached.insert(v) {
            continue;
        }
        let length = f64::from_bits(bits);
        found.push((v, length));
        let beyond = mesh.ring(v).iter().filter(|&w| !reached.is_set(w));
        let beyond = beyond.map(|w| (w, length + edge_length(mesh, Edge::new(v, w))));
        open.extend(beyond.filter(within).map(|(w, length)| entry(w, length)));
    }
    found
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::shapes;

    #[test]
    fn a_ball_does_not_reach_through_to_the_other_side() {
        // A strip folded over in the middle: vertex (7, 1) comes to lie right above (1, 1).
        let mut mesh = shapes::grid(8, 2);
        for position in mesh.positions_mut().iter_mut().filter(|position| position.x > 4.0) {
            *position = DVec3::new(8.0 - position.x, position.y, 0.1);
        }
        let [v, above] = [10, 16].map(VertexId::new);
        let disk = ball_disk(&mesh, [v], mesh.position(v), 1.0, &mut Scratch::new());
        assert!(mesh.position(above).distance(mesh.position(v)) < 0.2 && !disk.contains(&above));
        assert_eq!(disk.into_iter().collect::<BTreeSet<_>>(), [1, 9, 10, 11, 19].map(VertexId::new).into());
    }

    #[test]
    fn seeds_belong_to_a_ball_and_only_near_ones_to_paths() {
        let mesh = shapes::grid(2, 2);
        let (far, mut scratch) = (VertexId::new(8), Scratch::new());
        assert_eq!(ball_disk(&mesh, [far, far], DVec3::ZERO, 0.1, &mut scratch), [far]);
        assert!(path_disk(&mesh, [(far, 0.2)], 0.1, &mut scratch).is_empty());
        assert_eq!(path_disk(&mesh, [(far, 0.2), (far, 0.1), (far, f64::NAN)], 0.1, &mut scratch), [(far, 0.1)]);
    }
}
