//! The exactness certificate: which vertices are proven equal to uniform refinement.
//!
//! Two facts are carried for every vertex, both true of the input mesh: *position*, it is where uniform refinement of the
//! same depth has it, and *rotation*, its neighbours have the same names in the same order. A vertex is **certified** if
//! both hold for it and *position* holds for its neighbours. One step hands the facts on by the rules of `before` and
//! `after`, which are sound for any sequence of regions. Source: `[incremental]`, the proof of exactness, made local.
//!
//! What is not certified may be equal all the same; [`Certificate::cause`] tells what the proof broke at.
//!
//! On a hierarchy nothing is carried: every vertex is where uniform refinement of some number of levels has it, and the
//! hierarchy tells of how many ([`Certificate::exact_level`]).
//!
//! **Deliberately not here**: comparing with a uniform mesh, which would have to be made.

use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::Reach;
use crate::select::Selection;
use crate::split::hierarchy::{Levels, Shown};
use crate::split::quadrisect::{Closing, Plan};
use crate::step::{Cause, Exactness, History, Proof, Refinement, Spoiler};

/// What is proven of the vertices of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Certificate<'a> {
    mesh: &'a Mesh,
    proof: Source<'a>,
}

/// Where it is known from.
#[derive(Clone, Copy, Debug)]
enum Source<'a> {
    /// Facts that steps handed on, so many of them.
    Facts(&'a Exactness, usize),
    /// Levels at which stars are complete, after so many steps.
    Levels(&'a Refinement, usize),
}

impl<'a> Certificate<'a> {
    /// The certificate of a mesh and its history; `None` if the history keeps none.
    #[must_use]
    pub fn new(mesh: &'a Mesh, history: &'a History) -> Option<Self> {
        let (exactness, steps) = (history.exactness()?, history.step_count());
        let proof = match history.refinement() {
            Some(refinement) => Source::Levels(refinement, steps),
            None => Source::Facts(exactness, steps),
        };
        Some(Self { mesh, proof })
    }

    /// The number of levels of uniform refinement that is proven to put the vertex where it is; `None` if nothing is. On a
    /// hierarchy every vertex has one. O(valence), there times the number of levels.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn exact_level(&self, v: VertexId) -> Option<usize> {
        match self.proof {
            Source::Facts(exactness, steps) => exactness.holds(Proof::Position, v).then_some(steps),
            Source::Levels(refinement, _) => Some(usize::from(self.shown(refinement, v).level(refinement.goes_back))),
        }
    }

    /// Whether position, rotation and the neighbours' positions are proven equal to uniform refinement of the same depth.
    /// O(valence).
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn is_certified(&self, v: VertexId) -> bool {
        match self.proof {
            Source::Facts(exactness, _) => is_certified(exactness, self.mesh, v),
            Source::Levels(refinement, steps) => {
                usize::from(self.shown(refinement, v).star_level) == steps
                    && self.mesh.ring(v).iter().all(|w| self.exact_level(w) == Some(steps))
            }
        }
    }

    fn shown(&self, refinement: &Refinement, v: VertexId) -> Shown {
        Shown::new(Levels::new(self.mesh.rotation(), &refinement.hierarchy), v).1
    }

    /// All certified vertices, by id. O(edges).
    pub fn certified(&self) -> impl Iterator<Item = VertexId> {
        self.mesh.vertices().filter(|&v| self.is_certified(v))
    }

    /// What keeps a vertex from being certified; `None` if it is. O(valence).
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn cause(&self, v: VertexId) -> Option<Cause> {
        if self.is_certified(v) {
            return None;
        }
        let spoiler = match self.proof {
            Source::Facts(exactness, _) => spoiler(exactness, self.mesh, v),
            Source::Levels(..) => None,
        };
        Some(spoiler.map_or(Cause::NotRefined, Cause::Spoiled))
    }

    /// The selected vertices for which one more step of a scheme with this reach is not proven exact, ascending: the
    /// premise of incremental subdivision is broken there. None on a hierarchy, where nothing has to be premised.
    /// O(n log n) in the size n of the selection and its neighbours.
    #[must_use]
    pub fn unproven(&self, selection: &Selection, reach: Reach) -> Vec<VertexId> {
        let selected = selection.vertices();
        match self.proof {
            Source::Facts(exactness, _) if !exactness.is_whole() => {}
            _ => return Vec::new(),
        }
        if reach != Reach::BothStars {
            return selected.iter().copied().filter(|&v| !self.is_certified(v)).collect();
        }
        // Each neighbour is judged once, however many selected vertices it has.
        let mut near: Vec<VertexId> = selected.iter().flat_map(|&v| self.mesh.ring(v).iter().chain([v])).collect();
        near.sort_unstable();
        near.dedup();
        near.retain(|&v| !self.is_certified(v));
        if near.is_empty() {
            return Vec::new();
        }
        let spoiled = |v: VertexId| near.binary_search(&v).is_ok();
        selected.iter().copied().filter(|&v| spoiled(v) || self.mesh.ring(v).iter().any(spoiled)).collect()
    }
}

