//! Values of vertices that go along with a mesh.

use std::collections::HashMap;
use std::mem;
use std::ops::{Add, Mul};

use super::follow::{Follower, StepMasks, ValueId};
use crate::id::VertexId;

/// A value for each vertex, and those that are kept beside them. A [`Follower`] for whatever can be weighed and added.
///
/// Values that are the positions come out with the bits of the positions.
///
/// ```
/// use vvmesh::adaptive::Uniform;
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider, Values};
/// use vvmesh::shapes;
///
/// let mut mesh = shapes::icosahedron();
/// let mut heat = Values::new(mesh.positions().iter().map(|position| position.x).collect());
/// let mut history = History::new(&mesh, Keep::default());
/// let control = &mut Control { follower: Some(&mut heat), ..Control::default() };
/// let (subdivider, all) = (Subdivider::new(Loop::default(), Uniform), Selection::empty());
/// subdivider.step(&mut mesh, &mut history, &all, &mut Scratch::new(), control)?;
/// assert!(mesh.positions().iter().map(|position| position.x).eq(heat.into_shown()));
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Values<T> {
    shown: Vec<T>,
    /// By vertex and number.
    kept: HashMap<(VertexId, u8), T>,
}

impl<T> Values<T> {
    /// The values of all vertices, in order.
    #[must_use]
    pub fn new(shown: Vec<T>) -> Self {
        Self { shown, kept: HashMap::new() }
    }

    /// The values of the vertices, in order.
    #[must_use]
    pub fn shown(&self) -> &[T] {
        &self.shown
    }

    /// The values of the vertices, in order.
    #[must_use]
    pub fn into_shown(self) -> Vec<T> {
        self.shown
    }

    /// A value.
    ///
    /// # Panics
    /// If there is no such value.
    #[must_use]
    pub fn get(&self, id: ValueId) -> &T {
        match id {
            ValueId::Shown(v) => &self.shown[v.index()],
            ValueId::Kept(v, k) => {
                self.kept.get(&(v, k)).expect("what follows has followed every step that keeps values")
            }
        }
    }

    /// Puts a value in its place, `None` takes a kept one away; answers what was there.
    pub(crate) fn put(&mut self, id: ValueId, value: Option<T>) -> Option<T> {
        match (id, value) {
            (ValueId::Shown(v), Some(value)) => Some(mem::replace(&mut self.shown[v.index()], value)),
            (ValueId::Shown(_), None) => unreachable!("a vertex has a value"),
            (ValueId::Kept(v, k), Some(value)) => self.kept.insert((v, k), value),
            (ValueId::Kept(v, k), None) => self.kept.remove(&(v, k)),
        }
    }

    /// Appends a value, of a vertex that is appended to the mesh.
    pub(crate) fn push(&mut self, value: T) {
        self.shown.push(value);
    }

    /// Makes room for the new vertices of a step.
    ///
    /// # Panics
    /// If the step is one of another mesh, with not as many vertices as there are values.
    pub(crate) fn grow(&mut self, step: &StepMasks<'_>, value: T)
    where
        T: Clone,
    {
        assert_eq!(step.vertex_count_before(), self.shown.len(), "the mesh is the one that was followed");
        self.shown.resize(step.vertex_count_after(), value);
    }

    /// All values, those that are kept too, to be changed in place.
    #[cfg(feature = "matrix")]
    pub(crate) fn all_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.shown.iter_mut().chain(self.kept.values_mut())
    }

    /// Whether any are kept.
    pub(crate) fn keeps_any(&self) -> bool {
        !self.kept.is_empty()
    }
}

impl<T> Follower for Values<T>
where
    T: Copy + Default + Add<Output = T>,
    f64: Mul<T, Output = T>,
{
    /// Takes one step. O(region).
    ///
    /// # Panics
    /// If the step is one of another mesh, with not as many vertices as there are values, or steps before it were not
    /// followed.
    fn follow(&mut self, step: &StepMasks<'_>) {
        self.grow(step, T::default());
        step.replay(
            self,
            |values, _, mask| mask.apply(|id| *values.get(id)),
            |values, id, value| {
                values.put(id, value);
            },
        );
    }

    fn has_kept(&self) -> bool {
        self.keeps_any()
    }
}
