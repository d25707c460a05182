//! A pen on a mesh.

use glam::DVec3;

use super::stars::Stars;
use super::{Aim, Brush, Event};
use crate::adaptive::AdaptiveMethod;
use crate::certify::Certificate;
use crate::error::{ConfigError, RefineError};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::pick::{FaceTree, Hit};
use crate::query::expand;
use crate::scheme::AnyScheme;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::{History, Keep, Region};
use crate::subdivide::{Control, Dynamic, Subdivider, promise};

/// How a pen refines.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum PenMethod {
    /// One [incremental](crate::adaptive::Incremental) step an event, of the touched vertices below the level that is wanted,
    /// with one ring around them. Vertices of the ring that have that level already take no part, so no face becomes finer
    /// than any event wanted it.
    ///
    /// It is exact where the surroundings are those of a uniform mesh, as on ground that was not drawn on before; where the
    /// pen comes beside what it drew, or dwells with its border in sight, closing edges are in the way.
    /// [`Pen::proven_level`] tells.
    Incremental,
    /// Each event asks [`Dynamic`] for the stars of the touched vertices at the level that is wanted, and gets them at once.
    /// Everything is exact.
    Dynamic,
}

/// What an event did.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Touch {
    /// Where the pen met the mesh; `None` if it met nothing, and then nothing was done.
    pub hit: Option<Hit>,
    /// How many vertices were touched.
    pub touched: usize,
    /// The level that was wanted of them.
    pub wanted: u8,
    /// How many of them were refined: those below it, under [`PenMethod::Dynamic`] those that were asked for, which are all
    /// that were not made at a greater level.
    pub refined: usize,
    /// How many of these are proven to be, after that, where a uniform mesh of some level has them, under
    /// [`PenMethod::Incremental`] with the same ring and neighbours.
    pub proven: usize,
    /// How many vertices there were before the event whose ring or position may be another after it.
    pub region: usize,
    /// How many vertices are new.
    pub added: usize,
}

/// A mesh that is drawn on, with all that this takes.
///
/// ```
/// use vvmesh::glam::DVec3;
/// use vvmesh::pick::Ray;
/// use vvmesh::scheme::Loop;
/// use vvmesh::shapes;
/// use vvmesh::stroke::{Aim, Brush, Event, Pen, PenMethod, Radius};
/// use vvmesh::subdivide::Control;
///
/// let mut pen = Pen::new(shapes::torus(24, 12, 2.0, 1.0), Loop::default(), PenMethod::Incremental)?;
/// let brush = Brush::new(Radius::Euclidean(0.6), 2, 0.5)?;
/// // Down from above, for a second at one place.
/// let aim = Aim::Along(Ray::new(DVec3::new(2.0, 0.1, 9.0), -DVec3::Z)?);
/// let mut wanted = Vec::new();
/// for time in [0.0, 0.25, 0.5, 1.0] {
///     wanted.push(pen.touch(&Event { time, aim, brush }, &mut Control::default())?.wanted);
/// }
/// assert_eq!(wanted, [1, 1, 2, 2]);
/// assert!(pen.mesh().face_count() > 576);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Pen {
    mesh: Mesh,
    history: History,
    tree: FaceTree,
    way: Way,
    dwelling: Option<Dwelling>,
    scratch: Scratch,
}

#[derive(Debug)]
enum Way {
    Incremental { scheme: AnyScheme, stars: Stars },
    Dynamic(Dynamic),
}

/// Where and when a pen came to where it still is.
#[derive(Clone, Copy, Debug)]
struct Dwelling {
    position: DVec3,
    distance: f64,
    since: f64,
    brush: Brush,
}

/// The region of an incremental step under a pen.
#[derive(Debug)]
struct Chosen(Vec<VertexId>);

impl AdaptiveMethod for Chosen {
    fn region(&self, _mesh: &Mesh, _selection: &Selection, scratch: &mut Scratch) -> Region {
        let mut vertices = scratch.take_list();
        vertices.extend_from_slice(&self.0);
        Region::induced(vertices)
    }

    fn promises_exactness(&self) -> bool {
        false
    }
}

impl Pen {
    /// A pen on a mesh on which nothing was drawn yet.
    ///
    /// # Errors
    /// For a scheme that does not split triangles in four.
    ///
    /// # Complexity
    /// That of [`FaceTree::new`].
    pub fn new(mesh: Mesh, scheme: impl Into<AnyScheme>, method: PenMethod) -> Result<Self, ConfigError> {
        let scheme = scheme.into();
        promise(&scheme, "dynamic")?;
        let reach = scheme.reach().expect("schemes that split in four have one");
        let way = match method {
            PenMethod::Incremental => Way::Incremental { scheme, stars: Stars::new(&mesh, reach) },
            PenMethod::Dynamic => Way::Dynamic(Dynamic::new(scheme)?),
        };
        // A hierarchy keeps names by itself, and the certificate costs nothing on it.
        let is_incremental = method == PenMethod::Incremental;
        let keep = Keep { names: is_incremental, certificate: !is_incremental };
        let (history, tree) = (History::new(&mesh, keep), FaceTree::new(&mesh));
        Ok(Self { mesh, history, tree, way, dwelling: None, scratch: Scratch::new() })
    }

