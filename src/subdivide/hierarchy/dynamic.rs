//! Stars that are asked for and given up again, in any order.

use super::shrink::shrink;
use super::{Change, Demand, Site, work_on};
use crate::error::{ConfigError, RefineError};
use crate::id::{Triangle, VertexId};
use crate::mesh::Mesh;
use crate::scheme::AnyScheme;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::hierarchy::Levels;
use crate::step::History;
use crate::subdivide::promise;
use crate::subdivide::{Control, require_blended};

/// A mesh that is refined and coarsened anywhere, in any order.
///
/// What is asked for is a *star*: all triangles around a vertex at a level. The mesh holds what is asked for and what that
/// needs, and nothing else; so it is a function of the set of stars that are asked for. Whatever was asked for and given up
/// before, the same set gives vertices of the same names, at the same positions to the last bit, and when all is given up
/// the mesh is the input: the number of vertices, rings with their starts, positions and tags.
///
/// After every operation the mesh is conforming, triangles that share a vertex differ by at most one level, and every vertex
/// is where uniform refinement of some number of levels has it ([`Certificate::exact_level`](crate::certify::Certificate)).
///
/// Ids of vertices stay what they are. One that is not needed any more is isolated until its id is used again, the smallest
/// first; ids at the end are given up. So ids depend on the order of operations; [`History::same_names`] does not.
///
/// ```
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Dynamic};
/// use vvmesh::{VertexId, shapes};
///
/// let (mut mesh, mut scratch) = (shapes::icosahedron(), Scratch::new());
/// let mut history = History::new(&mesh, Keep::default());
/// let dynamic = Dynamic::new(Loop::default())?;
/// let v = VertexId::new(0);
/// dynamic.refine(&mut mesh, &mut history, v, 3, &mut scratch, &mut Control::default())?;
/// assert_eq!((mesh.ring(v).valence(), history.level(mesh.ring(v).neighbors()[0])), (5, Some(3)));
/// let change = dynamic.coarsen(&mut mesh, &mut history, v, 3, &mut scratch)?;
/// assert!(!change.removed.is_empty());
/// assert_eq!(mesh.positions(), shapes::icosahedron().positions());
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Debug)]
pub struct Dynamic {
    scheme: AnyScheme,
}

/// Whose stars are asked for, or given up.
#[derive(Clone, Copy, Debug)]
pub enum Target<'a> {
    /// That of a vertex.
    Vertex(VertexId),
    /// Those of the corners of a triangle.
    Face(Triangle),
    /// Those of all selected vertices.
    Selection(&'a Selection),
}

impl From<VertexId> for Target<'_> {
    fn from(v: VertexId) -> Self {
        Self::Vertex(v)
    }
}

impl From<Triangle> for Target<'_> {
    fn from(triangle: Triangle) -> Self {
        Self::Face(triangle)
    }
}

impl<'a> From<&'a Selection> for Target<'a> {
    fn from(selection: &'a Selection) -> Self {
        Self::Selection(selection)
    }
}

impl Target<'_> {
    fn vertices(&self) -> Vec<VertexId> {
        match self {
            Self::Vertex(v) => vec![*v],
            Self::Face(triangle) => triangle.corners().to_vec(),
            Self::Selection(selection) => selection.vertices().to_vec(),
        }
    }
}

impl Dynamic {
    /// With a scheme that splits triangles in four.
    ///
    /// # Errors
    /// For another scheme.
    pub fn new(scheme: impl Into<AnyScheme>) -> Result<Self, ConfigError> {
        let scheme = scheme.into();
        promise(&scheme, "dynamic")?;
        Ok(Self { scheme })
    }

