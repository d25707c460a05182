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
//! A face of the refined mesh lies in one face of the input, whose label it keeps. Under √3 it does not: an edge that is
//! turned crosses the old one, also where that is a seam. So corner channels and labels ride along with the split in four
//! only, and a step of another kind refuses them; vertex channels ride along with every scheme and method.
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
pub use obj::{LeftOut, ObjAttributes, ObjRules};

use chart::Chart;
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
    /// Values on a boundary stay and new ones lie half way between them: charts keep their outline.
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
}

/// A corner channel: the chart mesh, and a value at each of its vertices.
#[derive(Clone, Debug)]
pub struct CornerChannel {
    values: Channel,
    seams: Seams,
    chart: Chart,
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
            let face = self.chart.face_over(mesh, triangle.corners());
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
        let (chart, value_of) = Chart::new(mesh, history, corners);
        self.corner.push(CornerChannel { values: channel.gathered(&value_of), seams, chart });
        Ok(())
    }

    /// Adds a label for each triangle of the mesh, in order.
    ///
    /// # Errors
    /// If there are not as many labels as triangles.
    pub fn add_face_labels(&mut self, mesh: &Mesh, name: impl Into<String>, labels: &[u32]) -> Result<(), ConfigError> {
        require("labels of faces", labels.len(), mesh.face_count())?;
        self.labels.push(FaceLabels::new(name.into(), mesh, labels));
        self.ancestry.get_or_insert_with(|| Ancestry::new(mesh));
        Ok(())
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
    /// Those of [`Subdivider::step`] (among them [`RefineError::JoinedLate`] for a vertex channel that follows the scheme and was
    /// added too late), and [`RefineError::Unfollowed`] for labels of faces and corner channels if the
    /// scheme does not split triangles in four. The attributes are then as before, like the mesh.
    ///
    /// # Panics
    /// If the mesh is not the one that the attributes were added to, or was edited between steps; if a chart mesh would
    /// need more vertices than 32-bit ids name.
    ///
    /// # Complexity
    /// O(region), as the step itself, and O(sharp edges of the mesh) for each corner channel.
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
        let kind = subdivider.scheme().split_kind();
        let nothing_on_faces = self.corner.is_empty() && self.labels.is_empty();
        if kind != SplitKind::Quadrisect && !nothing_on_faces {
            return Err(RefineError::Unfollowed { asked: kind.name() });
        }
        if subdivider.takes_back() && !nothing_on_faces {
            return Err(RefineError::Unfollowed { asked: "red-green refinement" });
        }
        self.corner.iter_mut().for_each(|channel| channel.chart.take_tags(mesh));
        let splits = Splits { some_stay: subdivider.is_mobile(), ..Splits::default() };
        let mut watch = Watch { channels: &mut self.vertex, splits, kind, also: control.follower.take() };
        let mut watched = Control {
            max_faces: control.max_faces,
            progress: control.progress.as_mut().map(|progress| &mut **progress as _),
            follower: Some(&mut watch),
        };
        let step = subdivider.step(mesh, history, selection, scratch, &mut watched);
        let Watch { splits, also, .. } = watch;
        control.follower = also;
        let step = step?;
        for CornerChannel { values, seams, chart } in &mut self.corner {
            chart.follow(&splits, mesh, subdivider.scheme(), values, *seams, scratch);
        }
        if let Some(ancestry) = &mut self.ancestry {
            ancestry.record(&splits.parents);
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
            channel.move_by(mesh.vertices(), |v, mask| limit.mask(around, v, mask));
        }
        for CornerChannel { values, seams, chart } in &mut self.corner {
            chart.take_tags(mesh);
            chart.move_to_limit(limit, values, *seams);
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
    /// The ends of the edges on which new vertices were made, the older first, in the order of those.
    parents: Vec<[VertexId; 2]>,
    /// The old vertices that were moved, ascending.
    moved: Vec<VertexId>,
    /// Whether new vertices between two that were not moved are midpoints.
    some_stay: bool,
}

impl Splits {
    /// Whether the scheme makes the vertex between these, and not just their midpoint.
    fn are_blended(&self, ends: [VertexId; 2]) -> bool {
        !self.some_stay || ends.iter().any(|end| self.moved.binary_search(end).is_ok())
    }

    /// The new vertices with the ends of their edges.
    fn made(&self) -> impl Iterator<Item = (VertexId, [VertexId; 2])> {
        (self.first..).map(VertexId::new).zip(self.parents.iter().copied())
    }
}

/// Follows a step: makes the values of vertex channels and remembers what was split.
struct Watch<'a, 'f> {
    channels: &'a mut [Channel],
    splits: Splits,
    kind: SplitKind,
    /// Who else follows.
    also: Option<&'f mut dyn Follower>,
}

impl Follower for Watch<'_, '_> {
    fn follow(&mut self, step: &StepMasks<'_>) {
        if let Some(other) = &mut self.also {
            other.follow(step);
        }
        self.splits.first = step.vertex_count_before();
        self.channels.iter_mut().for_each(|channel| channel.grow(step));
        step.replay(self, |watch, Assignment { id, parents, .. }, mask| watch.make(id, parents, mask), Watch::put);
    }

    fn has_kept(&self) -> bool {
        let also = self.also.as_ref().is_none_or(|other| other.has_kept());
        also && self.channels.iter().all(Channel::has_kept)
    }
}

/// A value for each channel; `None` for one that keeps what it has.
type Made = SmallVec<[Option<DVec4>; 2]>;

impl Watch<'_, '_> {
    fn make(&mut self, id: ValueId, parents: &[VertexId], mask: &Mask<ValueId>) -> Made {
        if !parents.is_empty() {
            // Where it is asked for, there are two.
            self.splits.parents.extend(<[VertexId; 2]>::try_from(parents));
            return self.channels.iter().map(|channel| Some(channel.odd(mask, parents, self.kind))).collect();
        }
        match id {
            ValueId::Shown(v) if v.index() < self.splits.first => self.splits.moved.push(v),
            _ => {}
        }
        let blend = |channel: &Channel| (channel.blend() == Blend::Scheme).then(|| mask.apply(|id| channel.at(id)));
        self.channels.iter().map(blend).collect()
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
