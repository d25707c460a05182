//! Until an accuracy is reached: which faces are still too far from the limit surface, step by step.
//!
//! [`Until::look`] goes through the faces of a mesh that is refined on a hierarchy, or uniformly, by
//! [`Loop`](crate::scheme::Loop). It answers with the greatest distance left and with the corners of the faces that may be too
//! far: the selection of the next step. Selections move from step to step, so the method has to be one that is exact whatever
//! is selected.
//!
//! | by | |
//! |---|---|
//! | [`Subdivider::dynamic`](crate::subdivide::Subdivider::dynamic) | all faces around the corners of faces that are too far, so that these corners go on, too |
//! | [`Subdivider::red_green_restricted`](crate::subdivide::Subdivider::red_green_restricted) | the faces that are too far, and others between their corners |
//! | [`Uniform`](crate::adaptive::Uniform) | all faces |
//!
//! **Deliberately not here**: how a bound comes about ([`crate::predict`]), and how deep a whole mesh has to be refined, which
//! is known in advance ([`DistanceBound`](crate::predict::DistanceBound)).

use std::borrow::Cow;
use std::fmt;

use crate::accuracy::Accuracy;
use crate::error::{ConfigError, PredictError};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::parallel;
use crate::predict::{Face, ROUNDING};
use crate::scheme::{AnyScheme, LoopWeights};
use crate::select::Selection;
use crate::step::{History, Refinement};
use crate::subdivide::{AnyMethod, Leaf, Leaves, scheme_name};

/// What is measured of a face.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Measure {
    /// A distance to the limit surface that is exceeded at no point of the face.
    Bound,
    /// The distance of its vertices to their limits. Between them the surface may be anywhere.
    Vertex,
}

impl Measure {
    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Bound => "bound",
            Self::Vertex => "vertex",
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// An accuracy that is to be reached.
///
/// The distance is that between a point of the mesh and the point of the surface with the same parameters: a vertex that
/// splits an edge has those of its middle, and triangles are linear in between. So it is never less than the distance to the
/// nearest point of the surface. The surface is that of the input, with its boundaries, creases, darts and corners. A face
/// at which something is semi-sharp counts as infinitely far: it is split until that has faded.
///
/// ```
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider};
/// use vvmesh::until::{Measure, Until};
/// use vvmesh::{Accuracy, shapes};
///
/// let mut mesh = shapes::torus(9, 6, 2.0, 0.7);
/// let (mut history, mut scratch) = (History::new(&mesh, Keep::default()), Scratch::new());
/// let until = Until::new(Loop::default(), Accuracy::new(0.02)?, Measure::Bound)?;
/// let subdivider = Subdivider::dynamic(Loop::default())?;
/// let mut left = until.look(&mesh, &history)?;
/// while !left.is_reached() {
///     subdivider.step(&mut mesh, &mut history, &left.selection, &mut scratch, &mut Control::default())?;
///     let before = std::mem::replace(&mut left, until.look(&mesh, &history)?);
///     assert!(left.distance < before.distance);
/// }
/// assert!(left.distance <= 0.02);
/// assert!(mesh.face_count() < 108 * 4_usize.pow(history.step_count() as u32));
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Until {
    scheme: AnyScheme,
    weights: LoopWeights,
    accuracy: Accuracy,
    measure: Measure,
}

/// What is left to do.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Left {
    /// The greatest distance of all faces, by the measure that was asked for; infinite where something is semi-sharp.
    pub distance: f64,
    /// How many faces are, or may be, farther away than asked for; those in which a crack is closed count once.
    pub far_faces: usize,
    /// Their corners.
    pub selection: Selection,
}

impl Left {
    /// Whether that is nothing.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.far_faces == 0
    }
}

impl Until {
    /// An accuracy for meshes that are refined by a scheme.
    ///
    /// # Errors
    /// For a scheme other than [`Loop`](crate::scheme::Loop): of others no bound is known, and the vertices of those that
    /// interpolate are their own limits.
    pub fn new(scheme: impl Into<AnyScheme>, accuracy: Accuracy, measure: Measure) -> Result<Self, ConfigError> {
        match scheme.into() {
            AnyScheme::Loop(scheme) => Ok(Self { weights: scheme.weights(), scheme: scheme.into(), accuracy, measure }),
            other => {
                let expected = "the distance to the limit surface is known under `loop` alone".into();
                Err(ConfigError { name: "scheme", value: other.name().into(), expected })
            }
        }
    }

