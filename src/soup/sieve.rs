//! Which faces can be looked at together: those that are no defect by themselves and stand in the list once.

use std::cmp::Ordering;

use super::FaceList;
use super::defects::{enumerated, vertex_ids};
use crate::error::{Defect, DefectKind};
use crate::id::VertexId;

/// Which faces are kept, and why the others are not.
#[derive(Debug)]
pub(crate) struct Sieve {
    /// For every face whether it is kept.
    pub(crate) kept: Vec<bool>,
    /// Index out of range, degenerate and duplicate faces, in this order, then by face.
    pub(crate) defects: Vec<Defect>,
}

impl Sieve {
    /// Looks at every face by itself, then for those that stand in the list twice; the first of these is kept.
    ///
    /// O(n log n) in the number of corners.
    pub(crate) fn new(list: &FaceList) -> Self {
        let limit = list.vertex_limit();
        let mut kept = vec![true; list.face_count()];
        let mut out_of_range = Vec::new();
        let mut degenerate = Vec::new();
        let mut buffer = Vec::new();
        for (k, face) in list.faces().enumerate() {
            let bad = face.iter().find(|&&v| v as usize >= limit);
            let degeneracy = degeneracy(face, &mut buffer);
            kept[k] = bad.is_none() && degeneracy.is_none();
            if let Some(bad) = bad {
                out_of_range.push(Defect {
                    kind: DefectKind::IndexOutOfRange,
                    vertices: Vec::new(),
                    faces: vec![k],
                    message: format!("face {k} names vertex {bad}, but there are {limit} vertices, counted from 0"),
                });
            }
            if let Some(why) = degeneracy {
                let existing = face.iter().copied().filter(|&v| (v as usize) < limit);
                degenerate.push(Defect {
                    kind: DefectKind::DegenerateFace,
                    vertices: vertex_ids(existing),
                    faces: vec![k],
                    message: format!("face {k} {why}"),
                });
            }
        }
        let mut defects = out_of_range;
        defects.append(&mut degenerate);
        for [first, repeated] in duplicates(list, &kept) {
            kept[repeated] = false;
            defects.push(duplicate(list, first, repeated));
        }
        Self { kept, defects }
    }
}

/// Why a face is degenerate, if it is, as the rest of a sentence about it.
pub(super) fn degeneracy(face: &[u32], buffer: &mut Vec<u32>) -> Option<String> {
    let repeated = match *face {
        [] | [_] | [_, _] => return Some(format!("has {} corners, at least 3 are needed", face.len())),
        [a, b, c] => (a == b || a == c).then_some(a).or((b == c).then_some(b)),
        _ => {
            buffer.clear();
            buffer.extend_from_slice(face);
            buffer.sort_unstable();
            buffer.windows(2).find(|two| two[0] == two[1]).map(|two| two[0])
        }
    };
    repeated.map(|v| format!("names vertex {v} twice"))
}

/// The faces that stand in the list already, each behind the first of its kind, ascending.
fn duplicates(list: &FaceList, kept: &[bool]) -> Vec<[usize; 2]> {
    // The number of sides and the first three corners tell all triangles apart and nearly all polygons.
    let mut keys: Vec<(usize, [u32; 3], usize)> = Vec::with_capacity(list.face_count());
    for (k, face) in list.faces().enumerate().filter(|&(k, _)| kept[k]) {
        let mut corners = canonical(face);
        let first = [(); 3].map(|()| corners.next().expect("a kept face has three corners"));
        keys.push((face.len(), first, k));
    }
    keys.sort_unstable();
    let mut found = Vec::new();
    for run in keys.chunk_by_mut(|p, q| (p.0, p.1) == (q.0, q.1)).filter(|run| run.len() > 1) {
        let compare = |p: usize, q: usize| canonical(list.face(p)).cmp(canonical(list.face(q)));
        run.sort_unstable_by(|p, q| compare(p.2, q.2).then(p.2.cmp(&q.2)));
        for same in run.chunk_by(|p, q| compare(p.2, q.2) == Ordering::Equal) {
            found.extend(same[1..].iter().map(|repeated| [same[0].2, repeated.2]));
        }
    }
    found.sort_unstable_by_key(|&[_, repeated]| repeated);
    found
}

/// The corners from the smallest on, towards the smaller of its two neighbours: the same for a face, however it is
/// written, and its reverse.
fn canonical(face: &[u32]) -> impl Iterator<Item = u32> {
    let count = face.len();
    let start = (0..count).min_by_key(|&k| face[k]).unwrap_or(0);
    let ascends = face[(start + 1) % count] < face[(start + count - 1) % count];
    (0..count).map(move |k| face[(if ascends { start + k } else { start + count - k }) % count])
}

fn duplicate(list: &FaceList, first: usize, repeated: usize) -> Defect {
    let corners = list.face(repeated);
    let follows = |face: &[u32], a: u32, b: u32| {
        let at = face.iter().position(|&v| v == a).unwrap_or(0);
        face[(at + 1) % face.len()] == b
    };
    let turned = if follows(list.face(first), corners[0], corners[1]) { "" } else { ", turned round" };
    let vertices = vertex_ids(corners.iter().copied());
    let names = enumerated(vertices.iter().map(VertexId::to_string));
    Defect {
        kind: DefectKind::DuplicateFace,
        message: format!("face {repeated} repeats face {first}{turned} (corners {names})"),
        vertices,
        faces: vec![first, repeated],
    }
}
