//! What is remembered from step to step.

use std::collections::HashMap;
use std::ops::Range;

use super::{Birth, Bisections, Exactness, Hierarchy, Lineage, Mobility, Motions, Refinement, SplitKind};
use crate::error::RefineError;
use crate::id::{Edge, Triangle, VertexId};
use crate::mesh::Mesh;
use crate::soup::FaceList;

/// What a [`History`] keeps beyond the bare minimum.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Keep {
    /// Birth levels and lineages of vertices, and the edges that close cracks: 9 bytes a new vertex, 17 of a trisection.
    pub names: bool,
    /// What is proven equal to uniform refinement, and what spoils the rest: 20 bytes a vertex from the first step on that does
    /// not refine the whole mesh. Only of the split in four; a step of another kind drops it.
    pub certificate: bool,
}

/// What a run of refinements remembers beside the mesh; held by the caller, who makes one for a mesh and hands both to
/// every step. Two calls of one step are then the same as one call of two.
///
/// Without anything kept it is a few bytes a step, and one a new vertex if the split is not in four: a trisection or a
/// bisection cannot do without birth levels. Adaptive √3 by the method *simple* keeps 88 bytes a vertex: where it was born
/// and how it moves from there.
#[derive(Clone, Debug)]
pub struct History {
    /// How many vertices there were before each step; the first entry counts the input vertices.
    starts: Vec<usize>,
    max_valence: usize,
    /// Whether every step refined the whole mesh; of splits in four nobody asks.
    whole: bool,
    /// What all steps were, from the first on.
    kind: Option<SplitKind>,
    /// For every vertex that is no input vertex, in order; `None` if neither names nor the kind of split ask for it.
    levels: Option<Vec<u8>>,
    names: Option<Names>,
    exactness: Option<Exactness>,
    /// Of every vertex, if the steps are those that need it.
    motions: Option<Motions>,
    /// From the first bisection on.
    bisections: Option<Box<Bisections>>,
    /// From the first step of static/mobile subdivision on.
    mobility: Option<Box<Mobility>>,
    /// From the first step of red-green refinement on: after which step it was, and the red triangles over the mesh before the
    /// first of its kind.
    red_green: Option<(usize, Box<Hierarchy>)>,
    /// From the first step on, if the method is one that works on a hierarchy.
    refinement: Option<Box<Refinement>>,
}

#[derive(Clone, Debug, Default)]
struct Names {
    lineages: Lineages,
    /// Edges drawn to close cracks. One that was split since is no edge any more and never becomes one again.
    closing: Vec<Edge>,
}

/// For every vertex that is no input vertex, in order; of vertices that lie on edges only their ends.
#[derive(Clone, Debug)]
enum Lineages {
    Edges(Vec<[VertexId; 2]>),
    Any(Vec<Lineage>),
}

impl Default for Lineages {
    fn default() -> Self {
        Self::Edges(Vec::new())
    }
}

impl Lineages {
    fn get(&self, k: usize) -> Lineage {
        match self {
            Self::Edges(ends) => Lineage::Edge(ends[k]),
            Self::Any(lineages) => lineages[k],
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Edges(ends) => ends.len(),
            Self::Any(lineages) => lineages.len(),
        }
    }

    fn push(&mut self, lineage: Lineage) {
        match (&mut *self, lineage) {
            (Self::Edges(list), Lineage::Edge(ends)) => list.push(ends),
            (Self::Any(list), lineage) => list.push(lineage),
            (Self::Edges(list), lineage) => {
                let edges = list.iter().map(|&ends| Lineage::Edge(ends));
                *self = Self::Any(edges.chain([lineage]).collect());
            }
        }
    }

    fn memory_bytes(&self) -> usize {
        match self {
            Self::Edges(list) => list.capacity() * size_of::<[VertexId; 2]>(),
            Self::Any(list) => list.capacity() * size_of::<Lineage>(),
        }
    }
}