    /// Draws.
    ///
    /// # Errors
    /// Those of [`Subdivider::step`]. The mesh is then as before.
    ///
    /// # Complexity
    /// O(what is touched, with the rings around it, and what is new) but for finding the place, see [`FaceTree::pick`], and
    /// for [`FaceTree::update`]; nothing else grows with the mesh.
    pub fn touch(&mut self, event: &Event, control: &mut Control<'_>) -> Result<Touch, RefineError> {
        let Some(hit) = self.find(event.aim) else {
            self.dwelling = None;
            return Ok(Touch::default());
        };
        let touched = event.brush.touched(&self.mesh, &hit, &mut self.scratch);
        let wanted = event.brush.wanted(self.dwelt(event, &hit, &touched));
        let done = match self.way {
            Way::Incremental { .. } => self.step(&touched, wanted, control)?,
            Way::Dynamic(_) => self.ask(&touched, wanted, control)?,
        };
        Ok(Touch { hit: Some(hit), touched: touched.len(), wanted, ..done })
    }

    /// The mesh as it is.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// What is remembered of the steps.
    #[must_use]
    pub fn history(&self) -> &History {
        &self.history
    }

    /// The mesh, for good.
    #[must_use]
    pub fn into_mesh(self) -> Mesh {
        self.mesh
    }

    /// The level of the uniform mesh in which a vertex is proven to be where it is here, bit for bit. With
    /// [`PenMethod::Incremental`] its neighbours are, too, and `None` if that is not proven; with [`PenMethod::Dynamic`] every
    /// vertex has one.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn proven_level(&self, v: VertexId) -> Option<usize> {
        match &self.way {
            Way::Incremental { stars, .. } => stars.level(v).map(usize::from),
            Way::Dynamic(_) => Certificate::new(&self.mesh, &self.history)?.exact_level(v),
        }
    }

    /// Bytes held: the mesh and its history, with what is proven, and the boxes around faces.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let proven = match &self.way {
            Way::Incremental { stars, .. } => stars.memory_bytes(),
            Way::Dynamic(_) => 0,
        };
        self.mesh.memory_bytes() + self.history.memory_bytes() + self.tree.memory_bytes() + proven
    }

    fn find(&self, aim: Aim) -> Option<Hit> {
        let pick = |ray| self.tree.pick(&self.mesh, &ray);
        match aim {
            Aim::Along(ray) => pick(ray),
            Aim::Near(ray) => {
                let hits = [pick(ray), pick(ray.reversed())].into_iter().flatten();
                hits.min_by(|one, other| one.distance.total_cmp(&other.distance))
            }
        }
    }

    /// For how long the pen has been where it is.
    fn dwelt(&mut self, event: &Event, hit: &Hit, touched: &Selection) -> f64 {
        let (&Event { time, brush, .. }, position) = (event, hit.position);
        let stays = |at: &Dwelling| at.brush == brush && at.position.distance(position) <= at.distance;
        let distance = brush.dwelling_distance(&self.mesh, hit, touched);
        let dwelling = self.dwelling.filter(stays).unwrap_or(Dwelling { position, distance, since: time, brush });
        self.dwelling = Some(dwelling);
        time - dwelling.since
    }

    /// Makes one incremental step of what is touched and below a level.
    fn step(&mut self, touched: &Selection, wanted: u8, control: &mut Control<'_>) -> Result<Touch, RefineError> {
        let Self { mesh, history, tree, way, scratch, .. } = self;
        let Way::Incremental { scheme, stars } = way else { unreachable!("the method is incremental") };
        let is_below = |v: &VertexId| level(mesh, history, *v).is_some_and(|level| level < wanted);
        let below: Selection = touched.vertices().iter().copied().filter(is_below).collect();
        if below.is_empty() {
            return Ok(Touch::default());
        }
        let mut region = below.vertices().to_vec();
        expand(mesh.rotation(), &mut region, 1, scratch);
        region.retain(is_below);
        region.sort_unstable();

        let first = mesh.vertex_count();
        let subdivider = Subdivider::new(scheme.clone(), Chosen(region.clone()));
        subdivider.step(mesh, history, &below, scratch, control)?.recycle(scratch);
        stars.follow(mesh, history, &region);
        tree.update(mesh, region.iter().copied().chain((first..mesh.vertex_count()).map(VertexId::new)));
        Ok(Touch {
            refined: below.len(),
            proven: below.vertices().iter().filter(|&&v| stars.level(v).is_some()).count(),
            region: region.len(),
            added: mesh.vertex_count() - first,
            ..Touch::default()
        })
    }

    /// Asks for the stars of what is touched and has any at a level.
    fn ask(&mut self, touched: &Selection, wanted: u8, control: &mut Control<'_>) -> Result<Touch, RefineError> {
        let Self { mesh, history, tree, way, scratch, .. } = self;
        let Way::Dynamic(dynamic) = way else { unreachable!("the method is dynamic") };
        let has_star = |v: &VertexId| history.level(*v).unwrap_or(0) <= wanted;
        let asked: Selection = touched.vertices().iter().copied().filter(has_star).collect();
        let change = dynamic.refine(mesh, history, &asked, wanted, scratch, control)?;
        tree.update(mesh, change.changed.iter().copied());
        Ok(Touch {
            refined: asked.len(),
            proven: asked.len(),
            region: change.changed.len() - change.added.len(),
            added: change.added.len(),
            ..Touch::default()
        })
    }
}

/// The level of the coarsest face around a vertex; `None` if there is no face. O(valence).
fn level(mesh: &Mesh, history: &History, v: VertexId) -> Option<u8> {
    let level = |v| history.level(v).unwrap_or(0);
    mesh.ring(v).pairs().map(|(a, b)| level(v).max(level(a)).max(level(b))).min()
}