/// Position and rotation of a vertex and the positions of its neighbours.
pub(crate) fn is_certified(exactness: &Exactness, mesh: &Mesh, v: VertexId) -> bool {
    exactness.holds(Proof::Position, v)
        && exactness.holds(Proof::Rotation, v)
        && mesh.ring(v).iter().all(|w| exactness.holds(Proof::Position, w))
}

/// What spoiled the star of a vertex: itself, or the first neighbour whose position is not proven.
fn spoiler(exactness: &Exactness, mesh: &Mesh, v: VertexId) -> Option<Spoiler> {
    let around = || mesh.ring(v).iter().filter(|&w| !exactness.holds(Proof::Position, w));
    exactness.spoiler(v).or_else(|| around().find_map(|w| exactness.spoiler(w)))
}

/// What will hold of a vertex after the step, as far as the mesh before it tells.
#[derive(Clone, Copy, Debug)]
struct Facts {
    position: bool,
    rotation: bool,
    spoiler: Option<Spoiler>,
}

/// The facts that a step hands on, read before it is made.
#[derive(Debug, Default)]
pub(crate) struct Handed {
    moves_even: bool,
    even: Vec<Facts>,
    odd: Vec<Facts>,
}

/// Reads what the vertices of the region (`moving`, ascending) and the new ones inherit.
///
/// Position of an even vertex: its star, if the scheme moves it, else its own position. Position of an odd vertex: as
/// the [`Reach`] of the scheme says. Rotation: its own, or that of one end, if [`after`] finds all refined around it.
///
/// The tags at a vertex are those of the uniform mesh where its rotation is proven: an edge with the name that it has there
/// was split as often, and under Chaikin's rule so were all edges at its old end. But of an odd vertex between semi-sharp
/// halves both ends must be proven then, as the halves depend on other edges at either.
pub(crate) fn before(
    handed: &mut Handed,
    exactness: &mut Exactness,
    mesh: &Mesh,
    moving: &[VertexId],
    plan: &Plan,
    reach: Reach,
    moves_even: bool,
) {
    exactness.record(mesh.vertex_count());
    let Handed { even, odd, .. } = handed;
    even.clear();
    for &v in moving {
        let star = is_certified(exactness, mesh, v);
        if star {
            exactness.show(Proof::Star, v);
        }
        even.push(Facts {
            position: if moves_even { star } else { exactness.holds(Proof::Position, v) },
            rotation: exactness.holds(Proof::Rotation, v),
            spoiler: if star { None } else { spoiler(exactness, mesh, v) },
        });
    }
    for (&v, facts) in moving.iter().zip(&*even) {
        exactness.spoil(v, facts.spoiler);
    }
    odd.clear();
    let around = mesh.neighborhood();
    odd.extend(plan.edges.iter().map(|edge| {
        let [p, q] = edge.ends();
        let both = |proof| exactness.holds(proof, p) && exactness.holds(proof, q);
        let one = |proof| exactness.holds(proof, p) || exactness.holds(proof, q);
        let position = match reach {
            Reach::Ends => both(Proof::Position) && one(Proof::Rotation),
            Reach::OneStar => one(Proof::Star),
            Reach::BothStars => both(Proof::Star),
        };
        let rotation = if around.averages_sharpness(p, q) { both(Proof::Rotation) } else { one(Proof::Rotation) };
        let spoiler = if both(Proof::Star) { None } else { exactness.spoiler(p).or(exactness.spoiler(q)) };
        Facts { position, rotation, spoiler }
    }));
    handed.moves_even = moves_even;
}

/// Goes on to the mesh after the step, with what was inherited and what the step did around each vertex.
pub(crate) fn after(
    exactness: &mut Exactness,
    handed: &Handed,
    mesh: &Mesh,
    moving: &[VertexId],
    plan: &Plan,
    closing: &Closing,
) {
    exactness.advance(mesh.vertex_count(), handed.moves_even);
    let is_new = |v: VertexId| v.index() >= plan.first;
    let mut settle = |v: VertexId, facts: Facts, refined: bool| {
        if facts.position {
            exactness.show(Proof::Position, v);
        }
        if facts.rotation && refined {
            exactness.show(Proof::Rotation, v);
        }
        exactness.spoil(v, facts.spoiler);
    };
    for (&v, &facts) in moving.iter().zip(&handed.even) {
        // A neighbour that is not new is one that the step left out; the T-vertex beside it is what reached `v`.
        let refined = mesh.ring(v).iter().all(is_new);
        let mixed = |(a, b): (VertexId, VertexId)| (is_new(a) != is_new(b)).then_some(if is_new(a) { a } else { b });
        let found = if refined { None } else { mesh.ring(v).pairs().find_map(mixed).map(Spoiler::TVertex) };
        settle(v, Facts { spoiler: facts.spoiler.or(found), ..facts }, refined);
    }
    let mut t_vertices = closing.t_vertices.iter().peekable();
    for ((x, _), &facts) in plan.odd().zip(&handed.odd) {
        let is_t = t_vertices.next_if_eq(&&x).is_some();
        let spoiler = if is_t { Some(Spoiler::TVertex(x)) } else { facts.spoiler };
        settle(x, Facts { spoiler, ..facts }, !is_t);
    }
    for &o in &closing.o_vertices {
        exactness.spoil(o, Some(Spoiler::OVertex(o)));
    }
}