impl History {
    /// The history of a mesh that was not refined yet. O(vertices).
    #[must_use]
    pub fn new(mesh: &Mesh, keep: Keep) -> Self {
        Self {
            starts: vec![mesh.vertex_count()],
            max_valence: mesh.vertices().map(|v| mesh.ring(v).valence()).max().unwrap_or(0),
            whole: true,
            kind: None,
            levels: keep.names.then(Vec::new),
            names: keep.names.then(Names::default),
            exactness: keep.certificate.then(Exactness::new),
            motions: None,
            bisections: None,
            mobility: None,
            red_green: None,
            refinement: None,
        }
    }

    /// The history of a mesh that lies over this one and is split where it is. `below` has the vertex below each of its
    /// vertices, ascending. Names, certificates and bisections are not kept.
    pub(crate) fn lifted(&self, below: &[VertexId]) -> Self {
        let starts: Vec<usize> =
            self.starts.iter().map(|&start| below.partition_point(|v| v.index() < start)).collect();
        let made = below[starts[0]..].iter();
        Self {
            max_valence: self.max_valence,
            whole: self.whole,
            kind: self.kind,
            levels: self.levels.as_ref().map(|_| made.map(|&v| self.level(v).unwrap_or(0)).collect()),
            starts,
            names: None,
            exactness: None,
            motions: self.motions.as_ref().map(|motions| motions.lifted(below)),
            bisections: None,
            mobility: None,
            red_green: None,
            refinement: None,
        }
    }