    /// Whether steps of a method lead there.
    ///
    /// # Errors
    /// If they do not, with the reason.
    pub fn allow(method: &AnyMethod) -> Result<(), ConfigError> {
        let reason = match method {
            AnyMethod::Uniform | AnyMethod::RedGreenRestricted | AnyMethod::Dynamic => return Ok(()),
            AnyMethod::Mobile(_) => "it has an accuracy of its own, of vertices, and stops by itself",
            AnyMethod::Simple | AnyMethod::Incremental(_) | AnyMethod::RedGreen => {
                "it is not exact where the selection moves, and leaves the limit surface; take `dynamic`, \
                 `red-green-restricted` or `uniform`"
            }
        };
        Err(ConfigError { name: "method", value: method.name().into(), expected: reason.into() })
    }

    /// Looks at every face. O(faces), times the valences at irregular vertices.
    ///
    /// # Errors
    /// [`PredictError::OtherSteps`] if the mesh was made otherwise than the methods [allowed](Until::allow) do,
    /// [`PredictError::TooFine`], [`PredictError::NonFinite`].
    pub fn look(&self, mesh: &Mesh, history: &History) -> Result<Left, PredictError> {
        let refinement = self.refinement(mesh, history)?;
        let leaves = Leaves::new(mesh, &refinement, self.weights);
        let rounding = self.rounding(leaves, refinement.hierarchy.input_count())?;
        let found = parallel::shares(0..refinement.hierarchy.input_count(), |share| {
            let (mut greatest, mut far) = (0.0_f64, Vec::new());
            for v in share.map(VertexId::new) {
                leaves.of_smallest(v, |leaf| {
                    let distance = self.distance(mesh, &leaf) + rounding;
                    greatest = greatest.max(distance);
                    far.extend((distance > self.accuracy.distance()).then_some(leaf.corners));
                });
            }
            (greatest, far)
        });
        let far: Vec<[VertexId; 3]> = found.iter().flat_map(|(_, far)| far).copied().collect();
        let distance = found.iter().map(|&(greatest, _)| greatest).fold(0.0, f64::max);
        Ok(Left { distance, far_faces: far.len(), selection: far.into_iter().flatten().collect() })
    }

    /// The hierarchy of the mesh. What was refined uniformly, or not at all, is the input of its own surface.
    fn refinement<'a>(&self, mesh: &Mesh, history: &'a History) -> Result<Cow<'a, Refinement>, PredictError> {
        match history.refinement() {
            Some(refinement) if refinement.scheme == scheme_name(&self.scheme) => Ok(Cow::Borrowed(refinement)),
            None if history.is_of_whole_steps() => {
                Ok(Cow::Owned(Refinement::new(mesh, scheme_name(&self.scheme), false)))
            }
            _ => Err(PredictError::OtherSteps),
        }
    }

    /// What rounding adds to each distance.
    fn rounding(&self, leaves: Leaves<'_>, input_count: usize) -> Result<f64, PredictError> {
        let positions = (0..input_count).map(|v| leaves.input_position(VertexId::new(v)));
        // Second differences are at most four positions long, and squared.
        if let Some(v) = positions.clone().position(|x| !(8.0 * x).length_squared().is_finite()) {
            return Err(PredictError::NonFinite(VertexId::new(v)));
        }
        let finest = ROUNDING * positions.map(|x| x.abs().max_element()).fold(0.0, f64::max);
        if self.accuracy.distance() > finest { Ok(finest) } else { Err(PredictError::TooFine { finest }) }
    }

    fn distance(&self, mesh: &Mesh, leaf: &Leaf) -> f64 {
        let Some(fans) = &leaf.fans else { return f64::INFINITY };
        let face = Face {
            corners: leaf.corners.map(|v| mesh.position(v)),
            hanging: leaf.odds.map(|x| x.map(|x| mesh.position(x))),
        };
        match self.measure {
            Measure::Bound => face.bound(fans),
            Measure::Vertex => face.at_vertices(fans),
        }
    }
}
