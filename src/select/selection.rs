//! A set of vertices, of edges or of faces.

use crate::id::{Edge, Triangle, VertexId};
use crate::mesh::Mesh;
use crate::parallel;
use crate::rotation::RotationSystem;

/// A set of vertices, of edges or of faces, kept ascending.
///
/// What works on vertices takes those of an edge for its ends and of a face for its corners:
/// [`vertices`](Selection::vertices) are always there. The other way round, a set of vertices
/// [has a face](Selection::contains_face) whose corners are all in it, and an edge with both ends in it.
///
/// Sets of one kind combine to one of that kind. In any mix edges become their ends and faces their corners.
///
/// ```
/// use vvmesh::select::{Elements, Selection};
/// use vvmesh::{VertexId, shapes};
///
/// let mesh = shapes::octahedron();
/// let two: Selection = mesh.triangles().take(2).collect();
/// assert_eq!((two.len(), two.vertices().len(), two.complement(&mesh).len()), (2, 4, 6));
/// let corner: Selection = [VertexId::new(0)].into_iter().collect();
/// assert!(matches!(two.intersection(&corner).elements(), Elements::Vertices([_])));
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Selection {
    /// Those of the members.
    vertices: Vec<VertexId>,
    members: Members,
}

/// What is in a set beside its vertices, ascending.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
enum Members {
    #[default]
    None,
    Edges(Vec<Edge>),
    Faces(Vec<Triangle>),
}

/// What is in a [`Selection`], ascending.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Elements<'a> {
    /// Vertices.
    Vertices(&'a [VertexId]),
    /// Edges.
    Edges(&'a [Edge]),
    /// Faces.
    Faces(&'a [Triangle]),
}

/// What a mesh has not.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Unknown {
    Vertex(VertexId),
    Edge(Edge),
    Face(Triangle),
}

impl Selection {
    /// The empty set of vertices.
    #[must_use]
    pub fn empty() -> Self {
        Self::default()
    }

    /// All vertices of a mesh with this many.
    #[must_use]
    pub fn all(vertex_count: usize) -> Self {
        Self::ascending((0..vertex_count).map(VertexId::new).collect())
    }

    /// These vertices, which come ascending, each once.
    pub(crate) fn ascending(vertices: Vec<VertexId>) -> Self {
        debug_assert!(vertices.is_sorted_by(|a, b| a < b));
        Self { vertices, members: Members::None }
    }

    /// These edges, which come ascending, each once.
    pub(crate) fn of_edges(edges: Vec<Edge>) -> Self {
        debug_assert!(edges.is_sorted_by(|a, b| a < b));
        Self { vertices: sorted(edges.iter().flat_map(|edge| edge.ends())), members: Members::Edges(edges) }
    }

    /// These faces, which come ascending, each once.
    pub(crate) fn of_faces(faces: Vec<Triangle>) -> Self {
        debug_assert!(faces.is_sorted_by(|a, b| a < b));
        Self { vertices: sorted(faces.iter().flat_map(|face| face.corners())), members: Members::Faces(faces) }
    }

    /// The vertices, ascending, as the list itself.
    #[must_use]
    pub fn into_vertices(self) -> Vec<VertexId> {
        self.vertices
    }

    /// Those of a mesh with this many vertices that pass a test.
    pub(super) fn of_those(vertex_count: usize, test: impl Fn(VertexId) -> bool + Sync + Send) -> Self {
        let passing = |v: usize| Some(VertexId::new(v)).filter(|&v| test(v));
        Self::ascending(parallel::gather(0..vertex_count, passing))
    }

    /// The vertices, the ends of the edges or the corners of the faces, ascending.
    #[must_use]
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// What is in the set: this tells of which kind it is.
    #[must_use]
    pub fn elements(&self) -> Elements<'_> {
        match &self.members {
            Members::None => Elements::Vertices(&self.vertices),
            Members::Edges(edges) => Elements::Edges(edges),
            Members::Faces(faces) => Elements::Faces(faces),
        }
    }

    /// The same as a set of vertices.
    #[must_use]
    pub fn to_vertices(&self) -> Self {
        Self::ascending(self.vertices.clone())
    }

    /// How many vertices, edges or faces there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self.elements() {
            Elements::Vertices(vertices) => vertices.len(),
            Elements::Edges(edges) => edges.len(),
            Elements::Faces(faces) => faces.len(),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Whether a vertex is among the [`vertices`](Selection::vertices). O(log n).
    #[must_use]
    pub fn contains(&self, v: VertexId) -> bool {
        self.vertices.binary_search(&v).is_ok()
    }

    /// Whether a face is in a set of faces; of another set whether all its corners are among the vertices. O(log n).
    #[must_use]
    pub fn contains_face(&self, face: Triangle) -> bool {
        match self.elements() {
            Elements::Faces(faces) => faces.binary_search(&face).is_ok(),
            Elements::Vertices(_) | Elements::Edges(_) => face.corners().into_iter().all(|v| self.contains(v)),
        }
    }

    /// The first element that a mesh with these rings has not.
    pub(crate) fn first_unknown(&self, rotation: &RotationSystem) -> Option<Unknown> {
        let is_unknown = |v: &&VertexId| !rotation.contains(**v);
        // Ascending, so what is unknown comes last.
        if self.vertices.last().filter(is_unknown).is_some() {
            return self.vertices.iter().find(is_unknown).map(|&v| Unknown::Vertex(v));
        }
        match self.elements() {
            Elements::Vertices(_) => None,
            Elements::Edges(edges) => {
                let exists = |edge: &Edge| rotation.has_edge(edge.ends()[0], edge.ends()[1]);
                edges.iter().copied().find(|edge| !exists(edge)).map(Unknown::Edge)
            }
            Elements::Faces(faces) => {
                let exists = |face: &Triangle| rotation.has_triangle(*face);
                faces.iter().copied().find(|face| !exists(face)).map(Unknown::Face)
            }
        }
    }

    /// Whether it is a set of vertices.
    #[must_use]
    pub fn is_of_vertices(&self) -> bool {
        self.members == Members::None
    }

    /// Whether both are sets of the same kind.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(&self.members) == std::mem::discriminant(&other.members)
    }

    /// What is in one of the two. O(n), and of edges and faces O(n log n).
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        match (self.elements(), other.elements()) {
            (Elements::Edges(one), Elements::Edges(two)) => Self::of_edges(merged(one, two)),
            (Elements::Faces(one), Elements::Faces(two)) => Self::of_faces(merged(one, two)),
            _ => Self::ascending(merged(&self.vertices, &other.vertices)),
        }
    }

    /// What is in both. O(n log m) with n elements in the smaller set and m in the other.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        match (self.elements(), other.elements()) {
            (Elements::Edges(one), Elements::Edges(two)) => Self::of_edges(common(one, two)),
            (Elements::Faces(one), Elements::Faces(two)) => Self::of_faces(common(one, two)),
            _ => Self::ascending(common(&self.vertices, &other.vertices)),
        }
    }

    /// What a mesh has of the kind outside of the set. O(vertices), and of edges and faces O(n log n) with n in the mesh.
    #[must_use]
    pub fn complement(&self, mesh: &Mesh) -> Self {
        match self.elements() {
            Elements::Vertices(inside) => Self::ascending(outside(mesh.vertices(), inside)),
            Elements::Edges(inside) => Self::of_edges(outside(sorted(mesh.edges()), inside)),
            Elements::Faces(inside) => Self::of_faces(outside(sorted(mesh.triangles()), inside)),
        }
    }
}

