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
//! What belongs to the vertices beside their positions can go along: see [`Follower`].
//!
//! **Deliberately not here**: what is refined ([`crate::adaptive`]), weights ([`crate::scheme`]), rings
//! ([`crate::split`]).

mod bisect;
mod follow;
mod positions;
mod trisect;

pub use follow::{Assignment, Follower, StepMasks};

use std::ops::ControlFlow;

use crate::adaptive::AdaptiveMethod;
use crate::certify::{self, Certificate};
use crate::error::RefineError;
use crate::id::{Edge, VertexId};
use crate::mesh::Mesh;
use crate::scheme::{AnyScheme, with_scheme};
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::quadrisect::{self, Closing, Plan};
use crate::split::whole::Whole;
use crate::split::{Diagonal, Quad};
use crate::step::{History, Lineage, Region, SplitKind};

/// What holds of a scheme on the way of the split in four.
const OTHERS: &str = "schemes of other splits have ways of their own";

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
    /// Called before the first new position and again and again: before every 1024 of a region, and of a whole mesh before
    /// those around every 65,536 old vertices. Answering [`ControlFlow::Break`] ends the step, and the mesh stays as it was.
    pub progress: Option<&'a mut dyn FnMut(Progress) -> ControlFlow<()>>,
    /// What goes along with the mesh.
    pub follower: Option<&'a mut dyn Follower>,
}

