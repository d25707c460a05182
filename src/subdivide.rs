//! The pipeline: one step of refinement, of any scheme, by any method.
//!
//! ```text
//! selection -> method.region -> split plan -> new positions -> split and closing in place -> selection that follows
//!              \_________________ reads only _______________/  \____ cannot fail ____/
//! ```
//!
//! Everything that can fail comes before the first write, so a step is made whole or not at all. Cost and extra memory
//! are those of the region and the rings next to it, not of the mesh.
//!
//! **Deliberately not here**: what is refined ([`crate::adaptive`]), weights ([`crate::scheme`]), rings
//! ([`crate::split`]).

use std::ops::ControlFlow;

use glam::DVec3;

use crate::adaptive::AdaptiveMethod;
use crate::certify::{self, Certificate};
use crate::error::RefineError;
use crate::id::{Edge, VertexId};
use crate::mesh::{Mesh, Neighborhood};
use crate::scheme::{AnyScheme, MaskSink, Scheme, with_scheme};
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::quadrisect::{self, Closing, Plan};
use crate::split::{Diagonal, Quad};
use crate::step::{History, Region};

/// After how many new positions they are stored, and the caller is asked whether to go on.
const BUFFERED: usize = 1 << 10;

/// How far a step is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Progress {
    /// New positions computed so far.
    pub done: usize,
    /// New positions of the step.
    pub total: usize,
}

/// What a caller may say about a step before and while it is made.
#[derive(Default)]
pub struct Control<'a> {
    /// How many faces the mesh may have after the step; `None` for any number.
    pub max_faces: Option<u64>,
    /// Called before every 1024 new positions; answering [`ControlFlow::Break`] ends the step, and the mesh stays as it
    /// was.
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
}

impl Control<'_> {
    fn allow(&self, needed: u64) -> Result<(), RefineError> {
        match self.max_faces {
            Some(allowed) if needed > allowed => Err(RefineError::TooManyFaces { needed, allowed }),
            _ => Ok(()),
        }
    }

    fn report(&mut self, done: usize, total: usize) -> Result<(), RefineError> {
        let stop = self.progress.as_mut().is_some_and(|callback| callback(Progress { done, total }).is_break());
        if stop { Err(RefineError::Cancelled) } else { Ok(()) }
    }
}

/// What a step did.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// The selection that follows: the selected vertices and every new one between two of them.
    pub selection: Selection,
    /// How many vertices were selected before the step.
    pub selected: usize,
    /// How many vertices took part in the step.
    pub region: usize,
    /// How many edges were split, which is the number of new vertices.
    pub split_edges: usize,
    /// The new vertices with a triangle beside them that was not split in four, ascending.
    pub t_vertices: Vec<VertexId>,
    /// The old vertices to which closing added neighbours, ascending.
    pub o_vertices: Vec<VertexId>,
    /// How many vertices of the mesh are certified after the step; `None` if the history keeps no certificate.
    pub certified: Option<usize>,
    /// Selected vertices for which this step was not proven exact although the method promises it, because the
    /// selection did not follow the refinement. Empty without a certificate.
    pub unproven: Vec<VertexId>,
}

/// A scheme and a method, ready to make steps.
///
/// ```
/// use vvmesh::adaptive::Incremental;
/// use vvmesh::scheme::Loop;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider};
/// use vvmesh::{VertexId, scratch::Scratch, shapes};
///
/// let mut mesh = shapes::icosahedron();
/// let mut history = History::new(&mesh, Keep::default());
/// let subdivider = Subdivider::new(Loop::default(), Incremental::new(1)?);
/// let selection: Selection = [VertexId::new(0)].into_iter().collect();
/// let step = subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), &mut Control::default())?;
/// assert_eq!((step.region, step.split_edges), (6, 10));
/// assert_eq!(mesh.face_count(), 20 + 20);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Subdivider {
    scheme: AnyScheme,
    method: Box<dyn AdaptiveMethod>,
    diagonal: Diagonal,
}

