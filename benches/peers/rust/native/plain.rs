//! No library: positions, index triples, and what has to be made of them for each task. Says what arrays alone can do.

use std::error::Error;

use super::{Measured, Search, timed};
use crate::answer::Answer;
use crate::raw::RawMesh;
use crate::task::{BYTES_A_FACE, Task};
use crate::workload::LEVELS;

type Point = [f64; 3];

pub(super) fn run(task: Task, input: &RawMesh, seconds: f64) -> Result<Option<Measured>, Box<dyn Error>> {
    Ok(Some(match task {
        Task::Loop4 => refined(input, LEVELS, seconds),
        Task::Loop1 | Task::Shuffled => refined(input, 1, seconds),
        Task::Build => {
            let (samples, _) = timed(seconds, || None, |built| *built = Some(Edges::new(input)));
            on(input, samples, "build: edges, and for every face its edges")
        }
        Task::Laplacian => {
            let neighbors = Neighbors::new(input);
            let positions = &input.positions;
            let (samples, sums) = timed(
                seconds,
                || vec![[0.0; 3]; positions.len()],
                |sums: &mut Vec<Point>| {
                    for (v, sum) in sums.iter_mut().enumerate() {
                        let here = positions[v];
                        for &w in neighbors.of(v) {
                            let there = positions[w as usize];
                            *sum = std::array::from_fn(|axis| sum[axis] + (there[axis] - here[axis]));
                        }
                    }
                },
            );
            Measured { result: sums.as_flattened().to_vec(), ..on(input, samples, "") }
        }
        Task::Search => {
            let neighbors = Neighbors::new(input);
            let around = |v: u32| neighbors.of(v as usize).iter().copied();
            let (samples, search) = timed(seconds, || Search::new(input.positions.len()), |search| search.run(around));
            Measured { result: search.result(), ..on(input, samples, "") }
        }
        Task::Memory => {
            let edges = Edges::new(input);
            let bytes = 24 * input.positions.len()
                + 12 * input.triangles.len()
                + 8 * edges.ends.len()
                + 12 * edges.of_faces.len();
            on(input, vec![bytes as f64], "memory: positions, faces and these edges")
        }
        Task::WriteTouched => memory(input, seconds, |words| vec![1; words.len()], |_, to| to.fill(2)),
        Task::WriteFresh => memory(input, seconds, |_| Vec::new(), |from, to| *to = vec![2; from.len()]),
        Task::CopyTouched => memory(input, seconds, |words| vec![1; words.len()], |from, to| to.copy_from_slice(from)),
        Task::CopyFresh => memory(input, seconds, |_| Vec::new(), |from, to| *to = from.to_vec()),
        Task::Butterfly4 | Task::Local | Task::Validity => return Ok(None),
    }))
}

fn on(mesh: &RawMesh, samples: Vec<f64>, note: &str) -> Measured {
    let answer = Answer { faces: mesh.triangles.len(), samples, note: note.to_owned() };
    Measured { answer, result: Vec::new() }
}

/// Fills as much memory as one step of refinement writes.
fn memory(
    input: &RawMesh,
    seconds: f64,
    target: impl Fn(&[u64]) -> Vec<u64>,
    work: impl Fn(&[u64], &mut Vec<u64>),
) -> Measured {
    let source = vec![3_u64; 4 * input.triangles.len() * BYTES_A_FACE / 8];
    let (samples, _) = timed(seconds, || target(&source), |to| work(std::hint::black_box(&source), to));
    on(input, samples, "")
}

fn refined(input: &RawMesh, levels: usize, seconds: f64) -> Measured {
    let (samples, mesh) = timed(
        seconds,
        || RawMesh { positions: input.positions.clone(), triangles: input.triangles.clone() },
        |mesh| {
            for _ in 0..levels {
                *mesh = loop_step(mesh);
            }
        },
    );
    let result = mesh.positions.as_flattened().to_vec();
    Measured { result, ..on(&mesh, samples, "") }
}

/// The neighbours of every vertex in any order, one list behind the other.
struct Neighbors {
    ends: Vec<u32>,
    all: Vec<u32>,
}

impl Neighbors {
    /// On a closed mesh every neighbour of a vertex stands behind it in exactly one triangle.
    fn new(mesh: &RawMesh) -> Self {
        let mut ends = starts(mesh, |[a, b, c]| [a, b, c]);
        let mut all = vec![0; 3 * mesh.triangles.len()];
        for &[a, b, c] in &mesh.triangles {
            for (v, next) in [(a, b), (b, c), (c, a)] {
                all[ends[v as usize] as usize] = next;
                ends[v as usize] += 1;
            }
        }
        Self { ends, all }
    }