impl Control<'_> {
    /// Whether a step may leave so many vertices and add so many faces to those there are.
    fn allow(&self, vertices: usize, faces: usize, added_faces: usize) -> Result<(), RefineError> {
        if vertices > VertexId::MAX_INDEX + 1 {
            return Err(RefineError::TooManyVertices { needed: vertices as u64 });
        }
        let needed = faces as u64 + added_faces as u64;
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
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Step {
    /// The selection that follows: the selected vertices and every new one between two of them, under √3 in a triangle of
    /// three of them.
    pub selection: Selection,
    /// How many vertices were selected before the step.
    pub selected: usize,
    /// How many vertices took part in the step.
    pub region: usize,
    /// How many edges were split, which is the number of new vertices; under √3 the boundary edges that were cut in three.
    pub split_edges: usize,
    /// The new vertices with a triangle beside them that was not split in four, ascending; none under √3 and 4-8.
    pub t_vertices: Vec<VertexId>,
    /// The old vertices to which closing added neighbours, ascending; none under √3 and 4-8.
    pub o_vertices: Vec<VertexId>,
    /// How many vertices of the mesh are certified after the step; `None` if the history keeps no certificate, as under √3 and
    /// 4-8.
    pub certified: Option<usize>,
    /// Selected vertices for which this step was not proven exact although the method promises it, because the
    /// selection did not follow the refinement. Empty without a certificate.
    pub unproven: Vec<VertexId>,
}

impl Step {
    /// Gives the memory of the lists back, for the steps that follow.
    ///
    /// A run of steps of like size that does so, and passes the same `scratch` to every step, allocates nothing but for a
    /// growing mesh and for rings of more than six neighbours (five if open). A certificate takes one list a step more.
    pub fn recycle(self, scratch: &mut Scratch) {
        for list in [self.selection.into_vertices(), self.t_vertices, self.o_vertices, self.unproven] {
            scratch.give_list(list);
        }
    }
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

    /// The scheme.
    #[must_use]
    pub fn scheme(&self) -> &AnyScheme {
        &self.scheme
    }

    /// Refines the region that the method chooses for a selection.
    ///
    /// # Errors
    /// A selected vertex that does not exist, a history of another [`SplitKind`] or under √3 of other methods, a
    /// follower without masks to follow, semi-sharp tags that the scheme cannot blend, more faces than
    /// [`Control::max_faces`], more vertices than 32-bit ids name, a 256th level, a position that is not finite, or the
    /// caller's wish to stop. The mesh and the history are then as before.
    ///
    /// # Panics
    /// If the method's region names a vertex or an edge that the mesh does not have.
    ///
    /// # Complexity
    /// Time and extra space O(region and the rings next to it), whatever the size of the mesh. Extra space is taken from
    /// `scratch` and given back, but for the lists of the answer; see [`Step::recycle`].
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
        history.allow(self.scheme.split_kind())?;
        if mesh.tags().has_semi_sharp() && self.scheme.reads_tags() && !self.scheme.blends_sharpness() {
            return Err(RefineError::SemiSharp);
        }
        let region = self.method.region(mesh, selection, scratch);
        let step = match &self.scheme {
            AnyScheme::Sqrt3(scheme) => {
                let exact = self.method.promises_exactness();
                trisect::step(scheme, exact, mesh, history, selection, &region, scratch, control)
            }
            AnyScheme::FourEight(scheme) => bisect::step(scheme, mesh, history, selection, &region, scratch, control),
            _ => self.quadrisect(mesh, history, selection, &region, scratch, control),
        };
        scratch.give_list(region.into_list());
        step
    }

    /// Refines a region, or the whole mesh.
    fn quadrisect(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        region: &Region,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        let promised = self.scheme.reach().filter(|_| self.method.promises_exactness());
        let unproven = match Certificate::new(mesh, history).zip(promised) {
            Some((certificate, reach)) => certificate.unproven(selection, reach),
            None => Vec::new(),
        };
        // The short way numbers and places everything alike, but does not say where the new vertices come from.
        let step = if region.is_everything() && !history.tells_vertices_apart() {
            self.refine_whole(mesh, history, selection, scratch, control)?
        } else {
            self.refine(mesh, history, selection, region, scratch, control)?
        };
        Ok(Step { unproven, ..step })
    }

    /// Refines the whole mesh.
    fn refine_whole(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        let (old, new) = (mesh.vertex_count(), mesh.edge_count());
        control.allow(old + new, mesh.face_count(), 3 * mesh.face_count())?;
        let whole = Whole::new(mesh.rotation(), history);
        let new_positions = with_scheme!(&self.scheme,
            scheme => positions::of_whole(scheme, mesh, &whole, control)?,
            else unreachable!("{OTHERS}"));

        // From here on nothing can fail.
        with_scheme!(&self.scheme, scheme => {
            control.show(old, old + new, |masks| positions::show_whole(scheme, mesh, &whole, masks));
        }, else unreachable!("{OTHERS}"));
        let mut followed = scratch.take_list();
        followed.extend_from_slice(selection.vertices());
        if selection.len() == old {
            followed.extend((old..old + new).map(VertexId::new));
        } else {
            let marks = scratch.marked(old, selection.vertices());
            whole.append_between(selection.vertices(), |w| marks.is_set(w), &mut followed);
        }
        let rings = whole.rings();
        let mut sharp: Vec<(VertexId, Edge)> =
            mesh.tags().sharp_edges().into_iter().map(|edge| (whole.on(edge), edge)).collect();
        sharp.sort_unstable();
        let (rotation, positions, tags) = mesh.parts_mut();
        *positions = new_positions;
        // In the order of the new vertices, as when a region is split.
        tags.refine(rotation, sharp.into_iter(), (0..old).map(VertexId::new));
        let max_valence = match new {
            0 => 0,
            edges if edges == rotation.boundary_edge_count() => 4,
            _ => 6,
        };
        rotation.replace_by_split(rings);
        history.record(SplitKind::Quadrisect, old + new, std::iter::empty(), &[], max_valence);
        let certified = history.exactness_mut().map(|exactness| {
            exactness.advance(old + new, self.scheme.moves_even());
            old + new
        });
        Ok(Step {
            selection: Selection::ascending(followed),
            selected: selection.len(),
            region: old,
            split_edges: new,
            certified,
            ..Step::default()
        })
    }

    /// Refines a region as it is given.
    fn refine(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        region: &Region,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        if region.is_everything() {
            control.allow(mesh.vertex_count() + mesh.edge_count(), mesh.face_count(), 3 * mesh.face_count())?;
        }
        let mut buffers = scratch.take::<Buffers>();
        let step = self.refine_with(&mut buffers, mesh, history, selection, region, scratch, control);
        scratch.give(buffers);
        step
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "those of a step, and its buffers apart from the scratch they lie in"
    )]
    fn refine_with(
        &self,
        buffers: &mut Buffers,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        region: &Region,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        let Buffers { plan, levels, positions, handed, closing } = buffers;
        let moving = region.vertices(mesh.vertex_count());
        quadrisect::plan(plan, mesh.rotation(), history, region, &moving, scratch);
        control.allow(plan.first + plan.edges.len(), mesh.face_count(), plan.added_faces)?;
        child_levels(levels, history, plan)?;
        with_scheme!(&self.scheme, scheme => {
            positions::append_odd(scheme, mesh, &moving, plan, positions, control)?;
        }, else unreachable!("{OTHERS}"));

        // From here on nothing can fail.
        with_scheme!(&self.scheme, scheme => {
            let (before, after) = (plan.first, plan.first + plan.edges.len());
            control.show(before, after, |masks| positions::show_region(scheme, mesh, &moving, plan, masks));
        }, else unreachable!("{OTHERS}"));
        if let Some(exactness) = history.exactness_mut() {
            let reach = self.scheme.reach().expect(OTHERS);
            let moves_even = self.scheme.moves_even();
            certify::before(handed, exactness, mesh, &moving, plan, reach, moves_even);
        }
        for (&v, &position) in moving.iter().zip(&positions.moved) {
            mesh.positions_mut()[v.index()] = position;
        }
        split(mesh, plan, &moving, closing, self.diagonal);

        let certified = history.exactness_mut().map(|exactness| {
            certify::after(exactness, handed, mesh, &moving, plan, closing);
            // Only what took part can be certified, as the proof of a rotation lapses elsewhere.
            let new = plan.odd().map(|(x, _)| x);
            moving.iter().copied().chain(new).filter(|&v| certify::is_certified(exactness, mesh, v)).count()
        });
        let made = levels.iter().copied().zip(plan.edges.iter().map(|edge| Lineage::Edge(edge.ends())));
        history.record(SplitKind::Quadrisect, mesh.vertex_count(), made, &closing.edges, closing.max_valence);
        Ok(Step {
            selection: follow(selection, plan, mesh.vertex_count(), scratch),
            selected: selection.len(),
            region: moving.len(),
            split_edges: plan.edges.len(),
            t_vertices: std::mem::replace(&mut closing.t_vertices, scratch.take_list()),
            o_vertices: std::mem::replace(&mut closing.o_vertices, scratch.take_list()),
            certified,
            unproven: Vec::new(),
        })
    }
}

