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
//! What belongs to the vertices beside their positions can go along: see [`Follower`] and [`Values`].
//!
//! **Deliberately not here**: what is refined ([`crate::adaptive`]), weights ([`crate::scheme`]), rings
//! ([`crate::split`]).

mod bisect;
mod follow;
mod hierarchy;
mod mobile;
mod over;
mod pairs;
mod parts;
mod positions;
mod quadrisect;
mod red_green;
mod trisect;
mod values;
mod whole;

pub use follow::{Assignment, Follower, StepMasks, ValueId};
pub(crate) use hierarchy::GrownOver;
pub use hierarchy::{Change, Dynamic, Target};
pub(crate) use hierarchy::{Leaf, Leaves, name as scheme_name};
pub use mobile::MobileStep;
pub use pairs::{AnyMethod, Promise, promise};
pub use values::Values;

use std::ops::ControlFlow;

use crate::accuracy::Accuracy;
use crate::adaptive::{AdaptiveMethod, Simple, Uniform};
use crate::error::{ConfigError, RefineError};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::{AnyScheme, Scheme, with_scheme};
use crate::scratch::Scratch;
use crate::select::{Selection, Unknown};
use crate::split::Diagonal;
use crate::step::{History, Region};
use hierarchy::Demand;
use mobile::Mobile;
use quadrisect::Quadrisection;

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
    /// three of them. Where triangles are split in four, of edges their halves and of faces the faces made of them, which are
    /// four if nothing but the region of the method decides; of a leaf in which a selected face lies, under *red-green*. Of
    /// vertices where new edges and faces do not lie in old ones: under √3 and 4-8, by *dynamic*, and of edges by *red-green*.
    pub selection: Selection,
    /// How many vertices were selected before the step, ends of edges and corners of faces among them.
    pub selected: usize,
    /// How many vertices took part in the step.
    pub region: usize,
    /// How many edges were split, which is the number of new vertices; under √3 the boundary edges that were cut in three.
    pub split_edges: usize,
    /// In how many passes it was found what is to be split: 1 unless what is split may ask for more, as by *red-green*; 0 if
    /// nothing was looked for.
    pub passes: usize,
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
    /// What a step of static/mobile subdivision told apart; `None` of other steps.
    pub mobile: Option<MobileStep>,
}

impl Step {
    /// Whether everything was near enough to its limit for static/mobile subdivision: then mesh and history are as before.
    #[must_use]
    pub fn did_nothing(&self) -> bool {
        self.mobile.is_some_and(|counts| counts.mobile_vertices == 0)
    }

    /// Gives the memory of the lists back, for the steps that follow.
    ///
    /// A run of steps of like size that does so, for selections of vertices, and passes the same `scratch` to every step, allocates nothing but for a
    /// growing mesh and for rings of more than six neighbours (five if open). A certificate takes one list a step more; 4-8, and
    /// √3 by a method that promises nothing, take some.
    pub fn recycle(self, scratch: &mut Scratch) {
        for list in [self.selection.into_vertices(), self.t_vertices, self.o_vertices, self.unproven] {
            scratch.give_list(list);
        }
    }
}

/// What a step of any split works on.
struct Request<'a, 'c> {
    mesh: &'a mut Mesh,
    history: &'a mut History,
    selection: &'a Selection,
    region: &'a Region,
    scratch: &'a mut Scratch,
    control: &'a mut Control<'c>,
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
    method: Method,
    diagonal: Diagonal,
}

/// What chooses the region of a step.
#[derive(Debug)]
enum Method {
    /// A look at the mesh and the selection; goes with every scheme.
    Region(Box<dyn AdaptiveMethod>),
    Mobile(Mobile),
    RedGreen,
    /// No region of the mesh, but what the hierarchy over the input must hold.
    OnHierarchy(Demand),
}

impl Subdivider {
    /// A scheme with a method on the mesh as it is.
    #[must_use]
    pub fn new(scheme: impl Into<AnyScheme>, method: impl AdaptiveMethod + 'static) -> Self {
        Self { scheme: scheme.into(), method: Method::Region(Box::new(method)), diagonal: Diagonal::default() }
    }