/// In any order, with repetitions.
impl FromIterator<VertexId> for Selection {
    fn from_iter<I: IntoIterator<Item = VertexId>>(vertices: I) -> Self {
        Self::ascending(sorted(vertices))
    }
}

/// In any order, with repetitions.
impl FromIterator<Edge> for Selection {
    fn from_iter<I: IntoIterator<Item = Edge>>(edges: I) -> Self {
        Self::of_edges(sorted(edges))
    }
}

/// In any order, with repetitions.
impl FromIterator<Triangle> for Selection {
    fn from_iter<I: IntoIterator<Item = Triangle>>(faces: I) -> Self {
        Self::of_faces(sorted(faces))
    }
}

/// Ascending, each once.
fn sorted<T: Ord>(elements: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut elements: Vec<T> = elements.into_iter().collect();
    elements.sort_unstable();
    elements.dedup();
    elements
}

/// What is in one of two ascending lists.
fn merged<T: Ord + Copy>(one: &[T], two: &[T]) -> Vec<T> {
    let mut elements = [one, two].concat();
    // The stable sort finds the two runs and merges them.
    elements.sort();
    elements.dedup();
    elements
}

/// What is in both of two ascending lists.
fn common<T: Ord + Copy>(one: &[T], two: &[T]) -> Vec<T> {
    let (small, large) = if one.len() <= two.len() { (one, two) } else { (two, one) };
    small.iter().copied().filter(|element| large.binary_search(element).is_ok()).collect()
}

/// What is in all, which come ascending, and not inside.
fn outside<T: Ord>(all: impl IntoIterator<Item = T>, inside: &[T]) -> Vec<T> {
    let mut inside = inside.iter().peekable();
    all.into_iter().filter(|element| inside.next_if(|&next| next == element).is_none()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn set(indices: &[usize]) -> Selection {
        indices.iter().copied().map(VertexId::new).collect()
    }

    #[test]
    fn sets_combine() {
        let (a, b) = (set(&[4, 1, 1, 3]), set(&[3, 0]));
        assert_eq!(a.union(&b), set(&[0, 1, 3, 4]));
        assert_eq!(a.intersection(&b), set(&[3]));
        let mesh = shapes::octahedron();
        assert_eq!(a.complement(&mesh), set(&[0, 2, 5]));
        assert_eq!(set(&[]).complement(&mesh), Selection::all(6));
    }

    #[test]
    fn sets_of_a_kind_stay_so_and_others_become_vertices() {
        let mesh = shapes::octahedron();
        let all: Vec<Triangle> = mesh.triangles().collect();
        let faces = |some: &[usize]| some.iter().map(|&k| all[k]).collect::<Selection>();
        let (one, two) = (faces(&[5, 1, 1]), faces(&[1, 3]));
        assert_eq!(one.union(&two), faces(&[1, 3, 5]));
        assert_eq!(one.intersection(&two), faces(&[1]));
        assert_eq!(one.complement(&mesh), faces(&[0, 2, 3, 4, 6, 7]));
        assert_eq!(one.intersection(&two).vertices(), Selection::from_iter(all[1].corners()).vertices());

        let edges: Selection = mesh.edges().take(2).collect();
        assert_eq!(edges.complement(&mesh).complement(&mesh), edges);
        assert_eq!(edges.union(&edges), edges);
        assert_eq!(edges.union(&faces(&[])), edges.to_vertices());
        assert_eq!(one.intersection(&Selection::all(6)), one.to_vertices());
    }
}
