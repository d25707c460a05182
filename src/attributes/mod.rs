//! What a mesh carries beside its shape, and how it rides along through refinement.
//!
//! [`Attributes`] belong to a mesh and a run of steps, beside [`Mesh`] and [`History`]; a mesh without any pays nothing.
//! There are three sorts. A *vertex channel* has a value a vertex. A *corner channel* has a value at each corner of each
//! face, as texture coordinates do; where the values of two faces differ along their common edge there is a *seam*.
//! *Face labels* have a number a face: which group, which material.
//!
//! New values of a channel are made by the masks of the scheme, linearly, or taken from the nearest, as its [`Blend`]
//! says. For a corner channel this is done on the **chart mesh**: the faces, with their own corners, cut along the
//! seams, are a mesh over the mesh. A step splits the edges of the chart mesh over the edges that it splits in the
//! mesh. So faces stay over faces, each side of a seam is a boundary of a chart and is refined by the boundary rule of
//! the scheme, and both sides stay over the same vertices: no seam is torn. A channel without seams has the bits of a
//! vertex channel.
//!
//! A face of the refined mesh lies in one face of the input, whose label it keeps. Under √3 this holds after every second
//! step, when nine faces lie in one. In between an edge is turned and crosses the old one, and each of the two faces
//! beside it lies half in one old face and half in the next. Such a face has the label of a half, so that each old face
//! has three of the new ones; and where the old edge is a seam it has no values, as no chart has a face that crosses its
//! boundary. The charts are refined all the same, by the boundary rule of √3, and with the next step its faces have
//! values again. [`Attributes::faces_across_seams`] and [`Attributes::faces_across_labels`] count what lies across.
//!
//! On a hierarchy faces that close cracks are taken back, and their charts with them: the charts are a hierarchy of their own,
//! split where that of the mesh is. What the mesh shows at some level has the values of that level.
//!
//! Read in this order: [`Channel`], [`Blend`], [`Attributes`], [`ObjAttributes`] (the same for what an OBJ file says).
//!
//! **Deliberately not here**: normals as values. Those of a refined surface are no blend of the old ones; they are
//! computed anew, see [`NormalRule`].

mod channel;
mod chart;
mod labels;
mod normals;
mod obj;

pub use channel::{Blend, Channel};
pub use normals::NormalRule;
pub use obj::{Across, LeftOut, ObjAttributes, ObjRules};

use chart::{Chart, Done};
use glam::DVec4;
use labels::{Ancestry, FaceLabels};
use smallvec::SmallVec;

use crate::error::{ConfigError, RefineError};
use crate::id::VertexId;
use crate::limit::Limit;
use crate::mesh::Mesh;
use crate::scheme::Mask;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::{History, SplitKind};
use crate::subdivide::{Assignment, Control, Follower, Step, StepMasks, Subdivider, ValueId};

/// What [`Blend::Scheme`] does along the boundaries of charts: at seams and at the boundary of the mesh.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Seams {
    /// The boundary rule of the scheme, for each side by itself.
    #[default]
    Scheme,
    /// Values on a boundary stay and new ones lie between them on a straight line: charts keep their outline. (By √3 with
    /// the method *simple* values off the boundary are nevertheless those of [`Seams::Scheme`].)
    Linear,
}

/// Values of vertices, corners and faces that ride along with a mesh; see the [module](self).
///
/// ```
/// use vvmesh::adaptive::Uniform;
/// use vvmesh::attributes::{Attributes, Blend, Channel};
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider};
/// use vvmesh::shapes;
///
/// let mut mesh = shapes::grid(2, 2);
/// let mut history = History::new(&mesh, Keep::default());
/// let mut attributes = Attributes::default();
/// let height = mesh.positions().iter().map(|position| [position.y]).collect();
/// attributes.add_vertex_channel(&mesh, Channel::new("height", Blend::Scheme, height)?)?;
/// attributes.add_face_labels(&mesh, "row", &[0, 0, 0, 0, 1, 1, 1, 1])?;
///
/// let subdivider = Subdivider::new(Loop::default(), Uniform);
/// let (all, scratch) = (Selection::empty(), &mut Scratch::new());
/// attributes.step(&subdivider, &mut mesh, &mut history, &all, scratch, &mut Control::default())?;
/// let height = attributes.vertex_channel("height").unwrap();
/// assert!(mesh.vertices().all(|v| height.value(v.index()) == [mesh.position(v).y]));
/// assert_eq!(attributes.face_labels("row", &mesh).unwrap().iter().filter(|&&row| row == 1).count(), 16);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Attributes {
    vertex: Vec<Channel>,
    corner: Vec<CornerChannel>,
    labels: Vec<FaceLabels>,
    /// Since the first labels were added.
    ancestry: Option<Ancestry>,
    /// How many vertices the mesh had when something was last said of its faces.
    faces_of: usize,
}