    /// Static/mobile subdivision: of the selected vertices those move that are farther from their limit than asked for, and the
    /// faces at them are split; all else stays, for ever. When nothing moves any more, a [step does
    /// nothing](Step::did_nothing).
    ///
    /// The mesh is closed as by other methods. Without its closing edges it is [`History::unclosed`]. A step of another method
    /// in between makes all vertices of the mesh that it leaves mobile again.
    ///
    /// ```
    /// use vvmesh::scheme::Loop;
    /// use vvmesh::scratch::Scratch;
    /// use vvmesh::select::Selection;
    /// use vvmesh::step::{History, Keep};
    /// use vvmesh::subdivide::{Control, Subdivider};
    /// use vvmesh::{Accuracy, shapes};
    ///
    /// let mut mesh = shapes::torus(9, 6, 2.0, 0.7);
    /// let (mut history, mut scratch) = (History::new(&mesh, Keep::default()), Scratch::new());
    /// let mut selection = Selection::all(mesh.vertex_count());
    /// let subdivider = Subdivider::mobile(Loop::default(), Accuracy::new(0.04)?)?;
    /// loop {
    ///     let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?;
    ///     if step.did_nothing() {
    ///         break;
    ///     }
    ///     selection = step.selection;
    /// }
    /// let unclosed = history.unclosed(&mesh).expect("a step was made");
    /// assert_eq!((history.step_count(), unclosed.face_count()), (2, 1296));
    /// assert!(mesh.face_count() > unclosed.face_count());
    /// # Ok::<(), vvmesh::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Under a scheme other than [`Loop`](crate::scheme::Loop), with the reason.
    pub fn mobile(scheme: impl Into<AnyScheme>, accuracy: Accuracy) -> Result<Self, ConfigError> {
        let scheme = scheme.into();
        promise(&scheme, "mobile")?;
        let AnyScheme::Loop(masks) = &scheme else { unreachable!("other schemes are refused") };
        let method = Method::Mobile(Mobile::new(masks, accuracy));
        Ok(Self { scheme, method, diagonal: Diagonal::default() })
    }

    /// Red-green refinement: triangles with all corners in the selection are split in four, and so is each in which more than
    /// one edge would be split, or one twice; one in which a single edge is split is bisected until the next step takes that
    /// back. Valences stay bounded, but unlike *incremental* it promises no exactness; the certificate says what is.
    ///
    /// The selection that follows has the corners that were there already, too, where a bisected triangle is split. After a
    /// step of another method it begins anew with the mesh as it is then.
    ///
    /// ```
    /// use vvmesh::scheme::Loop;
    /// use vvmesh::scratch::Scratch;
    /// use vvmesh::select::Selection;
    /// use vvmesh::step::{History, Keep};
    /// use vvmesh::subdivide::{Control, Subdivider};
    /// use vvmesh::{VertexId, shapes};
    ///
    /// let mut mesh = shapes::icosahedron();
    /// let (mut history, mut scratch) = (History::new(&mesh, Keep::default()), Scratch::new());
    /// let triangle = mesh.triangles().next().expect("it has twenty").corners();
    /// let selection: Selection = triangle.into_iter().collect();
    /// let subdivider = Subdivider::red_green(Loop::default())?;
    /// subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?;
    /// // One in four, and its neighbours in two.
    /// assert_eq!(mesh.face_count(), 20 + 3 + 3);
    /// # Ok::<(), vvmesh::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Under a scheme that does not split triangles in four, with the reason.
    pub fn red_green(scheme: impl Into<AnyScheme>) -> Result<Self, ConfigError> {
        let scheme = scheme.into();
        promise(&scheme, "red-green")?;
        Ok(Self { scheme, method: Method::RedGreen, diagonal: Diagonal::default() })
    }

    /// Red-green refinement with restriction: triangles with all corners in the selection are split in four, and so is, until
    /// there is none, each with two split edges and more; one with a single split edge is bisected for the time being. Before
    /// a triangle of a level is split, all triangles of that level around its corners are made.
    ///
    /// So what new vertices are made of is always that of a uniform mesh: whatever the selections are, every vertex is where
    /// uniform refinement of some number of levels has it, bit for bit: of as many as the finest triangle at it
    /// ([`Certificate::exact_level`](crate::certify::Certificate::exact_level)). Triangles that share a vertex differ by at
    /// most one level. Source: `[incremental]`, `[zorin1997]`.
    ///
    /// # Errors
    /// Under a scheme that does not split triangles in four, with the reason.
    pub fn red_green_restricted(scheme: impl Into<AnyScheme>) -> Result<Self, ConfigError> {
        Self::on_hierarchy(scheme.into(), "red-green-restricted", Demand::Leaves)
    }

    /// The k-th step asks that all triangles around each selected vertex be there at level k, with what that needs, and for
    /// nothing else. It is as exact as [`Subdivider::red_green_restricted`], and what was asked for can be given up again: see
    /// [`Dynamic`], of which this is the same with levels counted.
    ///
    /// # Errors
    /// Under a scheme that does not split triangles in four, with the reason.
    pub fn dynamic(scheme: impl Into<AnyScheme>) -> Result<Self, ConfigError> {
        Self::on_hierarchy(scheme.into(), "dynamic", Demand::Stars)
    }

    fn on_hierarchy(scheme: AnyScheme, name: &str, demand: Demand) -> Result<Self, ConfigError> {
        promise(&scheme, name)?;
        Ok(Self { scheme, method: Method::OnHierarchy(demand), diagonal: Diagonal::default() })
    }

