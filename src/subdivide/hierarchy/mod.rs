//! Steps on a hierarchy: what is asked for, then positions, then the mesh that is shown.
//!
//! The hierarchy itself is topology ([`crate::split`]). Where a vertex is at a level follows from masks of the level before,
//! read from a *patch*: the stars that a mask reads, as they are at that level. Restriction sees to it that they are complete,
//! so masks, and the order in which they are summed, are those of uniform refinement, and so is every bit.
//!
//! *Proof that all is known.* A triangle of level l is split only if the stars of its corners at level l are complete. A vertex
//! w in such a star, of p, is at level l where the even mask of level l − 1 put it, or was born at l. In the first case p was
//! born at l on an edge at w, as every edge of level l ≥ 1 has an end born there; the star of p was made of triangles with
//! the corner w, so that of w at l − 1 is complete. ∎
//!
//! Where stars are asked for a vertex is shown where it is at the greatest level at which its star is complete, and if it is at
//! none, where it was born; where triangles are, at the level of the finest with this corner.
//!
//! **Deliberately not here**: rings, restriction and closing ([`crate::split`]), weights ([`crate::scheme`]).

mod dynamic;
mod follow;
mod grow;
mod leaves;
mod over;
mod patch;
mod sharpness;
mod shrink;

pub use dynamic::{Dynamic, Target};
pub(crate) use leaves::{Leaf, Leaves};
pub(crate) use over::GrownOver;

use grow::grow;
use sharpness::of_vertex;

use super::{Control, Step, parts};
use crate::certify::Certificate;
use crate::error::RefineError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::{AnyScheme, LoopWeights, with_scheme};
use crate::scratch::Scratch;
use crate::select::{Elements, Selection};
use crate::split::hierarchy::{Grower, Levels, leaves_around, show};
use crate::step::{History, Refinement, SplitKind};

/// What an operation on a hierarchy did to the mesh that is shown.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Change {
    /// The vertices that are new, ascending. Ids of vertices that were removed before are used again, the smallest first.
    pub added: Vec<VertexId>,
    /// The vertices that are no more, ascending. They are isolated until their ids are used again; those at the end are cut
    /// off.
    pub removed: Vec<VertexId>,
    /// The vertices, old and new, whose ring or position may be another, ascending.
    pub changed: Vec<VertexId>,
    /// Those of them that lie on an edge of a leaf, ascending.
    pub t_vertices: Vec<VertexId>,
    /// Those of them that are corners of a leaf, to which closing it adds an edge, ascending.
    pub o_vertices: Vec<VertexId>,
}

/// What a method asks of a hierarchy in each step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Demand {
    /// That the leaves inside of the selection be split, with red closure; nothing is ever given up.
    Leaves,
    /// That stars be complete.
    Stars,
}

/// The name by which a hierarchy remembers a scheme, with its weights: positions that different ones make do not go together.
pub(crate) fn name(scheme: &AnyScheme) -> &'static str {
    match scheme {
        AnyScheme::Loop(scheme) if scheme.weights() == LoopWeights::Warren => "loop with Warren's weights",
        other => other.name(),
    }
}

/// What every operation of a scheme on a hierarchy works on.
struct Site<'a> {
    scheme: &'a AnyScheme,
    mesh: &'a mut Mesh,
    refinement: &'a mut Refinement,
    scratch: &'a mut Scratch,
}

impl Site<'_> {
    fn grow(
        self,
        control: &mut Control<'_>,
        add: impl FnOnce(&mut Grower<'_>) -> Result<(), RefineError>,
    ) -> Result<Change, RefineError> {
        with_scheme!(self.scheme, scheme => grow(scheme, self, control, add), else unreachable!("other schemes are refused"))
    }
}

