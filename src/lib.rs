//! Adaptive subdivision of triangle meshes on a graph rotation system.

pub mod adaptive;
pub mod angle;
pub mod certify;
pub mod check;
pub mod error;
pub mod graph;
pub mod id;
pub mod io;
pub mod limit;
pub mod mesh;
pub mod query;
pub mod rotation;
pub mod scheme;
pub mod scratch;
pub mod select;
pub mod shapes;
pub mod soup;
pub mod split;
pub mod step;
pub mod subdivide;

pub use glam;
pub use petgraph;

pub use angle::Angle;
pub use id::{DirectedEdge, Edge, Triangle, VertexId};
pub use mesh::Mesh;
pub use rotation::{Ring, RotationSystem};
