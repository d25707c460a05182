//! A step with positions in closed form, in as many passes as it takes.
//!
//! A triangle is split only after the first stars of its corners are complete, so that it is known where each corner is at any
//! level. Its youngest corners are new in triangles that were split before; what their stars wait for is split in earlier
//! passes, which goes down in level. Older corners had to be complete before what the triangle is a part of was split.
//!
//! A vertex is shown at the greatest level at which all triangles around it are whole: where its star is refined as in the
//! uniform mesh of that level it is at the same place, up to rounding. Before its first star is complete it is shown where it
//! was born, for then the triangles around it are a part of those of the level before.

use std::mem;

use glam::DVec3;

use super::closed_form;
use super::masks::add_others;
use super::points::Points;
use crate::error::RefineError;
use crate::id::{Triangle, VertexId};
use crate::mesh::Mesh;
use crate::rotation::{RingBuf, RotationSystem};
use crate::scheme::Sqrt3;
use crate::split::trisect::{Levels, Plan, across_mate};
use crate::step::{History, Motion, Motions};
use crate::subdivide::Control;
use crate::subdivide::positions::{BUFFERED, finite};

/// Splits triangles and all that has to be split before them, and answers the greatest valence that changed. After an error
/// the mesh and the history are as before.
pub(super) fn split(
    scheme: &Sqrt3,
    mesh: &mut Mesh,
    history: &mut History,
    inside: &[Triangle],
    plan: &mut Plan,
    control: &mut Control<'_>,
) -> Result<usize, RefineError> {
    let first = mesh.vertex_count();
    control.allow_follower(history.has_motions() && first > 0)?;
    let is_followed = control.follower.is_some();
    let mut points = match history.take_motions() {
        Some(motions) => Points::new(motions, is_followed),
        None if history.step_count() == 0 => {
            let mut points = Points::new(Motions::default(), is_followed);
            closed_form::push_input(scheme, mesh, &mut points);
            points
        }
        None => return Err(RefineError::OtherPositions),
    };
    plan.clear();
    let levels = Levels::before(history, first, Vec::new());
    let mut undo = Undo::default();
    let mut passes = Passes { scheme, mesh, levels, plan, points: &mut points, undo: &mut undo, first, max_valence: 0 };
    let split = passes.split(inside, control);
    match &split {
        Ok(_) => control.show(first, mesh.vertex_count(), |masks| points.script().play(masks)),
        Err(_) => undo.apply(mesh, &mut points.motions, first),
    }
    // A run that did not begin may go another way.
    if split.is_ok() || history.step_count() > 0 {
        history.keep_motions(points.motions);
    }
    split
}

/// What to do so that a step was never begun, in the order in which its parts were made.
#[derive(Default)]
struct Undo {
    rings: Vec<(VertexId, RingBuf)>,
    /// The vertices whose motion was settled.
    settled: Vec<VertexId>,
    /// The vertices that moved, from where.
    positions: Vec<(VertexId, DVec3)>,
}

impl Undo {
    /// Leaves a mesh as it was when it had this many vertices.
    fn apply(self, mesh: &mut Mesh, motions: &mut Motions, vertex_count: usize) {
        let (rotation, positions, _) = mesh.parts_mut();
        for (v, position) in self.positions {
            positions[v.index()] = position;
        }
        positions.truncate(vertex_count);
        for (v, ring) in self.rings.into_iter().rev() {
            rotation.set_ring(v, ring);
        }
        rotation.truncate(vertex_count);
        for v in self.settled {
            motions.set(v, Motion::Open);
        }
        motions.truncate(vertex_count);
    }
}

/// A step under way.
struct Passes<'a> {
    scheme: &'a Sqrt3,
    mesh: &'a mut Mesh,
    levels: Levels<'a>,
    plan: &'a mut Plan,
    points: &'a mut Points,
    undo: &'a mut Undo,
    /// How many vertices there were before the step.
    first: usize,
    max_valence: usize,
}

