//! Where uniform refinement has the vertices of a region, and how far a method is from that.

use std::time::Instant;

use glam::DVec3;

use super::measures::{self, Deviations, Measures};
use super::{Outcome, Row, sizes};
use crate::accuracy::Accuracy;
use crate::adaptive::Incremental;
use crate::error::RefineError;
use crate::id::VertexId;
use crate::limit::{Limit, LoopLimit};
use crate::mesh::Mesh;
use crate::scheme::AnyScheme;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::{History, Keep};
use crate::subdivide::{AnyMethod, Control, Step, Subdivider};

/// By how many rings the reference expands the selection. One would do; with three no method that is compared by default is
/// compared with itself.
const RINGS: usize = 3;

/// The vertices of a selection and of those that follow it, where uniform refinement has them at each level.
///
/// They come from [`Incremental`] refinement around the selection, so uniform meshes need not fit the memory. That it is the
/// same is the theorem of that method: each selection is the one that follows the step before, so its vertices have the
/// positions, the neighbours and the neighbours' positions of uniform refinement, bit for bit. Where triangles are split in
/// four a certificate proves it once more, vertex by vertex; for √3 and 4-8 see [`Sqrt3`](crate::scheme::Sqrt3) and
/// [`FourEight`](crate::scheme::FourEight).
#[derive(Clone, Debug)]
pub struct Reference<'a> {
    input: &'a Mesh,
    selection: &'a Selection,
    scheme: AnyScheme,
    max_faces: Option<u64>,
    /// The names of all vertices of the reference.
    history: History,
    /// The selection after the last level; those before it are its beginnings.
    selected: Selection,
    levels: Vec<Level>,
}

/// The selected vertices at a level, in their order.
#[derive(Clone, Debug)]
struct Level {
    positions: Vec<DVec3>,
    limits: Vec<Option<DVec3>>,
}

impl<'a> Reference<'a> {
    /// The reference for a mesh, a selection, a scheme and so many levels; `max_faces` bounds every mesh that is made.
    ///
    /// # Errors
    /// Those of [`Subdivider::step`]; too many faces before anything is made, if those inside of the selection become too many.
    ///
    /// # Complexity
    /// That of incremental refinement with three rings, and O(selected) a level.
    pub fn new(
        mesh: &'a Mesh,
        selection: &'a Selection,
        scheme: impl Into<AnyScheme>,
        levels: u8,
        max_faces: Option<u64>,
    ) -> Result<Self, RefineError> {
        let scheme = scheme.into();
        let needed = sizes::at_least(mesh, selection, scheme.split_kind(), levels);
        if let Some(allowed) = max_faces.filter(|&allowed| needed > allowed) {
            return Err(RefineError::TooManyFaces { needed, allowed });
        }
        let rings = Incremental::new(RINGS).expect("there are some");
        let mut run = Run::new(mesh, selection, Subdivider::new(scheme.clone(), rings), true);
        let mut kept = Vec::new();
        for _ in 0..levels {
            let step = run.step(max_faces)?;
            debug_assert!(step.unproven.is_empty(), "a selection that follows is refined exactly");
            let selected = run.selection.vertices();
            kept.push(Level {
                positions: selected.iter().map(|&v| run.mesh.position(v)).collect(),
                limits: selected.iter().map(|&v| limit(&scheme, &run.mesh, v)).collect(),
            });
        }
        let Run { history, selection: selected, .. } = run;
        Ok(Self { input: mesh, selection, scheme, max_faces, history, selected, levels: kept })
    }

    /// The vertices that followed the selection, and where uniform refinement has them after so many steps, in the order of
    /// their ids in [`Reference::history`]. None after no step and after more than were made.
    pub fn vertices(&self, level: usize) -> impl Iterator<Item = (VertexId, DVec3)> {
        let positions = level.checked_sub(1).and_then(|k| self.levels.get(k)).map(|level| level.positions.as_slice());
        self.selected.vertices().iter().copied().zip(positions.unwrap_or_default().iter().copied())
    }

    /// The names of these vertices.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Runs a method with the scheme, from the same input and selection: one row a level.
    ///
    /// Vertices are matched by their names. If a step cannot be made, that and all later levels are skipped.
    #[must_use]
    pub fn compare(&self, method: AnyMethod) -> Vec<Row> {
        let mut rows = Vec::new();
        let refused = match Subdivider::of(self.scheme.clone(), method) {
            Ok(subdivider) => self.run(subdivider, &mut rows).err().map(|error| error.to_string()),
            Err(error) => Some(error.to_string()),
        };
        if let Some(reason) = refused {
            let kind = Some(self.scheme.split_kind()).filter(|_| method == AnyMethod::Uniform);
            let sizes = |level| sizes::uniform(self.input, kind?, level);
            rows.extend(self.skipped(rows.len(), &reason, sizes));
        }
        rows
    }

