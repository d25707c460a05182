//! Questions about a place of a mesh: what stands around it, how far it reaches, how large it is.
//!
//! Nothing here changes a mesh or keeps anything of it. An answer costs what it looks at, not what the mesh holds, but for
//! the few measures of a whole mesh.
//!
//! Read in this order: [`star()`] (a vertex and what touches it), [`r_disk`], [`r_ring`] and [`expand`] (vertices by
//! distance), [`measure`] (lengths, angles, areas, normals).
//!
//! **Deliberately not here**: components, boundary loops and genus, which the rings alone answer
//! ([`crate::rotation`]), and shortest paths, which petgraph finds ([`crate::graph`]).

mod disk;
pub mod measure;
mod star;

pub use disk::{Disk, expand, r_disk, r_ring};
pub use star::{Star, star};
