//! Whether triangles next to each other are of nearly the same level.

use super::{Finding, FindingKind};
use crate::id::{Triangle, VertexId};
use crate::mesh::Mesh;
use crate::soup::EdgeTable;

/// Which triangles are next to each other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sharing {
    /// Those that share an edge: weak balance.
    Edge,
    /// Those that share a vertex: strong balance, which the weak one follows from.
    Vertex,
}

/// Looks for triangles next to each other whose levels differ by more than one.
///
/// `level` is asked once for each triangle, in the order of [`Mesh::triangles`]. There is one finding for each edge
/// whose two triangles differ too much, or for each vertex around which any two do; it names the edge or the vertex and
/// the first triangle of the least and of the greatest level, which are ordered by edge or vertex.
///
/// ```
/// use vvmesh::{check::{Sharing, balance}, shapes};
/// let mut levels = [3, 2, 1, 1].into_iter();
/// let findings = balance(&shapes::tetrahedron(), Sharing::Edge, |_| levels.next().unwrap());
/// assert_eq!(findings.len(), 2);
/// ```
///
/// # Complexity
/// O(triangles), and O(d log d) for a vertex of valence d.
#[must_use]
pub fn balance(mesh: &Mesh, sharing: Sharing, level: impl FnMut(Triangle) -> u32) -> Vec<Finding> {
    let levels: Vec<u32> = mesh.triangles().map(level).collect();
    let list = mesh.to_face_list();
    match sharing {
        Sharing::Edge => {
            let table = EdgeTable::new(&list, &vec![true; list.face_count()]);
            let spread = table.edges().filter_map(|edge| {
                let spread = edge.faces().fold(None, |spread, face| widened(spread, face, &levels))?;
                finding(format!("edge {}", edge.name()), &edge.name().ends(), spread, &levels)
            });
            spread.collect()
        }
        Sharing::Vertex => {
            let mut spreads = vec![None; list.vertex_count()];
            for (k, face) in list.faces().enumerate() {
                for &v in face {
                    spreads[v as usize] = widened(spreads[v as usize], k, &levels);
                }
            }
            let spread = spreads.into_iter().enumerate().filter_map(|(k, spread)| {
                let v = VertexId::new(k);
                finding(format!("vertex {v}"), &[v], spread?, &levels)
            });
            spread.collect()
        }
    }
}

/// The first face of the least level and the first of the greatest, after one more face.
fn widened(spread: Option<[usize; 2]>, face: usize, levels: &[u32]) -> Option<[usize; 2]> {
    let [least, greatest] = spread.unwrap_or([face; 2]);
    let least = if levels[face] < levels[least] { face } else { least };
    let greatest = if levels[face] > levels[greatest] { face } else { greatest };
    Some([least, greatest])
}

fn finding(place: String, vertices: &[VertexId], [least, greatest]: [usize; 2], levels: &[u32]) -> Option<Finding> {
    let [low, high] = [levels[least], levels[greatest]];
    (high - low > 1).then(|| Finding {
        kind: FindingKind::LevelBalance,
        message: format!("faces {least} and {greatest} at {place} have levels {low} and {high}"),
        vertices: vertices.to_vec(),
        faces: vec![least.min(greatest), least.max(greatest)],
    })
}