    /// A scheme with a method that is chosen while the program runs.
    ///
    /// # Errors
    /// If they do not go together, with the reason; see [`promise`].
    pub fn of(scheme: impl Into<AnyScheme>, method: AnyMethod) -> Result<Self, ConfigError> {
        match method {
            AnyMethod::Uniform => Ok(Self::new(scheme, Uniform)),
            AnyMethod::Simple => Ok(Self::new(scheme, Simple)),
            AnyMethod::Incremental(method) => Ok(Self::new(scheme, method)),
            AnyMethod::RedGreen => Self::red_green(scheme),
            AnyMethod::RedGreenRestricted => Self::red_green_restricted(scheme),
            AnyMethod::Dynamic => Self::dynamic(scheme),
            AnyMethod::Mobile(accuracy) => Self::mobile(scheme, accuracy),
        }
    }

    /// The same with another choice of diagonals in faces with two split edges; on a hierarchy they have a rule of their own,
    /// which asks neither for valences nor for ids, as these would depend on the order of steps.
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
    /// A selected vertex, edge or face that does not exist, a history of another [`SplitKind`](crate::step::SplitKind), under √3 and on a
    /// hierarchy of other methods, a follower that was not there from the first step on and has to be, semi-sharp tags that the
    /// scheme cannot blend, more faces than [`Control::max_faces`], more vertices than 32-bit ids name, a 256th level, a position that is not finite, or the
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
        require_known(selection, mesh)?;
        require_blended(&self.scheme, mesh)?;
        if let Method::OnHierarchy(demand) = self.method {
            return hierarchy::step(&self.scheme, demand, mesh, history, selection, scratch, control);
        }
        history.allow(self.scheme.split_kind())?;
        let region = match &self.method {
            Method::Region(method) => method.region(mesh, selection, scratch),
            Method::Mobile(method) => method.region(mesh, history, selection),
            Method::RedGreen => {
                let step = with_scheme!(
                    &self.scheme,
                    scheme => {
                        let quadrisection = self.quadrisection(scheme);
                        red_green::step(&quadrisection, mesh, history, selection, scratch, control)
                    },
                    else unreachable!("other schemes are refused")
                )?;
                history.note_part();
                return Ok(step);
            }
            Method::OnHierarchy(_) => unreachable!("it has no region"),
        };
        let request =
            Request { mesh, history: &mut *history, selection, region: &region, scratch: &mut *scratch, control };
        let step = match &self.scheme {
            AnyScheme::Loop(scheme) if self.is_mobile() => mobile::step(scheme, self.diagonal, request),
            AnyScheme::Loop(scheme) => self.quadrisection(scheme).step(request),
            AnyScheme::Butterfly(scheme) => self.quadrisection(scheme).step(request),
            AnyScheme::ModifiedButterfly(scheme) => self.quadrisection(scheme).step(request),
            AnyScheme::Midpoint(scheme) => self.quadrisection(scheme).step(request),
            AnyScheme::Sqrt3(scheme) => trisect::step(scheme, self.promises_exactness(), request),
            AnyScheme::FourEight(scheme) => bisect::step(scheme, request),
        };
        if step.is_ok() && !region.is_everything() {
            history.note_part();
        }
        scratch.give_list(region.into_list());
        step
    }

    fn quadrisection<'a, S: Scheme + Sync>(&self, scheme: &'a S) -> Quadrisection<'a, S> {
        Quadrisection { scheme, exact: self.promises_exactness(), diagonal: self.diagonal }
    }

    /// Whether it moves some vertices of a region and leaves the others where they are, for ever.
    pub(crate) fn is_mobile(&self) -> bool {
        matches!(self.method, Method::Mobile(_))
    }

    /// Whether its steps go on with what the hierarchy of a history holds.
    pub(crate) fn is_on_hierarchy(&self) -> bool {
        matches!(self.method, Method::RedGreen | Method::OnHierarchy(_))
    }

    fn promises_exactness(&self) -> bool {
        match &self.method {
            Method::Region(method) => method.promises_exactness(),
            Method::Mobile(_) | Method::RedGreen | Method::OnHierarchy(_) => false,
        }
    }
}

/// Refuses a selection of what does not exist.
fn require_known(selection: &Selection, mesh: &Mesh) -> Result<(), RefineError> {
    match selection.first_unknown(mesh.rotation()) {
        None => Ok(()),
        Some(Unknown::Vertex(v)) => Err(RefineError::NoVertex(v)),
        Some(Unknown::Edge(edge)) => Err(RefineError::NoEdge(edge)),
        Some(Unknown::Face(face)) => Err(RefineError::NoFace(face)),
    }
}

/// Refuses semi-sharp tags that a scheme would have to blend and cannot.
fn require_blended(scheme: &AnyScheme, mesh: &Mesh) -> Result<(), RefineError> {
    let blends = scheme.blends_sharpness() || !scheme.reads_tags();
    if mesh.tags().has_semi_sharp() && !blends { Err(RefineError::SemiSharp) } else { Ok(()) }
}