/// What a step needs while it is made, kept from step to step.
#[derive(Default)]
struct Buffers {
    plan: Plan,
    levels: Vec<u8>,
    positions: positions::Buffer,
    handed: certify::Handed,
    closing: Closing,
}

/// The levels of the new vertices; empty if names are not kept.
fn child_levels(levels: &mut Vec<u8>, history: &History, plan: &Plan) -> Result<(), RefineError> {
    levels.clear();
    if history.has_names() {
        for edge in &plan.edges {
            levels.push(history.child_level(edge.ends())?);
        }
    }
    Ok(())
}

/// Splits rings and tags; positions are those after the step, in which the vertices `moving` took part.
fn split(mesh: &mut Mesh, plan: &Plan, moving: &[VertexId], closing: &mut Closing, diagonal: Diagonal) {
    let (rotation, positions, tags) = mesh.parts_mut();
    if !tags.is_empty() {
        let edge = |[p, q]: [VertexId; 2]| Edge::new(p, q);
        let split = plan.odd().map(|(x, split)| (x, edge(split.ends())));
        tags.refine(rotation, split, moving.iter().copied());
    }
    quadrisect::apply(rotation, plan, closing, |quad: Quad, valences| diagonal.start(quad, valences, positions));
}

/// S' = S and every new vertex between two vertices of S. O(S and the region).
fn follow(selection: &Selection, plan: &Plan, vertex_count: usize, scratch: &mut Scratch) -> Selection {
    let mut vertices = scratch.take_list();
    vertices.extend_from_slice(selection.vertices());
    let marks = scratch.marked(vertex_count, selection.vertices());
    vertices.extend(plan.odd().filter(|(_, edge)| edge.ends().iter().all(|&end| marks.is_set(end))).map(|(x, _)| x));
    Selection::ascending(vertices)
}
