//! A step of static/mobile subdivision: vertices move as long as they are farther from their limit than asked for.
//!
//! | mobile corners of a face | what becomes of it |
//! |---|---|
//! | none | it stays for ever |
//! | one | four faces; the new vertex opposite to the mobile corner is a midpoint |
//! | two | four faces; one corner stays |
//! | three | four faces, as everywhere |
//!
//! A mobile vertex takes Loop's even mask, and so do new vertices with a mobile end Loop's odd mask; they may move in the next
//! step. All others are static, new ones at the middle of their edge. So around whoever may move every face was split in every
//! step: its ring is whole, and its limit known. Cracks lie along edges between static vertices only, where they are closed
//! without a trace in what follows. Source: `[mesh-size]`, section 3.
//!
//! **Deliberately not here**: what is remembered between steps ([`crate::step`]), rings, masks.

use std::borrow::Cow;

use super::quadrisect::Quadrisection;
use super::{Request, Step};
use crate::accuracy::Accuracy;
use crate::certify::Certificate;
use crate::error::RefineError;
use crate::id::{Triangle, VertexId};
use crate::limit::LoopLimit;
use crate::mesh::{Mesh, Neighborhood};
use crate::parallel;
use crate::query::expand;
use crate::scheme::{Loop, MaskSink, Midpoint, Reach, Scheme};
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::Diagonal;
use crate::step::{History, Parent, Region};

/// What a step of static/mobile subdivision told apart.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct MobileStep {
    /// How many vertices were farther from their limit than asked for, and moved. With none there is nothing left to do, and
    /// nothing was done.
    pub mobile_vertices: usize,
    /// How many vertices of the mesh before the step were not.
    pub static_vertices: usize,
    /// How many of the faces that the step before made, or of the input, have no mobile corner, one, two, three.
    pub faces_by_mobile_corners: [usize; 4],
    /// How many faces there are after the step, not counting those that close cracks: those of
    /// [`History::unclosed`](crate::step::History::unclosed).
    pub faces: usize,
}

/// Who decides which vertices are mobile.
#[derive(Debug)]
pub(super) struct Mobile {
    limit: LoopLimit,
    accuracy: Accuracy,
}

impl Mobile {
    /// For the limit of a scheme.
    pub(super) fn new(scheme: &Loop, accuracy: Accuracy) -> Self {
        Self { limit: LoopLimit::new(scheme.weights()), accuracy }
    }

    /// The region of a step: the stars of those who may move, are selected, and are too far from their limit.
    pub(super) fn region(&self, mesh: &Mesh, history: &History, selection: &Selection) -> Region {
        let selected = selection.vertices();
        let may_move = match history.mobility() {
            Some(mobility) => Cow::Owned(intersection(&mobility.candidates, selected)),
            None => Cow::Borrowed(selected),
        };
        let mobile = |k: usize| Some(may_move[k]).filter(|&v| self.is_far(mesh, v));
        Region::stars(parallel::gather(0..may_move.len(), mobile))
    }

    /// Whether a vertex is farther from its limit than asked for, or has none that is known yet.
    fn is_far(&self, mesh: &Mesh, v: VertexId) -> bool {
        self.limit.distance(mesh, v).is_none_or(|distance| distance > self.accuracy.distance())
    }
}

/// What is in both of two ascending lists; the second is likely to be longer.
fn intersection(few: &[VertexId], many: &[VertexId]) -> Vec<VertexId> {
    few.iter().copied().filter(|v| many.binary_search(v).is_ok()).collect()
}

/// Makes one step; the region is that of [`Mobile::region`].
pub(super) fn step(scheme: &Loop, diagonal: Diagonal, request: Request<'_, '_>) -> Result<Step, RefineError> {
    let Request { mesh, history, selection, region, scratch, control } = request;
    let mobile = region.vertices(mesh.vertex_count());
    let (counts, settled) = sort_faces(mesh, history, &mobile, scratch);
    if mobile.is_empty() {
        let certified = Certificate::new(mesh, history).map(|certificate| certificate.certified().count());
        let (selection, selected) = (selection.clone(), selection.vertices().len());
        return Ok(Step { selection, selected, certified, mobile: Some(counts), ..Step::default() });
    }
    let placing = Placing { scheme, mobile: &mobile };
    let request =
        Request { mesh: &mut *mesh, history: &mut *history, selection, region, scratch: &mut *scratch, control };
    let step = Quadrisection { scheme: &placing, exact: false, diagonal }.step(request)?;

    let mut candidates = mobile.into_owned();
    expand(mesh.rotation(), &mut candidates, 1, scratch);
    candidates.sort_unstable();
    history.settle(settled, candidates);
    Ok(Step { mobile: Some(counts), ..step })
}

/// Counts the faces that may be split by their mobile corners; answers with those that have none, too.
fn sort_faces(
    mesh: &Mesh,
    history: &History,
    mobile: &[VertexId],
    scratch: &mut Scratch,
) -> (MobileStep, Vec<Triangle>) {
    let before = history.mobility();
    let settled_before = before.map_or(0, |mobility| mobility.settled.len());
    let marks = scratch.marked(mesh.vertex_count(), mobile);
    let mut by_corners = [0; 4];
    let mut settled = Vec::new();
    let mut sort = |triangle: Triangle| {
        let corners = triangle.corners().into_iter().filter(|&v| marks.is_set(v)).count();
        by_corners[corners] += 1;
        settled.extend((corners == 0).then_some(triangle));
    };
    match before {
        Some(mobility) => mobility.open_faces(mesh.rotation()).for_each(&mut sort),
        None => mesh.triangles().for_each(&mut sort),
    }
    let [_, split @ ..] = by_corners;
    let counts = MobileStep {
        mobile_vertices: mobile.len(),
        static_vertices: mesh.vertex_count() - mobile.len(),
        faces_by_mobile_corners: by_corners,
        faces: settled_before + settled.len() + 4 * split.iter().sum::<usize>(),
    };
    (counts, settled)
}

/// The masks of the scheme where a vertex is mobile, and midpoints elsewhere.
struct Placing<'a> {
    scheme: &'a Loop,
    /// Ascending.
    mobile: &'a [VertexId],
}

impl Scheme for Placing<'_> {
    fn moves_even(&self) -> bool {
        self.scheme.moves_even()
    }

    fn reads_tags(&self) -> bool {
        self.scheme.reads_tags()
    }

    fn blends_sharpness(&self) -> bool {
        self.scheme.blends_sharpness()
    }

    /// For what is proven this is enough: the star of a vertex that is not mobile counts for nothing.
    fn reach(&self) -> Reach {
        self.scheme.reach()
    }

    fn even(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        self.scheme.even(around, v, mask);
    }

    fn odd(&self, around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
        if [parent.p, parent.q].iter().any(|end| self.mobile.binary_search(end).is_ok()) {
            self.scheme.odd(around, parent, mask);
        } else {
            Midpoint.odd(around, parent, mask);
        }
    }
}