impl Subdivider {
    /// A scheme with a method.
    #[must_use]
    pub fn new(scheme: impl Into<AnyScheme>, method: impl AdaptiveMethod + 'static) -> Self {
        Self { scheme: scheme.into(), method: Box::new(method), diagonal: Diagonal::default() }
    }

    /// The same with another choice of diagonals in faces with two split edges.
    #[must_use]
    pub fn with_diagonal(mut self, diagonal: Diagonal) -> Self {
        self.diagonal = diagonal;
        self
    }

    /// Refines the region that the method chooses for a selection.
    ///
    /// # Errors
    /// A selected vertex that does not exist, more faces than [`Control::max_faces`], more vertices than 32-bit ids name,
    /// a 256th level, a position that is not finite, or the caller's wish to stop. The mesh and the history are then as
    /// before.
    ///
    /// # Panics
    /// If the method's region names a vertex or an edge that the mesh does not have.
    ///
    /// # Complexity
    /// Time and extra space O(region and the rings next to it), whatever the size of the mesh.
    pub fn step(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        if let Some(&last) = selection.vertices().last().filter(|last| last.index() >= mesh.vertex_count()) {
            return Err(RefineError::NoVertex(last));
        }
        let region = self.method.region(mesh, selection, scratch);
        let unproven = match Certificate::new(mesh, history) {
            Some(certificate) if self.method.promises_exactness() => {
                certificate.unproven(selection, self.scheme.reach())
            }
            _ => Vec::new(),
        };
        let refined = self.refine(mesh, history, &region, scratch, control)?;
        Ok(Step {
            selection: follow(selection, &refined.plan, mesh.vertex_count(), scratch),
            selected: selection.len(),
            region: refined.moving,
            split_edges: refined.plan.edges.len(),
            t_vertices: refined.closing.t_vertices,
            o_vertices: refined.closing.o_vertices,
            certified: refined.certified,
            unproven,
        })
    }

