//! How many instructions does each stage take?
//!
//! Callgrind counts them: the same program on the same input takes as many on a busy machine as on an idle one, which no
//! clock does. It is slow, so the meshes are small. Only the bodies of the functions below are counted; what they are
//! given is made before, and what they answer with is dropped after. That is why they hand back their input as well.

use gungraun::Callgrind;
use gungraun::prelude::*;
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::check::{self, Report};
use vvmesh::error::{ReadError, RingDefect};
use vvmesh::io::{self, Loaded};
use vvmesh::scheme::{AnyScheme, Butterfly, Loop, ModifiedButterfly};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion as _, Disk, Selection};
use vvmesh::soup::FaceList;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Step, Subdivider};
use vvmesh::{Mesh, VertexId, query, shapes};

/// What a step needs, with room for the marks of a mesh that grows.
struct Workshop {
    subdivider: Subdivider,
    mesh: Mesh,
    history: History,
    scratch: Scratch,
}

impl Workshop {
    fn new(subdivider: Subdivider, mesh: Mesh) -> Self {
        let history = History::new(&mesh, Keep::default());
        let scratch = scratch_for(2 * mesh.vertex_count());
        Self { subdivider, mesh, history, scratch }
    }

    fn step(&mut self, selection: &Selection) -> Step {
        self.subdivider
            .step(&mut self.mesh, &mut self.history, selection, &mut self.scratch, &mut Control::default())
            .expect("a torus can be refined")
    }

    /// A step on the disk of radius 3, which refines a region of radius 4: 96 triangles where the mesh is regular.
    fn step_on_disk(&mut self, center: usize) -> Step {
        let disk = Disk::new(VertexId::new(center), 3);
        let selection = disk.select(&self.mesh, &mut self.scratch).expect("the vertex is one of the mesh");
        self.step(&selection)
    }
}

/// With room for the marks of a mesh.
fn scratch_for(vertex_count: usize) -> Scratch {
    let mut scratch = Scratch::new();
    let _ = scratch.marks(vertex_count, 1);
    scratch
}

/// 10,000 vertices and 20,000 triangles.
fn torus() -> Mesh {
    shapes::torus(100, 100, 2.0, 1.0)
}

fn whole(scheme: AnyScheme) -> Workshop {
    Workshop::new(Subdivider::new(scheme, Uniform), torus())
}

// From 20,000 triangles to 80,000.
#[library_benchmark(setup = whole)]
#[bench::loop_scheme(Loop::default().into())]
#[bench::butterfly(Butterfly.into())]
#[bench::modified_butterfly(ModifiedButterfly.into())]
fn uniform(mut workshop: Workshop) -> (Workshop, Step) {
    let step = workshop.step(&Selection::empty());
    (workshop, step)
}

fn ten_thousand(center: usize) -> (Workshop, usize) {
    let incremental = Incremental::new(1).expect("one ring is allowed");
    let mesh = shapes::torus(100, 50, 2.0, 1.0);
    let mut workshop = Workshop::new(Subdivider::new(Loop::default(), incremental), mesh);
    // The first growth of the mesh moves all of it; the next ones have room.
    assert_eq!(workshop.step_on_disk(0).region, 61, "a disk of radius 4, in which 96 triangles lie");
    (workshop, center)
}

// Selecting a disk, and a Loop step on it.
#[library_benchmark(setup = ten_thousand)]
#[bench::disk_of_96(2525)]
fn incremental((mut workshop, center): (Workshop, usize)) -> (Workshop, Step) {
    let step = workshop.step_on_disk(center);
    (workshop, step)
}

// A mesh from its faces.
#[library_benchmark]
#[bench::torus(torus().to_face_list())]
fn build(list: FaceList) -> (FaceList, Mesh) {
    let mesh = Mesh::from_face_list(&list).expect("a torus is a mesh");
    (list, mesh)
}

fn off() -> Vec<u8> {
    let mut text = Vec::new();
    io::write_off(&mut text, &torus()).expect("memory takes all");
    text
}

fn obj() -> Vec<u8> {
    let mut text = Vec::new();
    io::write_obj(&mut text, &torus()).expect("memory takes all");
    text
}

type Reader = fn(&[u8]) -> Result<Loaded, ReadError>;

#[library_benchmark]
#[bench::off(off(), io::read_off)]
#[bench::obj(obj(), io::read_obj)]
fn read(text: Vec<u8>, reader: Reader) -> (Vec<u8>, Loaded) {
    let loaded = reader(&text).expect("what was written can be read");
    (text, loaded)
}

// Into memory that grows.
#[library_benchmark]
#[bench::off(torus())]
fn write(mesh: Mesh) -> (Mesh, Vec<u8>) {
    let mut text = Vec::new();
    io::write_off(&mut text, &mesh).expect("memory takes all");
    (mesh, text)
}

// Of a mesh with a boundary, along which T-junctions are looked for.
#[library_benchmark]
#[bench::grid(shapes::grid(100, 100).to_face_list())]
fn conformity(list: FaceList) -> (FaceList, Report) {
    let report = check::conformity(&list, None);
    (list, report)
}

// The search for 817 vertices.
#[library_benchmark]
#[bench::of_radius_16(torus(), scratch_for(10_000), VertexId::new(5050))]
fn disk(mesh: Mesh, mut scratch: Scratch, center: VertexId) -> (Mesh, Scratch, query::Disk) {
    let disk = query::r_disk(mesh.rotation(), [center], 16, &mut scratch);
    (mesh, scratch, disk)
}

#[library_benchmark]
#[bench::torus(torus())]
fn validate(mesh: Mesh) -> (Mesh, Vec<RingDefect>) {
    let defects = mesh.rotation().validate();
    (mesh, defects)
}

library_benchmark_group!(
    name = stages,
    benchmarks = [uniform, incremental, build, read, write, conformity, disk, validate]
);
main!(
    config = LibraryBenchmarkConfig::default().tool(Callgrind::with_args(["--cache-sim=no"])),
    library_benchmark_groups = stages
);