    fn of(&self, v: usize) -> &[u32] {
        let start = if v == 0 { 0 } else { self.ends[v - 1] as usize };
        &self.all[start..self.ends[v] as usize]
    }
}

/// Where the list of each vertex starts if every triangle adds one entry to three lists.
fn starts(mesh: &RawMesh, lists: impl Fn([u32; 3]) -> [u32; 3]) -> Vec<u32> {
    let mut starts = vec![0; mesh.positions.len()];
    for &corners in &mesh.triangles {
        for v in lists(corners) {
            starts[v as usize] += 1;
        }
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += std::mem::replace(start, sum);
    }
    starts
}

/// The edges in the order of the faces that name them first.
struct Edges {
    ends: Vec<[u32; 2]>,
    /// The edges behind the first, second and third corner of every face.
    of_faces: Vec<[u32; 3]>,
}

impl Edges {
    /// Every vertex has a list of its edges to larger ones, with room for each to be named twice.
    fn new(mesh: &RawMesh) -> Self {
        const NONE: u32 = u32::MAX;
        let starts = starts(mesh, |[a, b, c]| [a.min(b), b.min(c), c.min(a)]);
        let mut lists = vec![NONE; 3 * mesh.triangles.len()];
        let mut ends: Vec<[u32; 2]> = Vec::with_capacity(3 * mesh.triangles.len() / 2);
        let mut of_faces = Vec::with_capacity(mesh.triangles.len());
        for &[a, b, c] in &mesh.triangles {
            of_faces.push([(a, b), (b, c), (c, a)].map(|(a, b)| {
                let (low, high) = (a.min(b), a.max(b));
                let mut slot = starts[low as usize] as usize;
                while lists[slot] != NONE && ends[lists[slot] as usize][1] != high {
                    slot += 1;
                }
                if lists[slot] == NONE {
                    lists[slot] = ends.len() as u32;
                    ends.push([low, high]);
                }
                lists[slot]
            }));
        }
        Self { ends, of_faces }
    }
}

/// One step of Loop on a closed mesh.
fn loop_step(mesh: &RawMesh) -> RawMesh {
    let (positions, old) = (&mesh.positions, mesh.positions.len());
    let edges = Edges::new(mesh);
    let mut triangles = Vec::with_capacity(4 * mesh.triangles.len());
    let mut opposite = vec![[0.0; 3]; edges.ends.len()];
    for (&[a, b, c], of_face) in mesh.triangles.iter().zip(&edges.of_faces) {
        for (&edge, corner) in of_face.iter().zip([c, a, b]) {
            opposite[edge as usize] = plus(opposite[edge as usize], positions[corner as usize]);
        }
        let [ab, bc, ca] = of_face.map(|edge| old as u32 + edge);
        triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }

    let mut sums = vec![([0.0; 3], 0_u32); old];
    let mut moved = Vec::with_capacity(old + edges.ends.len());
    moved.resize(old, [0.0; 3]);
    for (&[low, high], opposite) in edges.ends.iter().zip(opposite) {
        for (v, neighbor) in [(low, high), (high, low)] {
            let (sum, valence) = &mut sums[v as usize];
            (*sum, *valence) = (plus(*sum, positions[neighbor as usize]), *valence + 1);
        }
        let ends = plus(positions[low as usize], positions[high as usize]);
        moved.push(std::array::from_fn(|axis| 0.375 * ends[axis] + 0.125 * opposite[axis]));
    }
    for ((to, from), (sum, valence)) in moved.iter_mut().zip(positions).zip(sums) {
        let beta = beta(valence);
        *to = std::array::from_fn(|axis| (1.0 - f64::from(valence) * beta) * from[axis] + beta * sum[axis]);
    }
    RawMesh { positions: moved, triangles }
}

fn plus(a: Point, b: Point) -> Point {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

/// Loop's weight of a neighbour.
fn beta(valence: u32) -> f64 {
    if valence == 6 {
        return 1.0 / 16.0;
    }
    let n = f64::from(valence);
    let cosine = (std::f64::consts::TAU / n).cos();
    (0.625 - (0.375 + 0.25 * cosine).powi(2)) / n
}