    /// Refines a region as it is given.
    fn refine(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        region: &Region,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Refined, RefineError> {
        if region.is_everything() {
            control.allow(4 * mesh.face_count() as u64)?;
        }
        let plan = quadrisect::plan(mesh.rotation(), history, region, scratch);
        let vertices_after = (plan.first + plan.edges.len()) as u64;
        control.allow((mesh.face_count() + plan.added_faces) as u64)?;
        if vertices_after > VertexId::MAX_INDEX as u64 + 1 {
            return Err(RefineError::TooManyVertices { needed: vertices_after });
        }
        let levels = child_levels(history, &plan)?;

        let moving = region.vertices(mesh.vertex_count());
        let moved = with_scheme!(&self.scheme, scheme => new_positions(scheme, mesh, &moving, &plan, control)?);

        // From here on nothing can fail.
        let (reach, moves_even) = (self.scheme.reach(), self.scheme.moves_even());
        let handed = history
            .exactness_mut()
            .map(|exactness| certify::before(exactness, mesh, &moving, &plan, reach, moves_even));
        for (&v, position) in moving.iter().zip(moved) {
            mesh.positions_mut()[v.index()] = position;
        }
        let closing = split(mesh, &plan, self.diagonal);

        let certified = handed.and_then(|handed| {
            certify::after(history.exactness_mut()?, &handed, mesh, &moving, &plan, &closing);
            // Only what took part can be certified, as the proof of a rotation lapses elsewhere.
            let certificate = Certificate::new(mesh, history)?;
            let new = plan.odd().map(|(x, _)| x);
            Some(moving.iter().copied().chain(new).filter(|&v| certificate.is_certified(v)).count())
        });
        let made = levels.into_iter().zip(plan.edges.iter().map(quadrisect::SplitEdge::ends));
        history.record(mesh.vertex_count(), made, &closing.edges, closing.max_valence);
        Ok(Refined { moving: moving.len(), plan, closing, certified })
    }
}

struct Refined {
    moving: usize,
    plan: Plan,
    closing: Closing,
    certified: Option<usize>,
}

/// The levels of the new vertices; empty if names are not kept.
fn child_levels(history: &History, plan: &Plan) -> Result<Vec<u8>, RefineError> {
    if !history.has_names() {
        return Ok(Vec::new());
    }
    plan.edges.iter().map(|edge| history.child_level(edge.ends())).collect()
}

/// Appends the positions of the new vertices and answers with those of the moved ones, which are not written yet.
///
/// Both are computed from the old positions. After an error the positions are as before.
fn new_positions<S: Scheme>(
    scheme: &S,
    mesh: &mut Mesh,
    moving: &[VertexId],
    plan: &Plan,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let (rotation, positions, tags) = mesh.parts_mut();
    let around = Neighborhood::new(rotation, tags);
    let computed = compute(scheme, around, positions, moving, plan, control);
    if computed.is_err() {
        positions.truncate(plan.first);
    }
    computed
}

fn compute<S: Scheme>(
    scheme: &S,
    around: Neighborhood<'_>,
    positions: &mut Vec<DVec3>,
    moving: &[VertexId],
    plan: &Plan,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let moving = if scheme.moves_even() { moving } else { &[] };
    let total = moving.len() + plan.edges.len();
    positions.reserve(plan.edges.len());
    // A few at a time, as what is appended to can not be read from; the buffer stays in the cache.
    let mut buffer = Vec::with_capacity(BUFFERED.min(plan.edges.len()));
    for chunk in plan.edges.chunks(BUFFERED) {
        control.report(positions.len() - plan.first, total)?;
        for edge in chunk {
            let mut sum = WeightedSum::new(positions);
            scheme.odd(around, &edge.parent(around), &mut sum);
            buffer.push(sum.finite(edge.ends()[0])?);
        }
        positions.append(&mut buffer);
    }
    let mut moved = Vec::with_capacity(moving.len());
    for chunk in moving.chunks(BUFFERED) {
        control.report(plan.edges.len() + moved.len(), total)?;
        for &v in chunk {
            let mut sum = WeightedSum::new(positions);
            scheme.even(around, v, &mut sum);
            moved.push(sum.finite(v)?);
        }
    }
    Ok(moved)
}

/// A mask applied to positions as it comes, group by group.
struct WeightedSum<'a> {
    positions: &'a [DVec3],
    /// `None` before the first group, as 0 + (-0) is not -0.
    total: Option<DVec3>,
}

impl<'a> WeightedSum<'a> {
    #[inline]
    fn new(positions: &'a [DVec3]) -> Self {
        Self { positions, total: None }
    }

    /// The sum, or the error that it is not finite, for which the vertex to blame is named.
    #[inline]
    fn finite(self, v: VertexId) -> Result<DVec3, RefineError> {
        self.total.filter(|total| total.is_finite()).ok_or(RefineError::NonFinite(v))
    }
}

impl MaskSink for WeightedSum<'_> {
    #[inline]
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        let group = vertices.into_iter().map(|v| self.positions[v.index()]).reduce(|sum, position| sum + position);
        if let Some(group) = group {
            let group = weight * group;
            self.total = Some(self.total.map_or(group, |total| total + group));
        }
    }
}

/// Splits rings and tags; positions are those after the step.
fn split(mesh: &mut Mesh, plan: &Plan, diagonal: Diagonal) -> Closing {
    let (rotation, positions, tags) = mesh.parts_mut();
    if !tags.is_empty() {
        for (x, edge) in plan.odd() {
            let [p, q] = edge.ends();
            tags.split(Edge::new(p, q), x);
        }
    }
    quadrisect::apply(rotation, plan, |quad: Quad, valences| diagonal.start(quad, valences, positions))
}

/// S' = S and every new vertex between two vertices of S. O(S and the region).
fn follow(selection: &Selection, plan: &Plan, vertex_count: usize, scratch: &mut Scratch) -> Selection {
    let mut marks = scratch.marks(vertex_count, 1);
    for &v in selection.vertices() {
        marks.set(v, 0);
    }
    let between = plan.odd().filter(|(_, edge)| edge.ends().iter().all(|&end| marks.is_set(end))).map(|(x, _)| x);
    selection.vertices().iter().copied().chain(between).collect()
}