/// A corner channel: the chart mesh, and a value at each of its vertices.
#[derive(Clone, Debug)]
pub struct CornerChannel {
    values: Channel,
    chart: Chart,
    /// 1 for the faces with values, 0 for others, if there are others.
    has_values: Option<FaceLabels>,
}

impl CornerChannel {
    /// The values at the chart vertices.
    #[must_use]
    pub fn values(&self) -> &Channel {
        &self.values
    }

    /// The vertex over which a chart vertex lies.
    ///
    /// # Panics
    /// If there are not so many chart vertices.
    #[must_use]
    pub fn vertex_below(&self, chart_vertex: usize) -> VertexId {
        self.chart.base(VertexId::new(chart_vertex))
    }

    /// For each triangle, in the order of the mesh, the chart vertices at its corners, of which
    /// [`CornerChannel::values`] has the values; `None` for one without.
    pub fn faces<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = Option<[u32; 3]>> + 'a {
        mesh.triangles().map(|triangle| {
            let face = self.chart.face_over(triangle.corners());
            face.map(|corners| corners.map(|v| v.index() as u32))
        })
    }
}

impl Attributes {
    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertex.is_empty() && self.corner.is_empty() && self.labels.is_empty()
    }

    /// Adds a channel with a value for each vertex of the mesh.
    ///
    /// # Errors
    /// If there are not as many values as vertices.
    pub fn add_vertex_channel(&mut self, mesh: &Mesh, channel: Channel) -> Result<(), ConfigError> {
        require("values of vertices", channel.len(), mesh.vertex_count())?;
        self.vertex.push(channel);
        Ok(())
    }

    /// Adds a channel with values at corners of faces. `corners` has for each triangle of the mesh, in order, the
    /// numbers of the values at its corners, or `None` for a triangle without values.
    ///
    /// A seam is an edge along which the numbers differ. If two sectors of faces around a vertex have the same number
    /// and are separated by seams, the charts touch there in a point: it does not move.
    ///
    /// # Errors
    /// If there are not as many triples as triangles, or a number is out of range.
    ///
    /// # Complexity
    /// O(faces).
    pub fn add_corner_channel(
        &mut self,
        mesh: &Mesh,
        history: &History,
        channel: &Channel,
        corners: &[Option<[u32; 3]>],
        seams: Seams,
    ) -> Result<(), ConfigError> {
        require("triangles with values", corners.len(), mesh.face_count())?;
        if let Some(value) = corners.iter().flatten().flatten().find(|&&value| value as usize >= channel.len()) {
            let expected = format!("less than {}, the number of values", channel.len());
            return Err(ConfigError { name: "value at a corner", value: value.to_string(), expected });
        }
        let (chart, value_of) = Chart::new(mesh, history, corners, seams);
        let has_values = corners.contains(&None).then(|| {
            let labels: Vec<u32> = corners.iter().map(|values| u32::from(values.is_some())).collect();
            self.labels_of(mesh, String::new(), &labels)
        });
        self.faces_of = mesh.vertex_count();
        self.corner.push(CornerChannel { values: channel.gathered(&value_of), chart, has_values });
        Ok(())
    }

    /// Adds a label for each triangle of the mesh, in order.
    ///
    /// # Errors
    /// If there are not as many labels as triangles.
    pub fn add_face_labels(&mut self, mesh: &Mesh, name: impl Into<String>, labels: &[u32]) -> Result<(), ConfigError> {
        require("labels of faces", labels.len(), mesh.face_count())?;
        let labels = self.labels_of(mesh, name.into(), labels);
        self.labels.push(labels);
        Ok(())
    }

    fn labels_of(&mut self, mesh: &Mesh, name: String, labels: &[u32]) -> FaceLabels {
        self.faces_of = mesh.vertex_count();
        self.ancestry.get_or_insert_with(|| Ancestry::new(mesh));
        FaceLabels::new(name, mesh, labels)
    }

    /// The vertex channel with a name; value `k` is that of vertex `k`.
    #[must_use]
    pub fn vertex_channel(&self, name: &str) -> Option<&Channel> {
        self.vertex.iter().find(|channel| channel.name() == name)
    }

    /// The corner channel with a name.
    #[must_use]
    pub fn corner_channel(&self, name: &str) -> Option<&CornerChannel> {
        self.corner.iter().find(|channel| channel.values.name() == name)
    }

    /// How many triangles have no values of a corner channel although they lie where there are some: those across a seam,
    /// after steps of √3. No chart has a triangle there, as it would have to be cut; the next step of the whole mesh
    /// makes it so. `None` if there is no such channel. O(faces · steps), but O(1) if no step was one of √3.
    #[must_use]
    pub fn faces_across_seams(&self, name: &str, mesh: &Mesh) -> Option<usize> {
        let channel = self.corner_channel(name)?;
        if !channel.chart.is_trisected() {
            return Some(0);
        }
        let has_values = |triangle| match (&channel.has_values, &self.ancestry) {
            (Some(labels), Some(ancestry)) => labels.of_halves(triangle, ancestry) != [0, 0],
            _ => true,
        };
        let without = mesh.triangles().zip(channel.faces(mesh)).filter(|(_, face)| face.is_none());
        Some(without.filter(|&(triangle, _)| has_values(triangle)).count())
    }

    /// How many triangles lie half in one label of this name and half in another, after steps of √3. `None` if there are
    /// no such labels. O(faces · steps), but O(1) if no step was one of √3.
    #[must_use]
    pub fn faces_across_labels(&self, name: &str, mesh: &Mesh) -> Option<usize> {
        let labels = self.labels.iter().find(|labels| labels.name() == name)?;
        let ancestry = self.ancestry.as_ref()?;
        if !ancestry.is_trisected() {
            return Some(0);
        }
        let halves = mesh.triangles().map(|triangle| labels.of_halves(triangle, ancestry));
        Some(halves.filter(|[one, other]| one != other).count())
    }

    /// The labels with a name, one for each triangle in the order of the mesh. O(faces · steps).
    #[must_use]
    pub fn face_labels(&self, name: &str, mesh: &Mesh) -> Option<Vec<u32>> {
        let labels = self.labels.iter().find(|labels| labels.name() == name)?;
        let ancestry = self.ancestry.as_ref()?;
        Some(mesh.triangles().map(|triangle| labels.of(triangle, ancestry)).collect())
    }

    /// Makes a step with [`Subdivider::step`], and takes everything along. Between steps positions and tags of the mesh may
    /// change, nothing else.
    ///
    /// # Errors
    /// Those of [`Subdivider::step`], among them [`RefineError::JoinedLate`] for a channel that follows the scheme and was
    /// added too late; or for labels of faces and corner channels that were added to a hierarchy after its first step, of
    /// which some faces may be taken back. The attributes are then as before, like the mesh.
    ///
    /// # Panics
    /// If the mesh is not the one that the attributes were added to, or was edited between steps; if a chart mesh would
    /// need more vertices than 32-bit ids name.
    ///
    /// # Complexity
    /// O(region), as the step itself. For each corner channel also O(sharp edges of the mesh) if some were tagged since
    /// the last step or that was on a hierarchy or by a scheme which does not read tags; and under √3 O(what waits for the next step at
    /// seams where regions end).
    pub fn step(
        &mut self,
        subdivider: &Subdivider,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        if self.is_empty() {
            return subdivider.step(mesh, history, selection, scratch, control);
        }
        // What was said of faces that the step takes back would be said of none.
        let begun = history.hierarchy().filter(|_| subdivider.is_on_hierarchy());
        let joined_late = begun.is_some_and(|hierarchy| hierarchy.input_count() < self.faces_of);
        if joined_late || self.corner.iter().any(|CornerChannel { values, chart, .. }| chart.joined_late(values)) {
            return Err(RefineError::JoinedLate);
        }
        let kind = subdivider.scheme().split_kind();
        if subdivider.scheme().reads_tags() {
            self.corner.iter_mut().for_each(|channel| channel.chart.take_tags(mesh));
        }
        let mut watch = Watch { also: control.follower.take(), ..Watch::new(&mut self.vertex, kind) };
        watch.splits.some_stay = subdivider.is_mobile();
        let mut watched = Control {
            max_faces: control.max_faces,
            progress: control.progress.as_mut().map(|progress| &mut **progress as _),
            follower: Some(&mut watch),
        };
        let step = subdivider.step(mesh, history, selection, scratch, &mut watched);
        let Watch { splits, also, .. } = watch;
        control.follower = also;
        let step = step?;
        let done = Done { subdivider, splits: &splits, mesh, history };
        for CornerChannel { values, chart, .. } in &mut self.corner {
            chart.follow(&done, values, scratch);
        }
        if let Some(ancestry) = &mut self.ancestry {
            ancestry.record(&splits, kind, history);
        }
        Ok(step)
    }

    /// Puts the values of channels that follow the scheme where infinitely many steps of a scheme would.
    ///
    /// `mesh` has its rings and tags as they are after the last step.
    ///
    /// # Panics
    /// If the limit of a vertex is not known yet, see [`Limit::mask`].
    pub fn move_to_limit(&mut self, mesh: &Mesh, limit: &impl Limit) {
        let around = mesh.neighborhood();
        for channel in &mut self.vertex {
            channel.move_by(mesh.vertices(), |channel, v| {
                let mut sum = channel.sum();
                limit.mask(around, v, &mut sum);
                sum.total()
            });
        }
        for CornerChannel { values, chart, .. } in &mut self.corner {
            chart.take_tags(mesh);
            chart.move_to_limit(limit, values);
        }
    }
}

