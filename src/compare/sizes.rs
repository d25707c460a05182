//! How large meshes are that nobody made.

use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::predict::FullSize;
use crate::select::{Elements, Selection};
use crate::step::SplitKind;

/// Faces and vertices after so many uniform steps; `None` if 64 bits do not hold them, and of bisections, as it is the pairing
/// that says which edges they split. O(vertices + steps).
pub(super) fn uniform(mesh: &Mesh, kind: SplitKind, steps: u8) -> Option<[u64; 2]> {
    match kind {
        SplitKind::Quadrisect => FullSize::new(mesh, steps.into()).map(|size| [size.faces, size.vertices]),
        SplitKind::Trisect => trisected(mesh, steps),
        SplitKind::Bisect => None,
    }
}

/// How many faces there are at least after so many steps of a selection that is followed: splitting in four, those that come of
/// the faces inside of it stay inside. As many as there are if nothing is known. O(vertices + faces · log(selected)).
pub(super) fn at_least(mesh: &Mesh, selection: &Selection, kind: SplitKind, steps: u8) -> u64 {
    let faces = mesh.face_count() as u64;
    let inside = match selection.elements() {
        Elements::Vertices(_) => {
            let is_inside = |triangle: &Triangle| triangle.corners().iter().all(|&v| selection.contains(v));
            mesh.triangles().filter(is_inside).count() as u64
        }
        Elements::Faces(faces) => faces.len() as u64,
        Elements::Edges(_) => 0,
    };
    match kind {
        SplitKind::Quadrisect => {
            let parts = 4_u64.saturating_pow(steps.into());
            inside.saturating_mul(parts).saturating_add(faces.saturating_sub(inside))
        }
        SplitKind::Trisect if inside == faces => trisected(mesh, steps).map_or(u64::MAX, |[faces, _]| faces),
        SplitKind::Trisect | SplitKind::Bisect => faces,
    }
}

/// A step makes three triangles of one, and every second one three boundary edges of one. What Euler's formula says of
/// V − E + F stays, and 2E = 3F + B.
fn trisected(mesh: &Mesh, steps: u8) -> Option<[u64; 2]> {
    let [faces, vertices] = [mesh.face_count(), mesh.vertex_count()].map(|size| size as u64);
    let boundary = mesh.rotation().boundary_edge_count() as u64;
    let [refined, cut] = [faces.checked_mul(3_u64.checked_pow(steps.into())?)?, 3_u64.checked_pow((steps / 2).into())?];
    let grown = (refined - faces) + boundary.checked_mul(cut - 1)?;
    Some([refined, vertices.checked_add(grown / 2)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adaptive::Uniform;
    use crate::scheme::{AnyScheme, Loop, Sqrt3};
    use crate::scratch::Scratch;
    use crate::shapes;
    use crate::step::{History, Keep};
    use crate::subdivide::{Control, Subdivider};

    #[test]
    fn sizes_are_those_of_uniform_meshes() {
        let none = Selection::empty();
        for scheme in [AnyScheme::from(Loop::default()), Sqrt3::default().into()] {
            for input in [shapes::grid(3, 2), shapes::icosahedron()] {
                let (mut mesh, mut history) = (input.clone(), History::new(&input, Keep::default()));
                let (kind, subdivider) = (scheme.split_kind(), Subdivider::new(scheme.clone(), Uniform));
                for steps in 1..=4 {
                    let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
                    subdivider.step(&mut mesh, &mut history, &none, scratch, control).expect("nothing limits it");
                    let made = [mesh.face_count() as u64, mesh.vertex_count() as u64];
                    assert_eq!(uniform(&input, kind, steps), Some(made), "{kind:?} {steps}");
                    let all = Selection::all(input.vertex_count());
                    assert_eq!(at_least(&input, &all, kind, steps), made[0], "{kind:?} {steps}");
                }
            }
        }
        assert_eq!(uniform(&shapes::icosahedron(), SplitKind::Trisect, 255), None);
        let (grid, part) = (shapes::grid(3, 2), (0..4).map(crate::VertexId::new).collect());
        assert_eq!(at_least(&grid, &part, SplitKind::Quadrisect, 2), 12);
        assert_eq!(at_least(&grid, &Selection::all(12), SplitKind::Quadrisect, 255), u64::MAX);
    }
}