/// Works on the hierarchy of a history, which begins there if it is the first time.
fn work_on<T>(
    scheme: &AnyScheme,
    demand: Demand,
    mesh: &mut Mesh,
    history: &mut History,
    scratch: &mut Scratch,
    work: impl FnOnce(Site<'_>) -> Result<T, RefineError>,
) -> Result<T, RefineError> {
    let (begun, made_by) = (history.refinement().is_some(), name(scheme));
    let mut refinement = history.take_refinement(mesh, made_by, demand == Demand::Stars)?;
    let result = work(Site { scheme, mesh, refinement: &mut refinement, scratch });
    if begun || result.is_ok() {
        history.keep_refinement(refinement);
    }
    result
}

/// Makes one step of a method.
pub(super) fn step(
    scheme: &AnyScheme,
    demand: Demand,
    mesh: &mut Mesh,
    history: &mut History,
    selection: &Selection,
    scratch: &mut Scratch,
    control: &mut Control<'_>,
) -> Result<Step, RefineError> {
    let level = u8::try_from(history.step_count() + 1).map_err(|_| RefineError::TooDeep)?;
    let (change, selection_after, passes) = work_on(scheme, demand, mesh, history, scratch, |site| match demand {
        Demand::Stars => dynamic::step(site, selection, level, control).map(|(change, after)| (change, after, 1)),
        Demand::Leaves => red_green(site, selection, control),
    })?;
    let Change { added, changed, mut t_vertices, mut o_vertices, .. } = change;
    let max_valence = changed.iter().map(|&v| mesh.ring(v).valence()).max().unwrap_or(0);
    history.record(SplitKind::Quadrisect, mesh.vertex_count(), std::iter::empty(), &[], max_valence);
    let is_new = |v: &VertexId| added.binary_search(v).is_ok();
    t_vertices.retain(is_new);
    o_vertices.retain(|v| !is_new(v));
    // Who is as fine as the steps can make it was made so by the last of them, and changed.
    let certified = Certificate::new(mesh, history)
        .map(|certificate| changed.iter().filter(|&&v| certificate.is_certified(v)).count());
    Ok(Step {
        selection: selection_after,
        selected: selection.vertices().len(),
        region: changed.len() - added.len(),
        split_edges: added.len(),
        passes,
        t_vertices,
        o_vertices,
        certified,
        ..Step::default()
    })
}

/// Splits the leaves inside of a selection, or in which selected faces lie, then all with two split edges and more, until there is none. Answers in how many
/// passes, too.
fn red_green(
    site: Site<'_>,
    selection: &Selection,
    control: &mut Control<'_>,
) -> Result<(Change, Selection, usize), RefineError> {
    let Site { scheme, mesh, refinement, scratch } = site;
    let hierarchy = &refinement.hierarchy;
    let leaves = match selection.elements() {
        Elements::Faces(faces) => parts::leaves(hierarchy, faces),
        _ => {
            let marks = scratch.marked(mesh.vertex_count(), selection.vertices());
            let levels = Levels::new(mesh.rotation(), hierarchy);
            let around = selection.vertices().iter().flat_map(|&v| leaves_around(levels, v));
            around.filter(|[v, a, b]| v < a && v < b && marks.is_set(*a) && marks.is_set(*b)).collect()
        }
    };
    let (mut between, mut passes) = (Vec::new(), usize::from(!leaves.is_empty()));
    let site = Site { scheme, mesh: &mut *mesh, refinement: &mut *refinement, scratch };
    let change = site.grow(control, |grower| {
        for &leaf in &leaves {
            grower.split_restricted(leaf)?;
        }
        passes += grower.close_red()?;
        between.extend(grower.made_between(|v| selection.contains(*v)));
        Ok(())
    })?;
    let followed = match selection.elements() {
        Elements::Faces(_) => parts::shown(&refinement.hierarchy, mesh.rotation(), leaves),
        _ => selection.vertices().iter().copied().chain(between).collect(),
    };
    Ok((change, followed, passes))
}

/// Shows what became of a hierarchy in which these vertices are new, or none any more.
fn show_change(mesh: &mut Mesh, refinement: &Refinement, changed: &[VertexId], scratch: &mut Scratch) -> Change {
    let (rotation, positions, tags) = mesh.parts_mut();
    let mut change = Change::default();
    show(rotation, &refinement.hierarchy, changed, scratch, |v, shown| {
        let level = shown.level(refinement.goes_back);
        if let Some(position) = refinement.places.at(v, level) {
            positions[v.index()] = position;
        }
        if refinement.input_tags.vertex_sharpness(v).is_semi_sharp() {
            tags.set_vertex_sharpness(v, of_vertex(&refinement.input_tags, v, level));
        }
        change.changed.push(v);
        if shown.hangs {
            change.t_vertices.push(v);
        }
        if shown.closing > 0 && !shown.hangs {
            change.o_vertices.push(v);
        }
    });
    for list in [&mut change.changed, &mut change.t_vertices, &mut change.o_vertices] {
        list.sort_unstable();
    }
    change
}
