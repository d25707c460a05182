//! Boxes around faces, in a hierarchy that grows with the mesh.

use std::cell::Cell;

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree, RTreeObject, SelectionFunction};

use super::ray::Sight;
use super::{Hit, Ray};
use crate::id::{Triangle, VertexId};
use crate::mesh::Mesh;
use crate::query::measure::{bounds, corner_positions};

/// A face in the box that it had when it was put in.
type Leaf = GeomWithData<Rectangle<[f64; 3]>, Triangle>;

/// What a face takes in a hierarchy: its leaf, and its part of the boxes above.
const BYTES_A_FACE: usize = 100;

/// The faces of a mesh, to be picked by rays while the mesh is refined.
///
/// It holds boxes and names of faces, no mesh: each call is given the mesh, and what it finds are faces of that mesh, at the
/// positions that it has. Whoever changes a mesh has to [tell](FaceTree::update).
///
/// ```
/// use vvmesh::glam::DVec3;
/// use vvmesh::pick::{FaceTree, Ray};
/// use vvmesh::shapes;
///
/// let mesh = shapes::octahedron();
/// let tree = FaceTree::new(&mesh);
/// let hit = tree.pick(&mesh, &Ray::new(DVec3::new(0.2, 0.2, 3.0), -DVec3::Z)?).expect("it is below");
/// assert_eq!(hit.face, mesh.triangles().next().expect("it has eight"));
/// assert!((hit.distance - 2.4).abs() < 1e-15);
/// # Ok::<(), vvmesh::error::ConfigError>(())
/// ```
#[derive(Clone, Debug)]
pub struct FaceTree {
    /// Each has more faces than the one behind it. A face may be in several, or be no more: a hit counts if the mesh has it.
    parts: Vec<RTree<Leaf>>,
    /// The power of two by which coordinates are multiplied in boxes, so that none is above 1 at first.
    scale: f64,
}

impl FaceTree {
    /// All faces of a mesh.
    ///
    /// # Complexity
    /// O(n log n) for n faces; about 100 bytes for each.
    #[must_use]
    pub fn new(mesh: &Mesh) -> Self {
        let greatest = bounds(mesh).map_or(0.0, |bounds| bounds.min.abs().max(bounds.max.abs()).max_element());
        let mut tree = Self { parts: Vec::new(), scale: power_below_inverse(greatest) };
        tree.push(mesh, mesh.triangles().collect());
        tree
    }

    /// Goes on to a mesh in which nothing but these vertices have another ring or position than they had, and new ones are
    /// among them. In any order, with repetitions.
    ///
    /// # Panics
    /// If there is no such vertex.
    ///
    /// # Complexity
    /// With f faces around the vertices O(f log² n) amortised: boxes are put into small hierarchies, and those of like size
    /// are joined to a larger one, where the faces that are no more are left out.
    pub fn update(&mut self, mesh: &Mesh, vertices: impl IntoIterator<Item = VertexId>) {
        let around = vertices.into_iter().flat_map(|v| mesh.rotation().triangles_around(v));
        let mut faces = distinct(around.collect());
        while self.parts.last().is_some_and(|part| part.size() <= faces.len()) {
            let joined = self.parts.pop().into_iter().flatten().map(|leaf| leaf.data);
            faces.extend(joined.filter(|&face| has_face(mesh, face)));
        }
        self.push(mesh, distinct(faces));
    }

    /// The place where a ray meets the mesh first, from either side; of several at the very same distance that on the smallest
    /// face.
    ///
    /// # Complexity
    /// O(boxes on the way to the first hit), usually O(log n).
    #[must_use]
    pub fn pick(&self, mesh: &Mesh, ray: &Ray) -> Option<Hit> {
        let reach = |part: &RTree<Leaf>| {
            let root = part.root().envelope();
            [root.lower(), root.upper()].into_iter().flatten().fold(0.0, |reach: f64, x| reach.max(x.abs()))
        };
        let sight = Sight::new(ray, self.scale, self.parts.iter().map(reach).fold(0.0, f64::max))?;
        let within = Cell::new(f64::MAX);
        let mut nearest: Option<Hit> = None;
        for part in &self.parts {
            for leaf in part.locate_with_selection_function(Nearer { sight: &sight, within: &within }) {
                let face = leaf.data;
                let hit = if has_face(mesh, face) { sight.meet(mesh, face) } else { None };
                if let Some(hit) = hit.filter(|hit| nearest.is_none_or(|nearest| hit.is_before(&nearest))) {
                    within.set(hit.distance);
                    nearest = Some(hit);
                }
            }
        }
        nearest.map(|hit| Hit { distance: hit.distance / self.scale, ..hit })
    }

    /// Bytes held, about: the hierarchies do not tell how full their inner boxes are.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.parts.iter().map(RTree::size).sum::<usize>() * BYTES_A_FACE
    }

    fn push(&mut self, mesh: &Mesh, faces: Vec<Triangle>) {
        if !faces.is_empty() {
            let leaves = faces.into_iter().map(|face| self.leaf(mesh, face)).collect();
            self.parts.push(RTree::bulk_load(leaves));
        }
    }

    fn leaf(&self, mesh: &Mesh, face: Triangle) -> Leaf {
        let [a, b, c] = corner_positions(mesh, face).map(|position| position * self.scale);
        let (lower, upper) = (a.min(b).min(c), a.max(b).max(c));
        GeomWithData::new(Rectangle::from_corners(lower.to_array(), upper.to_array()), face)
    }
}

/// A power of two that brings a number to at most 1; 1 for 0.
fn power_below_inverse(number: f64) -> f64 {
    // Not beyond what can be inverted.
    if number > 0.0 { 2_f64.powi((-number.log2().ceil() as i32).clamp(-1000, 1000)) } else { 1.0 }
}

fn distinct(mut faces: Vec<Triangle>) -> Vec<Triangle> {
    faces.sort_unstable();
    faces.dedup();
    faces
}

fn has_face(mesh: &Mesh, face: Triangle) -> bool {
    let [a, b, c] = face.corners();
    mesh.rotation().contains(a) && mesh.rotation().left_of(a, b) == Some(c)
}

/// The boxes that a ray enters no later than where it met a face already.
struct Nearer<'a> {
    sight: &'a Sight,
    within: &'a Cell<f64>,
}

impl Nearer<'_> {
    fn is_entered(&self, envelope: &AABB<[f64; 3]>) -> bool {
        self.sight.entry(envelope.lower(), envelope.upper()) <= self.within.get()
    }
}

impl SelectionFunction<Leaf> for Nearer<'_> {
    fn should_unpack_parent(&self, envelope: &AABB<[f64; 3]>) -> bool {
        self.is_entered(envelope)
    }

    fn should_unpack_leaf(&self, leaf: &Leaf) -> bool {
        self.is_entered(&leaf.envelope())
    }
}