fn require(name: &'static str, given: usize, needed: usize) -> Result<(), ConfigError> {
    if given == needed {
        return Ok(());
    }
    Err(ConfigError { name, value: given.to_string(), expected: format!("{needed} are needed") })
}

/// What a step did to the vertices, as its masks tell.
#[derive(Default)]
struct Splits {
    /// How many vertices there were before it.
    first: usize,
    /// What new vertices were made of, in the order of those.
    parents: Vec<[VertexId; 3]>,
    /// The vertices that were moved, new ones if it was after they were made; ascending if the step has one pass.
    moved: Vec<VertexId>,
    /// The values that are kept beside those of the vertices and were made anew, in order.
    kept: Vec<(VertexId, u8)>,
    /// Whether new vertices between two that were not moved are midpoints.
    some_stay: bool,
}

impl Splits {
    /// Whether the scheme makes the vertex between these, and not just their midpoint.
    fn are_blended(&self, ends: [VertexId; 2]) -> bool {
        !self.some_stay || ends.iter().any(|end| self.moved.binary_search(end).is_ok())
    }

    /// How many new vertices there are.
    fn len(&self) -> usize {
        self.parents.len()
    }

    /// The new vertices with what they were made of: the corners of a triangle, counter-clockwise; or the ends of an
    /// edge, the last one twice.
    fn made(&self) -> impl Iterator<Item = (VertexId, [VertexId; 3])> {
        (self.first..).map(VertexId::new).zip(self.parents.iter().copied())
    }
}

