//! Questions about a place of a mesh: what stands around it, how far it reaches, how large it is.
//!
//! Nothing here changes a mesh or keeps anything of it. An answer costs what it looks at, not what the mesh holds, but for
//! the few measures of a whole mesh.
//!
//! Read in this order: [`star()`] (a vertex and what touches it), [`r_disk`], [`r_ring`] and [`expand`] (vertices by
//! distance in edges), [`ball_disk`] and [`path_disk`] (by length), [`measure`] (lengths, angles, areas, normals),
//! [`curvature`], [`normal_cone_rad`] and [`flatness()`] (how a mesh bends around a vertex).
//!
//! **Deliberately not here**: components, boundary loops and genus, which the rings alone answer
//! ([`crate::rotation`]), and shortest paths, which petgraph finds ([`crate::graph`]).

pub mod curvature;
mod disk;
mod flatness;
pub mod measure;
mod near;
mod normal_cone;
mod star;

pub use disk::{Disk, expand, r_disk, r_ring};
pub use flatness::{flatness, flatnesses};
pub use near::{ball_disk, path_disk};
pub use normal_cone::{normal_cone_rad, normal_cones_rad};
pub use star::{Star, star};

use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::parallel;

/// What is made of every vertex, by id.
fn by_vertex<T: Default + Send + Sync>(mesh: &Mesh, make: impl Fn(VertexId) -> T + Sync + Send) -> Vec<T> {
    parallel::list(mesh.vertex_count(), |v| make(VertexId::new(v)))
}
