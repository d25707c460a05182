//! `--until`: an accuracy that a run is to reach.

use vvmesh::query::measure::bounds;
use vvmesh::until::{Left, Measure, Until};
use vvmesh::{Accuracy, Mesh};

use crate::Outcome;
use crate::args::{MeasureName, RefineArguments};
use crate::console::{Failure, refuse, warning};
use crate::refine;
use crate::report::UntilReport;
use crate::run::Run;
use crate::table::count;

/// The accuracy, and what was left of the way when the run was looked at last.
pub(crate) struct Aim {
    until: Until,
    accuracy: f64,
    measure: Measure,
    first_error: Option<f64>,
    left: Left,
}

impl Aim {
    /// What the arguments ask of a mesh, if they do.
    pub(crate) fn new(arguments: &RefineArguments, input: &Mesh) -> Result<Option<Self>, Failure> {
        let Some(length) = arguments.until else { return Ok(None) };
        let accuracy = length.distance(|| bounds(input).map_or(0.0, |bounds| bounds.diagonal()));
        let Ok(asked) = Accuracy::new(accuracy) else {
            return refuse(format!("--until: a part of the bounding box is no distance above 0: {accuracy}"));
        };
        let measure = match arguments.measure {
            None | Some(MeasureName::Bound) => Measure::Bound,
            Some(MeasureName::Vertex) => Measure::Vertex,
        };
        let until = Until::new(refine::scheme(arguments), asked, measure)?;
        Ok(Some(Self { until, accuracy, measure, first_error: None, left: Left::default() }))
    }

    /// Looks at a run, and selects what is too far.
    pub(crate) fn look(&mut self, run: &mut Run) -> Result<(), Failure> {
        let left = self.until.look(&run.mesh, &run.history);
        self.left = left.map_err(|error| Failure(format!("--until: {error}")))?;
        self.first_error.get_or_insert(self.left.distance);
        if let Some(row) = run.levels.last_mut() {
            row.error = Some(self.left.distance);
        }
        run.selection.clone_from(&self.left.selection);
        Ok(())
    }

    /// Whether nothing is.
    pub(crate) fn is_reached(&self) -> bool {
        self.left.is_reached()
    }

    /// The greatest distance left.
    pub(crate) fn error(&self) -> f64 {
        self.left.distance
    }

    /// How the run ended; it is told if the aim is not reached.
    pub(crate) fn outcome(&self) -> Outcome {
        let Left { distance, far_faces, .. } = self.left;
        if self.left.is_reached() {
            return Outcome::Done;
        }
        let faces = count(far_faces, "face", "faces");
        let verb = match (self.measure, far_faces) {
            (Measure::Bound, _) => "may be",
            (Measure::Vertex, 1) => "is",
            (Measure::Vertex, _) => "are",
        };
        warning(format_args!(
            "--until: {:e} is not reached; {faces} {verb} farther away, up to {distance:e}",
            self.accuracy
        ));
        Outcome::Found
    }

    pub(crate) fn report(&self) -> UntilReport {
        UntilReport {
            accuracy: self.accuracy,
            measure: self.measure.name(),
            first_error: self.first_error.unwrap_or(self.left.distance),
            error: self.left.distance,
            far_faces: self.left.far_faces,
            reached: self.left.is_reached(),
        }
    }
}