/// Follows a step: makes the values of vertex channels and remembers what was split.
struct Watch<'a, 'f> {
    channels: &'a mut [Channel],
    splits: Splits,
    kind: SplitKind,
    /// Which vertices keep their values, and are made linearly if they are new; of those behind its end none.
    is_fixed: &'a [bool],
    /// What becomes of new values on a boundary.
    seams: Seams,
    /// Who else follows.
    also: Option<&'f mut dyn Follower>,
}

impl<'a> Watch<'a, '_> {
    /// A step of a mesh.
    fn new(channels: &'a mut [Channel], kind: SplitKind) -> Self {
        let splits = Splits::default();
        Self { channels, splits, kind, is_fixed: &[], seams: Seams::Scheme, also: None }
    }

    /// A step of a chart mesh.
    fn over(values: &'a mut Channel, kind: SplitKind, is_fixed: &'a [bool], seams: Seams) -> Self {
        Self { is_fixed, seams, ..Self::new(std::slice::from_mut(values), kind) }
    }

    fn is_fixed(&self, v: VertexId) -> bool {
        self.is_fixed.get(v.index()).is_some_and(|&is_fixed| is_fixed)
    }

    /// The value of a new vertex.
    fn odd(&self, channel: &Channel, mask: &Mask<ValueId>, v: VertexId, parents: &[VertexId]) -> DVec4 {
        // The mask of 4-8 on a boundary is linear itself.
        let is_third = self.kind == SplitKind::Trisect && parents.len() == 2;
        let is_linear = self.is_fixed(v) || (is_third && self.seams == Seams::Linear);
        match channel.blend() {
            Blend::Scheme if !is_linear => mask.apply(|id| channel.at(id)),
            _ => channel.without_mask(parents, self.kind),
        }
    }
}