    /// Asks for stars at a level. One that is asked for already stays so; those of level 0 are always there.
    ///
    /// # Errors
    /// [`RefineError::NoVertex`], [`RefineError::NoStar`] for a level below that at which a vertex was made, a history of
    /// another method or scheme, and those of [`Subdivider::step`](crate::subdivide::Subdivider::step). The mesh and the
    /// history are then as before.
    ///
    /// # Complexity
    /// O(what is new, and the valences there); nothing grows with the mesh. A new vertex on an edge at a vertex of the
    /// input costs its valence.
    pub fn refine<'t>(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        target: impl Into<Target<'t>>,
        level: u8,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Change, RefineError> {
        require_blended(&self.scheme, mesh)?;
        let vertices = target.into().vertices();
        work_on(&self.scheme, Demand::Stars, mesh, history, scratch, |site| {
            for &v in &vertices {
                let birth = level_of(&site, v)?;
                if level < birth {
                    return Err(RefineError::NoStar { vertex: v, level, birth });
                }
            }
            ask(site, vertices.into_iter().map(|v| (v, level)).collect(), control)
        })
    }

    /// Gives stars up that were asked for at this very level. Nobody can follow this, nor what comes after it.
    ///
    /// What nothing else needs goes; what something needs stays until
    /// it does not.
    ///
    /// # Errors
    /// [`RefineError::NoVertex`], [`RefineError::NotAsked`], a history of another method or scheme. The mesh and the history
    /// are then as before.
    ///
    /// # Complexity
    /// O(what goes, and the valences there).
    pub fn coarsen<'t>(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        target: impl Into<Target<'t>>,
        level: u8,
        scratch: &mut Scratch,
    ) -> Result<Change, RefineError> {
        let vertices = target.into().vertices();
        work_on(&self.scheme, Demand::Stars, mesh, history, scratch, |site| {
            for &v in &vertices {
                level_of(&site, v)?;
                if !site.refinement.asked.contains(&(v, level)) {
                    return Err(RefineError::NotAsked { vertex: v, level });
                }
            }
            for &v in &vertices {
                site.refinement.asked.remove(&(v, level));
            }
            Ok(shrink(site, vertices))
        })
    }
}

/// The level at which a vertex was made, if there is such a vertex.
fn level_of(site: &Site<'_>, v: VertexId) -> Result<u8, RefineError> {
    let hierarchy = &site.refinement.hierarchy;
    if hierarchy.contains(v) { Ok(hierarchy.level(v)) } else { Err(RefineError::NoVertex(v)) }
}

/// Asks for stars at levels that are not below those of birth.
fn ask(site: Site<'_>, stars: Vec<(VertexId, u8)>, control: &mut Control<'_>) -> Result<Change, RefineError> {
    let Site { scheme, mesh, refinement, scratch } = site;
    let again = Site { scheme, mesh, refinement: &mut *refinement, scratch };
    let change =
        again.grow(control, |grower| stars.iter().try_for_each(|&(v, level)| grower.require_star(v, level)))?;
    refinement.asked.extend(stars.into_iter().filter(|&(_, level)| level > 0));
    Ok(change)
}

/// One step: the stars of all selected vertices at a level. They are followed by every vertex on an edge between two.
pub(super) fn step(
    site: Site<'_>,
    selection: &Selection,
    level: u8,
    control: &mut Control<'_>,
) -> Result<(Change, Selection), RefineError> {
    let births: Result<Vec<u8>, RefineError> = selection.vertices().iter().map(|&v| level_of(&site, v)).collect();
    let stars = selection.vertices().iter().zip(births?).map(|(&v, birth)| (v, level.max(birth))).collect();
    let Site { scheme, mesh, refinement, scratch } = site;
    let again = Site { scheme, mesh: &mut *mesh, refinement: &mut *refinement, scratch: &mut *scratch };
    let change = ask(again, stars, control)?;

    let hierarchy = &refinement.hierarchy;
    let levels = Levels::new(mesh.rotation(), hierarchy);
    let marks = scratch.marked(mesh.vertex_count(), selection.vertices());
    let mut followed = selection.vertices().to_vec();
    for &v in selection.vertices().iter().filter(|&&v| hierarchy.level(v) < level) {
        let ring = levels.ring(v, level - 1);
        let between = ring.as_ring().iter().filter(|&w| v < w && marks.is_set(w));
        followed.extend(between.filter_map(|w| hierarchy.odd(v, w)));
    }
    Ok((change, followed.into_iter().collect()))
}