    /// How many steps were made.
    #[must_use]
    pub fn step_count(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many vertices the mesh had before the first step.
    #[must_use]
    pub fn input_count(&self) -> usize {
        self.starts[0]
    }

    /// How all steps cut triangles; `None` before the first.
    #[must_use]
    pub fn split_kind(&self) -> Option<SplitKind> {
        self.kind
    }

    /// Whether a step of this kind may follow, by a method that works on the mesh as it is.
    pub(crate) fn allow(&self, asked: SplitKind) -> Result<(), RefineError> {
        match self.kind {
            _ if self.refinement.is_some() => Err(RefineError::OtherHistory),
            Some(made) if made != asked => Err(RefineError::OtherSplit { made: made.name(), asked: asked.name() }),
            _ => Ok(()),
        }
    }

    /// The hierarchy of a run, which begins when it is asked for first; it is to be put back.
    pub(crate) fn take_refinement(
        &mut self,
        mesh: &Mesh,
        scheme: &'static str,
        goes_back: bool,
    ) -> Result<Box<Refinement>, RefineError> {
        match &self.refinement {
            Some(begun) if begun.goes_back != goes_back => return Err(RefineError::OtherHistory),
            Some(begun) if begun.scheme != scheme => {
                return Err(RefineError::OtherScheme { made: begun.scheme, asked: scheme });
            }
            None if self.step_count() > 0 => return Err(RefineError::OtherHistory),
            _ => {}
        }
        Ok(self.refinement.take().unwrap_or_else(|| Box::new(Refinement::new(mesh, scheme, goes_back))))
    }

    /// Puts the hierarchy back.
    pub(crate) fn keep_refinement(&mut self, refinement: Box<Refinement>) {
        self.refinement = Some(refinement);
    }

    /// The stars that [`Dynamic`](crate::subdivide::Dynamic) was asked for, or steps of the method *dynamic*, by vertex and
    /// level; none for other methods.
    pub fn asked_stars(&self) -> impl Iterator<Item = (VertexId, u8)> {
        self.refinement.iter().flat_map(|refinement| refinement.asked.iter().copied())
    }

    /// The hierarchy, if the methods of the run work on one.
    pub(crate) fn refinement(&self) -> Option<&Refinement> {
        self.refinement.as_deref()
    }

    /// The hierarchy, if the last step was one on such.
    pub(crate) fn hierarchy(&self) -> Option<&Hierarchy> {
        let red_green = self.red_green.as_ref().filter(|(step, _)| *step == self.step_count());
        let refinement = self.refinement.as_ref().map(|refinement| &refinement.hierarchy);
        refinement.or_else(|| red_green.map(|(_, hierarchy)| &**hierarchy))
    }

    /// The greatest valence of the mesh, after any of its steps under √3 and on a hierarchy, where valences fall again. O(1).
    #[must_use]
    pub fn max_valence(&self) -> usize {
        self.max_valence
    }

    /// The vertices made in the same step as this one; for an input vertex all input vertices. O(log steps).
    pub(crate) fn peers(&self, v: VertexId) -> Range<usize> {
        let step = self.starts.partition_point(|&start| start <= v.index());
        let first = if step == 0 { 0 } else { self.starts[step - 1] };
        first..self.starts.get(step).copied().unwrap_or(usize::MAX)
    }

    /// Whether names are kept. A hierarchy always keeps them.
    #[must_use]
    pub fn has_names(&self) -> bool {
        self.names.is_some() || self.refinement.is_some()
    }

    /// The first vertex of the last step, of the input before any.
    pub(crate) fn youngest(&self) -> usize {
        self.starts.len().checked_sub(2).map_or(0, |step| self.starts[step])
    }

    /// Whether every step refined the whole mesh, so that vertices of one level were made in one step.
    pub(crate) fn is_of_whole_steps(&self) -> bool {
        self.whole
    }

    /// Notes that a step did not refine the whole mesh.
    pub(crate) fn note_part(&mut self) {
        self.whole = false;
    }

    /// Whether something is kept of single vertices that a step of the whole mesh would have to add to.
    pub(crate) fn tells_vertices_apart(&self) -> bool {
        self.names.is_some() || self.exactness.as_ref().is_some_and(|exactness| !exactness.is_whole())
    }

    /// The level at which a vertex was made: 0 for an input vertex, else one more than the greatest level of what it was made
    /// of. `None` if levels are not kept: that is, if neither names are nor a step was made that needs them.
    #[must_use]
    pub fn level(&self, v: VertexId) -> Option<u8> {
        if let Some(refinement) = &self.refinement {
            return Some(refinement.hierarchy.level(v));
        }
        let levels = self.levels.as_ref()?;
        Some(match v.index().checked_sub(self.starts[0]) {
            None => 0,
            Some(k) => levels[k],
        })
    }

    /// What a vertex was made of. `None` for an input vertex, and if names are not kept.
    #[must_use]
    pub fn parents(&self, v: VertexId) -> Option<Lineage> {
        if let Some(refinement) = &self.refinement {
            return refinement.hierarchy.birth(v).map(Birth::lineage);
        }
        let k = v.index().checked_sub(self.starts[0])?;
        self.names.as_ref().map(|names| names.lineages.get(k))
    }

    /// The level of a triangle, and whether it closes a crack; `None` if levels are not kept.
    ///
    /// A regular triangle has the greatest level of its corners. One that closes a crack keeps the level of the triangle
    /// it is a part of. `closing` is [`History::closing_edges`].
    #[must_use]
    pub fn face_level(&self, triangle: Triangle, closing: &[Edge]) -> Option<(u8, bool)> {
        let [a, b, c] = triangle.corners();
        let finest = self.level(a)?.max(self.level(b)?).max(self.level(c)?);
        let closes = [(a, b), (b, c), (c, a)].iter().any(|&(p, q)| closing.binary_search(&Edge::new(p, q)).is_ok());
        Some((finest - u8::from(closes && finest > 0), closes))
    }

    /// How many half steps of √3 made a triangle; `None` if levels are not kept.
    ///
    /// With L the greatest level of its corners it is 2L if two of them have it, or L = 0; else 2L − 1: the triangle is *odd*,
    /// and becomes even with the next one across the edge opposite to its youngest corner, if that is not on a boundary.
    #[must_use]
    pub fn generation(&self, triangle: Triangle) -> Option<u32> {
        let [a, b, c] = triangle.corners();
        let levels = [self.level(a)?, self.level(b)?, self.level(c)?];
        let greatest = levels[0].max(levels[1]).max(levels[2]);
        let youngest = levels.iter().filter(|&&level| level == greatest).count();
        Some(2 * u32::from(greatest) - u32::from(greatest > 0 && youngest == 1))
    }

    /// The edges of the mesh that were drawn to close cracks, ascending; `None` if names are not kept. O(n log n) in the
    /// number of those ever drawn, on a hierarchy O(edges).
    #[must_use]
    pub fn closing_edges(&self, mesh: &Mesh) -> Option<Vec<Edge>> {
        if let Some(refinement) = &self.refinement {
            let mut closing: Vec<Edge> =
                mesh.edges().filter(|edge| refinement.hierarchy.is_closing(edge.ends())).collect();
            closing.sort_unstable();
            return Some(closing);
        }
        let names = self.names.as_ref()?;
        let still = |edge: &Edge| {
            let [a, b] = edge.ends();
            mesh.rotation().has_edge(a, b)
        };
        let mut closing: Vec<Edge> = names.closing.iter().copied().filter(still).collect();
        closing.sort_unstable();
        Some(closing)
    }

    /// For every vertex of this run the vertex of another run from the same input that has the same name: the same input
    /// vertex, or made in the same way of vertices of the same names. `None` if names are not kept in both.
    ///
    /// Ids differ between runs that refine different regions; names do not. O(vertices of both).
    #[must_use]
    pub fn same_names(&self, other: &Self) -> Option<Vec<Option<VertexId>>> {
        let (lineages, others) = (self.lineages()?, other.lineages()?);
        let made: HashMap<Lineage, VertexId> =
            others.into_iter().map(|(x, lineage)| (lineage.unordered(), x)).collect();
        let inputs = self.starts[0].min(other.starts[0]);
        let last = lineages.iter().map(|(x, _)| x.index() + 1).max().unwrap_or(0);
        let mut same = vec![None; last.max(self.starts[0])];
        for (k, input) in same.iter_mut().enumerate().take(inputs) {
            *input = Some(VertexId::new(k));
        }
        for (x, lineage) in lineages {
            let lineage = lineage.renamed(|v| same[v.index()]);
            same[x.index()] = lineage.and_then(|lineage| made.get(&lineage.unordered()).copied());
        }
        Some(same)
    }

    /// All vertices that are no input vertices with what they were made of, which comes before; `None` if names are not kept.
    fn lineages(&self) -> Option<Vec<(VertexId, Lineage)>> {
        if let Some(refinement) = &self.refinement {
            let mut births: Vec<(VertexId, &Birth)> = refinement.hierarchy.births().collect();
            births.sort_by_key(|(_, birth)| birth.level);
            return Some(births.into_iter().map(|(x, birth)| (x, birth.lineage())).collect());
        }
        let lineages = &self.names.as_ref()?.lineages;
        Some((0..lineages.len()).map(|k| (VertexId::new(self.starts[0] + k), lineages.get(k))).collect())
    }

    pub(crate) fn exactness(&self) -> Option<&Exactness> {
        self.exactness.as_ref()
    }

    pub(crate) fn exactness_mut(&mut self) -> Option<&mut Exactness> {
        self.exactness.as_mut()
    }

    /// Whether it is known how all vertices move from level to level.
    pub(crate) fn has_motions(&self) -> bool {
        self.motions.is_some()
    }

    /// How all vertices move from level to level, if it is known; a step gives it back.
    pub(crate) fn take_motions(&mut self) -> Option<Motions> {
        self.motions.take()
    }

    pub(crate) fn keep_motions(&mut self, motions: Motions) {
        self.motions = Some(motions);
    }

    /// How many input triangles found no partner for bisection, so that they were or will be split at their centre; `None`
    /// before the first bisection.
    #[must_use]
    pub fn unmatched_faces(&self) -> Option<usize> {
        self.bisections.as_ref().map(|bisections| bisections.blocks.unmatched())
    }

    pub(crate) fn bisections(&self) -> Option<&Bisections> {
        self.bisections.as_deref()
    }

    pub(crate) fn bisections_mut(&mut self) -> &mut Bisections {
        self.bisections.get_or_insert_default()
    }

    /// The faces that static/mobile subdivision made, before cracks were closed: those that stay for ever in the order in
    /// which they were found to, then those that the last step made. A vertex may lie on the inside of an edge of the former.
    /// `None` unless that made the last step. O(vertices + faces).
    #[must_use]
    pub fn unclosed(&self, mesh: &Mesh) -> Option<FaceList> {
        let corners = |triangle: Triangle| triangle.corners().map(|v| v.index() as u32);
        let faces = self.mobility()?.faces(mesh.rotation()).map(corners).collect();
        Some(FaceList::of_triangles(mesh.positions().to_vec(), faces))
    }

    /// What static/mobile subdivision left behind, if it made the last step.
    pub(crate) fn mobility(&self) -> Option<&Mobility> {
        self.mobility.as_deref().filter(|mobility| mobility.step == self.step_count())
    }

    /// After a step of static/mobile subdivision: the faces that it did not split any more, and who may still move.
    pub(crate) fn settle(&mut self, settled: Vec<Triangle>, candidates: Vec<VertexId>) {
        let step = self.step_count();
        // What other steps went before is out of date.
        let mut mobility = self.mobility.take().filter(|mobility| mobility.step + 1 == step).unwrap_or_default();
        mobility.settled.extend(settled);
        mobility.step = step;
        mobility.candidates = candidates;
        self.mobility = Some(mobility);
    }

    /// The red triangles of red-green refinement, to be given back; none over a mesh with so many vertices unless that made
    /// the last step.
    pub(crate) fn take_hierarchy(&mut self, vertex_count: usize) -> Box<Hierarchy> {
        let last = self.step_count();
        let kept = self.red_green.take().filter(|(step, _)| *step == last);
        kept.map_or_else(|| Box::new(Hierarchy::new(vertex_count)), |(_, hierarchy)| hierarchy)
    }

    /// Gives the red triangles back, as they are after the last step.
    pub(crate) fn keep_hierarchy(&mut self, hierarchy: Box<Hierarchy>) {
        self.red_green = Some((self.step_count(), hierarchy));
    }

    /// The level of the vertex that splits this edge.
    pub(crate) fn child_level(&self, [p, q]: [VertexId; 2]) -> Result<u8, RefineError> {
        let level = |v| self.level(v).unwrap_or(0);
        level(p).max(level(q)).checked_add(1).ok_or(RefineError::TooDeep)
    }

    /// Closes a step: its kind, what it made, the edges it drew to close cracks, and the greatest valence it touched.
    ///
    /// The levels and lineages of a split in four come only if names are kept.
    pub(crate) fn record(
        &mut self,
        kind: SplitKind,
        vertex_count: usize,
        made: impl Iterator<Item = (u8, Lineage)>,
        closing: &[Edge],
        max_valence: usize,
    ) {
        self.kind = Some(kind);
        self.starts.push(vertex_count);
        self.max_valence = self.max_valence.max(max_valence);
        if kind != SplitKind::Quadrisect {
            self.exactness = None;
            self.levels.get_or_insert_default();
        }
        for (level, lineage) in made {
            self.levels.get_or_insert_default().push(level);
            if let Some(names) = &mut self.names {
                names.lineages.push(lineage);
            }
        }
        if let Some(names) = &mut self.names {
            names.closing.extend_from_slice(closing);
        }
    }

    /// Closes a step of the whole mesh that has no names to keep. All that it made is of one level, which a mesh with a
    /// triangle does not let grow beyond a few dozen.
    pub(crate) fn record_whole(&mut self, kind: SplitKind, vertex_count: usize, max_valence: usize) {
        let level = u8::try_from(self.starts.len()).unwrap_or(u8::MAX);
        self.record(kind, vertex_count, std::iter::empty(), &[], max_valence);
        if let Some(levels) = &mut self.levels {
            levels.resize(vertex_count - self.starts[0], level);
        }
    }

    /// Bytes held.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let names = self
            .names
            .as_ref()
            .map_or(0, |names| names.lineages.memory_bytes() + names.closing.capacity() * size_of::<Edge>());
        names
            + self.levels.as_ref().map_or(0, Vec::capacity)
            + self.exactness.as_ref().map_or(0, Exactness::memory_bytes)
            + self.motions.as_ref().map_or(0, Motions::memory_bytes)
            + self.bisections.as_ref().map_or(0, |bisections| bisections.memory_bytes())
            + self.mobility.as_ref().map_or(0, |mobility| mobility.memory_bytes())
            + self.red_green.as_ref().map_or(0, |(_, hierarchy)| hierarchy.memory_bytes())
            + self.refinement.as_ref().map_or(0, |refinement| refinement.memory_bytes())
    }
}