    /// The same with the method of this name; see [`AnyMethod::named`]. If there is none, all levels are skipped.
    #[must_use]
    pub fn compare_named(&self, name: &str, accuracy: Option<Accuracy>) -> Vec<Row> {
        match AnyMethod::named(name, accuracy) {
            Ok(method) => self.compare(method),
            Err(error) => self.skipped(0, &error.to_string(), |_| None).collect(),
        }
    }

    /// The rows of the levels from one on, counted from 0, that are not made.
    fn skipped(&self, first: usize, reason: &str, sizes: impl Fn(u8) -> Option<[u64; 2]>) -> impl Iterator<Item = Row> {
        (first..self.levels.len()).map(level_number).map(move |level| {
            let outcome = Outcome::Skipped { reason: reason.to_owned(), sizes: sizes(level) };
            Row { level, outcome }
        })
    }

    /// Makes all levels, or as many as can be made.
    fn run(&self, subdivider: Subdivider, rows: &mut Vec<Row>) -> Result<(), RefineError> {
        let mut run = Run::new(self.input, self.selection, subdivider, false);
        for (k, level) in self.levels.iter().enumerate() {
            let started = Instant::now();
            let step = run.step(self.max_faces)?;
            let seconds = started.elapsed().as_secs_f64();
            rows.push(Row {
                level: level_number(k),
                outcome: Outcome::Made(self.measure(&run, &step, seconds, level)),
            });
        }
        Ok(())
    }

    fn measure(&self, run: &Run, step: &Step, seconds: f64, level: &Level) -> Measures {
        let Run { mesh, history, .. } = run;
        let mut equal = 0;
        let [mut deviations, mut of_limits] = [Deviations::default(), Deviations::default()];
        let selected = &self.selected.vertices()[..level.positions.len()];
        let same = history.same_names(&self.history).expect("both keep names");
        for (v, twin) in mesh.vertices().zip(same) {
            let Some(k) = twin.and_then(|twin| selected.binary_search(&twin).ok()) else { continue };
            deviations.add(mesh.position(v).distance(level.positions[k]));
            equal += usize::from(mesh.position(v) == level.positions[k]);
            let limits = level.limits[k].zip(limit(&self.scheme, mesh, v));
            limits.into_iter().for_each(|(there, here)| of_limits.add(here.distance(there)));
        }
        let percent = 100.0 * equal as f64 / selected.len() as f64;
        Measures {
            faces: mesh.face_count(),
            vertices: mesh.vertex_count(),
            t_vertices: step.t_vertices.len(),
            o_vertices: step.o_vertices.len(),
            max_valence: measures::max_valence(mesh),
            max_deviation: deviations.greatest(),
            mean_deviation: deviations.mean(),
            max_limit_deviation: of_limits.greatest(),
            equal_percent: (!selected.is_empty()).then_some(percent),
            balance: measures::balance(mesh, history),
            min_angle_deg: measures::min_angle_deg(mesh),
            passes: step.passes,
            seconds,
            bytes: mesh.memory_bytes() + history.memory_bytes(),
        }
    }
}

/// A mesh that is refined step by step, with the selection that follows.
struct Run {
    mesh: Mesh,
    history: History,
    selection: Selection,
    scratch: Scratch,
    subdivider: Subdivider,
}

impl Run {
    fn new(mesh: &Mesh, selection: &Selection, subdivider: Subdivider, certificate: bool) -> Self {
        let history = History::new(mesh, Keep { names: true, certificate });
        let (mesh, selection) = (mesh.clone(), selection.clone());
        Self { mesh, history, selection, scratch: Scratch::new(), subdivider }
    }

    fn step(&mut self, max_faces: Option<u64>) -> Result<Step, RefineError> {
        let Self { mesh, history, selection, scratch, subdivider } = self;
        let mut control = Control { max_faces, ..Control::default() };
        let step = subdivider.step(mesh, history, selection, scratch, &mut control)?;
        selection.clone_from(&step.selection);
        Ok(step)
    }
}

/// The number of the k-th level, counted from 0.
fn level_number(k: usize) -> u8 {
    u8::try_from(k + 1).expect("there are at most 255")
}

/// Where uniform refinement of this mesh would lead a vertex, if that is known.
fn limit(scheme: &AnyScheme, mesh: &Mesh, v: VertexId) -> Option<DVec3> {
    match scheme {
        AnyScheme::Loop(_) if mesh.neighborhood().is_semi_sharp(v) => None,
        AnyScheme::Loop(scheme) => Some(LoopLimit::new(scheme.weights()).position(mesh, v)),
        AnyScheme::Butterfly(_) | AnyScheme::ModifiedButterfly(_) | AnyScheme::Midpoint(_) => Some(mesh.position(v)),
        AnyScheme::Sqrt3(_) | AnyScheme::FourEight(_) => None,
    }
}
