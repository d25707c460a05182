//! What the tasks start from: a mesh as it was read, the same refined, and that with its vertices shuffled.

use std::error::Error;
use std::path::{Path, PathBuf};

use vvmesh::adaptive::Uniform;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, io};

use crate::raw::RawMesh;

/// Levels between the coarse mesh and the fine one.
pub(crate) const LEVELS: usize = 4;

/// Which mesh a task starts from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Input {
    Coarse,
    Fine,
    Shuffled,
}

/// How large the meshes are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    pub(crate) coarse_faces: usize,
    pub(crate) fine_faces: usize,
    pub(crate) fine_vertices: usize,
}

/// The files from which the peers read their meshes.
pub(crate) struct Workload {
    pub(crate) name: String,
    pub(crate) counts: Counts,
    folder: PathBuf,
}

impl Workload {
    /// Reads a closed mesh, OFF or OBJ, and writes what the tasks start from into a folder.
    pub(crate) fn prepare(path: &Path, folder: &Path) -> Result<Self, Box<dyn Error>> {
        let coarse = Mesh::from_face_list(&io::read(path)?.faces)?;
        if coarse.rotation().boundary_edge_count() > 0 {
            return Err("the mesh has a boundary, where the libraries follow different rules".into());
        }
        let mut fine = coarse.clone();
        let mut history = History::new(&fine, Keep::default());
        let subdivider = Subdivider::new(Loop::default(), Uniform);
        for _ in 0..LEVELS {
            let everything = Selection::empty();
            subdivider.step(&mut fine, &mut history, &everything, &mut Scratch::new(), &mut Control::default())?;
        }
        let counts = Counts {
            coarse_faces: coarse.face_count(),
            fine_faces: fine.face_count(),
            fine_vertices: fine.vertex_count(),
        };
        let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let workload = Self { name, counts, folder: folder.to_owned() };
        let fine = raw(&fine);
        raw(&coarse).write(&workload.file(Input::Coarse))?;
        fine.write(&workload.file(Input::Fine))?;
        shuffled(&fine).write(&workload.file(Input::Shuffled))?;
        Ok(workload)
    }

    pub(crate) fn file(&self, input: Input) -> PathBuf {
        self.folder.join(match input {
            Input::Coarse => "coarse",
            Input::Fine => "fine",
            Input::Shuffled => "shuffled",
        })
    }
}

fn raw(mesh: &Mesh) -> RawMesh {
    RawMesh {
        positions: mesh.positions().iter().map(|p| p.to_array()).collect(),
        triangles: mesh.triangles().map(|triangle| triangle.corners().map(|v: VertexId| v.index() as u32)).collect(),
    }
}

/// The same mesh with its vertices numbered at random, and the same way in every run.
fn shuffled(mesh: &RawMesh) -> RawMesh {
    let count = mesh.positions.len();
    let mut number: Vec<u32> = (0..count as u32).collect();
    // Fisher and Yates, with Knuth's multiplier of a linear congruence and its upper bits.
    let mut state = 1_u64;
    for k in (1..count).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        number.swap(k, (state >> 33) as usize % (k + 1));
    }
    let mut positions = vec![[0.0; 3]; count];
    for (&k, &position) in number.iter().zip(&mesh.positions) {
        positions[k as usize] = position;
    }
    let triangles = mesh.triangles.iter().map(|corners| corners.map(|v| number[v as usize])).collect();
    RawMesh { positions, triangles }
}