impl Passes<'_> {
    /// Splits these triangles; instead of one that lags, the one across its mate.
    fn split(&mut self, inside: &[Triangle], control: &mut Control<'_>) -> Result<usize, RefineError> {
        let lags = |triangle: &Triangle| across_mate(self.mesh.rotation(), self.levels.state(*triangle)).is_some();
        let (mut lagging, mut ready): (Vec<Triangle>, Vec<Triangle>) = inside.iter().copied().partition(lags);
        loop {
            // What is split is there no more, nor is what lagged and was completed.
            lagging.retain(|&triangle| self.exists(triangle));
            ready.retain(|&triangle| self.exists(triangle));
            let mut across = lagging.iter().filter_map(|&triangle| self.across_mate(triangle)).collect();
            let mut wanted = ready.clone();
            add_others(&mut wanted, &mut across);
            let mut early: Vec<Triangle> = wanted.iter().filter_map(|&triangle| self.first_needed(triangle)).collect();
            if early.is_empty() {
                self.pass(wanted, control)?;
                self.show()?;
                return Ok(self.max_valence);
            }
            early.sort_unstable();
            early.dedup();
            self.pass(early, control)?;
        }
    }

    /// Whether a triangle is still there. O(valence) of the corner that has the fewest neighbours.
    fn exists(&self, triangle: Triangle) -> bool {
        let ([a, b, c], rotation) = (triangle.corners(), self.mesh.rotation());
        let seen = [[a, b, c], [b, c, a], [c, a, b]].into_iter().min_by_key(|seen| rotation.valence(seen[0]));
        seen.is_some_and(|[a, b, c]| rotation.left_of(a, b) == Some(c))
    }

    fn across_mate(&self, triangle: Triangle) -> Option<Triangle> {
        across_mate(self.mesh.rotation(), self.levels.state(triangle))
    }

    /// What has to be split before a triangle can be, and can be now; `None` if nothing has to.
    fn first_needed(&self, triangle: Triangle) -> Option<Triangle> {
        // Each is half a level or more below the one that needs it.
        let needed = |triangle| needed(self.mesh.rotation(), &self.levels, triangle);
        std::iter::successors(needed(triangle), |&other| needed(other)).last()
    }

    /// Splits triangles at once, all of which can be.
    fn pass(&mut self, triangles: Vec<Triangle>, control: &mut Control<'_>) -> Result<(), RefineError> {
        self.plan.next_pass(self.mesh.rotation(), &self.levels, triangles.into_iter())?;
        let faces = self.plan.pass();
        control.allow(self.plan.vertex_count, self.mesh.face_count(), 2 * faces.len())?;
        let (rotation, positions, _) = self.mesh.parts_mut();
        for (done, face) in faces.iter().enumerate() {
            if done % BUFFERED == 0 {
                control.report(done, faces.len())?;
            }
            closed_form::push(self.points, face);
            for (x, _) in face.made() {
                positions.push(finite(self.points.motions.point(x, Motion::BIRTH), face.corners[0])?);
            }
        }
        self.levels.push(faces);
        let max_valence = self.plan.apply(rotation, &self.levels, |v, ring| self.undo.rings.push((v, ring)));
        self.max_valence = self.max_valence.max(max_valence);

        let new = self.plan.pass().iter().flat_map(|face| face.made().map(|(x, _)| x));
        for v in new.chain(self.plan.apexes()) {
            if self.points.motions.is_open(v) && needed_around(self.mesh.rotation(), &self.levels, v).is_none() {
                closed_form::settle(self.scheme, self.points, self.mesh.rotation(), &self.levels, v);
                self.undo.settled.push(v);
            }
        }
        Ok(())
    }

    /// Puts the vertices around which something was split where they are at the level of their surroundings.
    fn show(&mut self) -> Result<(), RefineError> {
        let mut touched: Vec<VertexId> = self.undo.rings.iter().map(|&(v, _)| v).collect();
        touched.retain(|v| v.index() < self.first);
        touched.sort_unstable();
        touched.dedup();
        let new = self.plan.faces().iter().flat_map(|face| face.made().map(|(x, lineage)| (x, Some(lineage))));
        for (v, lineage) in touched.into_iter().map(|v| (v, None)).chain(new) {
            let whole = |triangle| {
                let lags = self.across_mate(triangle).is_some();
                self.levels.state(triangle).level() - u8::from(lags)
            };
            let level = self.mesh.rotation().triangles_around(v).map(whole).min().unwrap_or(0);
            let position = finite(self.points.show(v, level.max(self.levels.of(v)), lineage), v)?;
            self.undo.positions.push((v, mem::replace(&mut self.mesh.positions_mut()[v.index()], position)));
        }
        Ok(())
    }
}

/// One of those that have to be split before a triangle can be.
pub(super) fn needed(rotation: &RotationSystem, levels: &Levels<'_>, triangle: Triangle) -> Option<Triangle> {
    let state = levels.state(triangle);
    // The stars of input vertices wait for nothing.
    let mut youngest = triangle.corners().into_iter().filter(|&v| state.level() > 0 && levels.of(v) == state.level());
    across_mate(rotation, state).or_else(|| youngest.find_map(|v| needed_around(rotation, levels, v)))
}

/// One of those that have to be split before the first star of a vertex is complete.
fn needed_around(rotation: &RotationSystem, levels: &Levels<'_>, v: VertexId) -> Option<Triangle> {
    let states = rotation.triangles_around(v).map(|triangle| levels.state(triangle));
    states.filter(|state| state.level() == levels.of(v)).find_map(|state| across_mate(rotation, state))
}