impl Follower for Watch<'_, '_> {
    fn follow(&mut self, step: &StepMasks<'_>) {
        if let Some(other) = &mut self.also {
            other.follow(step);
        }
        let (before, after) = (step.vertex_count_before(), step.vertex_count_after());
        self.splits.first = before;
        self.splits.parents.resize(after - before, [VertexId::new(0); 3]);
        self.channels.iter_mut().for_each(|channel| channel.grow(step));
        if self.channels.is_empty() {
            step.for_each_name(|id, parents| self.note(id, parents));
        } else {
            step.replay(self, |watch, Assignment { id, parents, .. }, mask| watch.make(id, parents, mask), Watch::put);
        }
    }

    fn has_kept(&self) -> bool {
        let also = self.also.as_ref().is_none_or(|other| other.has_kept());
        also && self.channels.iter().all(Channel::has_kept)
    }
}

/// A value for each channel; `None` for one that keeps what it has.
type Made = SmallVec<[Option<DVec4>; 2]>;

impl Watch<'_, '_> {
    /// Notes what was split and what moved.
    fn note(&mut self, id: ValueId, parents: &[VertexId]) {
        match (id, parents) {
            (ValueId::Kept(v, k), _) => self.splits.kept.push((v, k)),
            (ValueId::Shown(v), &[first, second, ..]) => {
                self.splits.parents[v.index() - self.splits.first] = [first, second, parents[parents.len() - 1]];
            }
            (ValueId::Shown(v), _) => self.splits.moved.push(v),
        }
    }

    fn make(&mut self, id: ValueId, parents: &[VertexId], mask: &Mask<ValueId>) -> Made {
        self.note(id, parents);
        let (ValueId::Shown(v) | ValueId::Kept(v, _)) = id;
        if !parents.is_empty() {
            return self.channels.iter().map(|channel| Some(self.odd(channel, mask, v, parents))).collect();
        }
        let is_fixed = self.is_fixed(v) && id == ValueId::Shown(v);
        let moves = |channel: &Channel| channel.blend() == Blend::Scheme && !is_fixed;
        self.channels.iter().map(|channel| moves(channel).then(|| mask.apply(|id| channel.at(id)))).collect()
    }

    fn put(&mut self, id: ValueId, made: Option<Made>) {
        match made {
            None => self.channels.iter_mut().for_each(|channel| channel.put(id, None)),
            Some(made) => {
                let changed = self.channels.iter_mut().zip(made).filter(|(_, value)| value.is_some());
                changed.for_each(|(channel, value)| channel.put(id, value));
            }
        }
    }
}
