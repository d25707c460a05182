//! Runs of refinements, and a run beside uniform refinement of the same mesh.

use std::collections::BTreeMap;

use vvmesh::glam::DVec3;
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, LoopWeights, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{Blocks, History, Keep, Lineage};
use vvmesh::subdivide::{Control, Step, Subdivider};
use vvmesh::{Edge, Mesh, VertexId};

/// Every scheme that splits a triangle in four, with its name.
pub fn schemes() -> [(&'static str, AnyScheme); 5] {
    [
        ("loop", Loop::default().into()),
        ("loop with warren's weights", Loop::new(LoopWeights::Warren).into()),
        ("butterfly", Butterfly.into()),
        ("modified butterfly", ModifiedButterfly.into()),
        ("midpoint", Midpoint.into()),
    ]
}

/// Every scheme that splits otherwise, with its name.
pub fn other_schemes() -> [(&'static str, AnyScheme); 3] {
    [
        ("√3", Sqrt3::default().into()),
        ("4-8", FourEight::default().into()),
        ("4-8 from the longest edges", FourEight::new(Blocks::LongestEdge).into()),
    ]
}

/// A mesh that is refined step by step.
#[derive(Clone)]
pub struct Run {
    pub mesh: Mesh,
    pub history: History,
}

impl Run {
    pub fn new(mesh: &Mesh) -> Self {
        let history = History::new(mesh, Keep { names: true, certificate: true });
        Self { mesh: mesh.clone(), history }
    }

    pub fn step(&mut self, subdivider: &Subdivider, selection: &Selection) -> Step {
        let Self { mesh, history } = self;
        subdivider
            .step(mesh, history, selection, &mut Scratch::new(), &mut Control::default())
            .expect("nothing limits the step")
    }

    /// All that can be seen of the mesh, in bits.
    pub fn bits(&self) -> MeshBits {
        MeshBits::of(&self.mesh)
    }
}

#[derive(PartialEq, Debug)]
pub struct MeshBits {
    rings: Vec<(Vec<VertexId>, bool)>,
    positions: Vec<[u64; 3]>,
    sharp: Vec<(Edge, u64)>,
    sharp_vertices: Vec<(VertexId, u64)>,
}

impl MeshBits {
    pub fn of(mesh: &Mesh) -> Self {
        let tags = mesh.tags();
        let edge = |edge| (edge, tags.sharpness(edge).value().to_bits());
        let vertex = |v| (v, tags.vertex_sharpness(v).value().to_bits());
        Self {
            rings: mesh.vertices().map(|v| ring(mesh, v)).collect(),
            positions: mesh.positions().iter().map(|&p| bits(p)).collect(),
            sharp: tags.sharp_edges().into_iter().map(edge).collect(),
            sharp_vertices: tags.sharp_vertices().into_iter().map(vertex).collect(),
        }
    }
}

pub fn bits(position: DVec3) -> [u64; 3] {
    position.to_array().map(f64::to_bits)
}

/// A ring from its start, and whether it is open.
pub fn ring(mesh: &Mesh, v: VertexId) -> (Vec<VertexId>, bool) {
    (mesh.ring(v).neighbors().to_vec(), mesh.ring(v).is_open())
}

/// For every vertex of one run the one of another with the same name, given the same for the input.
pub fn renamed(run: &Run, other: &Run, input: &[VertexId]) -> Vec<VertexId> {
    let ends = |run: &Run, v| match run.history.parents(v)? {
        Lineage::Edge(ends) => Some(ends),
        other => panic!("{other} is no edge"),
    };
    let made = |run: &Run, v| ends(run, v).map(|[p, q]| Edge::new(p, q));
    let by_parents: BTreeMap<Edge, VertexId> =
        other.mesh.vertices().filter_map(|v| made(other, v).map(|edge| (edge, v))).collect();
    let mut same = input.to_vec();
    for v in run.mesh.vertices().skip(input.len()) {
        let [p, q] = ends(run, v).expect("it is no input vertex");
        same.push(by_parents[&Edge::new(same[p.index()], same[q.index()])]);
    }
    same
}

/// A run with, for each of its vertices, the one of the same name in a uniform run of the same number of steps.
pub struct Beside<'a> {
    run: &'a Run,
    uniform: &'a Run,
    same: Vec<Option<VertexId>>,
}

impl<'a> Beside<'a> {
    pub fn new(run: &'a Run, uniform: &'a Run) -> Self {
        assert_eq!(run.history.step_count(), uniform.history.step_count());
        let same = run.history.same_names(&uniform.history).expect("both keep names");
        Self { run, uniform, same }
    }

    /// The vertex of the same name.
    pub fn twin(&self, v: VertexId) -> Option<VertexId> {
        self.same[v.index()]
    }

    pub fn position_is_same(&self, v: VertexId) -> bool {
        let twin = |w| bits(self.run.mesh.position(v)) == bits(self.uniform.mesh.position(w));
        self.twin(v).is_some_and(twin)
    }

    /// Whether the neighbours have the same names in the same order from the same start, with the same gap.
    pub fn rotation_is_same(&self, v: VertexId) -> bool {
        let Some(w) = self.twin(v) else { return false };
        let (here, there) = (self.run.mesh.ring(v), self.uniform.mesh.ring(w));
        here.is_open() == there.is_open() && here.iter().map(|x| self.twin(x)).eq(there.iter().map(Some))
    }

    /// Whether the vertex, and the edges at it by the names of its neighbours, are as sharp.
    pub fn sharpness_is_same(&self, v: VertexId) -> bool {
        let Some(w) = self.twin(v) else { return false };
        let at = |mesh: &Mesh, v| {
            let edges = mesh.ring(v).iter().map(|x| mesh.neighborhood().sharpness(v, x));
            edges.chain([mesh.tags().vertex_sharpness(v)]).collect::<Vec<_>>()
        };
        at(&self.run.mesh, v) == at(&self.uniform.mesh, w)
    }

    /// Position, rotation, and positions of the neighbours.
    pub fn star_is_same(&self, v: VertexId) -> bool {
        self.position_is_same(v)
            && self.rotation_is_same(v)
            && self.run.mesh.ring(v).iter().all(|w| self.position_is_same(w))
    }
}
