//! Adaptive subdivision of triangle meshes on a graph rotation system.
//!
//! A region of a mesh is refined in place, the mesh stays conforming, and with the method [`Incremental`] the surface over
//! the region is that of refining everything, bit for bit.
//!
//! # Tour
//!
//! A [`Mesh`] is a [`RotationSystem`], which holds for every vertex the ring of its neighbours, with a position for each vertex
//! and tags for edges and vertices that are sharp, for ever or for some steps. It is read from a file ([`io`]), built from
//! triangles ([`Mesh::from_triangles`]), or one of the [`shapes`].
//!
//! ```
//! use vvmesh::{VertexId, shapes};
//! let mesh = shapes::icosahedron();
//! let v = VertexId::new(0);
//! assert_eq!(mesh.ring(v).valence(), 5);
//! assert_eq!(mesh.rotation().triangles_around(v).len(), 5);
//! ```
//!
//! A [`Criterion`] makes a [`Selection`] of vertices, edges or faces (which when: `docs/criteria.md`, with a picture of each). A
//! [`Subdivider`] is a [scheme](scheme) with an [adaptive method](adaptive); each of its steps refines the region that the
//! method chooses for a selection, and answers with the selection that follows. What is remembered between steps is a
//! [`History`] that the caller holds.
//!
//! ```
//! use vvmesh::adaptive::Incremental;
//! use vvmesh::certify::Certificate;
//! use vvmesh::scheme::Loop;
//! use vvmesh::scratch::Scratch;
//! use vvmesh::select::{Criterion, Disk};
//! use vvmesh::step::{History, Keep};
//! use vvmesh::subdivide::{Control, Subdivider};
//! use vvmesh::{VertexId, check, shapes};
//!
//! let mut mesh = shapes::torus(12, 8, 2.0, 1.0);
//! let mut scratch = Scratch::new();
//! let mut history = History::new(&mesh, Keep { certificate: true, ..Keep::default() });
//! let mut selection = Disk::new(VertexId::new(0), 1).select(&mesh, &mut scratch)?;
//! let subdivider = Subdivider::new(Loop::default(), Incremental::new(1)?);
//! for _level in 0..2 {
//!     let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?;
//!     selection = step.selection;
//! }
//! let certificate = Certificate::new(&mesh, &history).expect("it was asked for");
//! assert!(selection.vertices().iter().all(|&v| certificate.is_certified(v)));
//! assert!(check::mesh_conformity(&mesh, None).is_conforming());
//! # Ok::<(), vvmesh::error::Error>(())
//! ```
//!
//! Then: [`query`] (stars, disks, areas, angles, normals), [`graph`] (petgraph's algorithms on the rings), [`limit`]
//! (where infinitely many steps lead, at vertices and between them), [`predict`] (how many steps and faces an accuracy
//! takes), [`until`] (refining until an accuracy is reached), `matrix` (refinement as a sparse matrix), [`attributes`]
//! (colours, texture coordinates and labels that ride along), [`stroke`] (refining by
//! drawing, with rays that [`pick`] faces), [`compare`] (methods beside uniform refinement), [`check`]
//! (what keeps faces from being a conforming mesh), [`rotation`] (edits and transactions), [`soup`] (faces that are no
//! mesh yet), [`Mesh::reordered`] (other numbers, for a mesh whose neighbours lie far apart in memory).
//!
//! # Features
//!
//! `cli` (default): what the binary `vv` needs, `parallel` with it. The library is the same without it.
//!
//! `matrix`: the module of that name, and sparse matrices as files.
//!
//! `parallel`: whole meshes are refined, built and checked on all threads of rayon's pool, with the same result to the last
//! bit. A local step runs on one.
//!
//! # Glossary
//!
//! Each word has one meaning in all of the documentation.
//!
//! **Rotation system, ring**: for every vertex the circular list of its neighbours, counter-clockwise seen from outside; a
//! place in a ring is a slot.
//!
#![doc = include_str!("../docs/ring.svg")]
//!
//! **Next, prev, splice**: the neighbour after and before a given one; to insert one after or before a given one.
//!
#![doc = include_str!("../docs/splice.svg")]
//!
//! **Valence**: the number of neighbours; *regular* is 6 inside and 4 on a boundary.
//!
#![doc = include_str!("../docs/valence.svg")]
//!
//! **One-ring, r-ring, r-disk**: the neighbours; the vertices at a distance of exactly r edges; those of at most r.
//!
#![doc = include_str!("../docs/disk.svg")]
//!
//! **Star, link**: a vertex with the edges and triangles at it; the edges opposite to it, a cycle, at a boundary a path.
//!
#![doc = include_str!("../docs/star.svg")]
//!
//! **Directed edge**: a name (from, to), elsewhere called dart or half-edge; its triangle lies on the left. Nothing is stored
//! for it.
//!
#![doc = include_str!("../docs/directed-edge.svg")]
//!
//! **Boundary**: edges with one triangle, and vertices with an *open* ring, which is kept from the gap on.
//!
#![doc = include_str!("../docs/boundary.svg")]
//!
//! **Crease, corner, dart**: a chain of sharp edges; a vertex with three or more of them, or tagged; the end of one crease.
//!
//! **Sharpness, semi-sharp**: for how many steps an edge or a vertex is sharp, with a part of a step at the end; above 0 and
//! not infinite.
//!
#![doc = include_str!("../docs/features.svg")]
//!
//! **Even, odd vertex**: inherited from before the step; made in this step.
//!
#![doc = include_str!("../docs/even-odd.svg")]
//!
//! **Split, scheme, mask, support**: the topological rule; a split with masks; the weights of one new position; the vertices
//! that have one.
//!
#![doc = include_str!("../docs/mask.svg")]
//!
//! **Region, frontier**: what a step refines; the edges between it and the rest.
//!
#![doc = include_str!("../docs/region.svg")]
//!
//! **Seam, chart**: an edge at which the two faces have different values at their corners; the faces between seams. Cut along
//! them, a mesh is the *chart mesh* that lies over it.
//!
//! **T-vertex, O-vertex**: an odd vertex on an edge whose other triangle was not refined; the old vertex opposite to it, to
//! which closing the crack adds a neighbour.
//!
#![doc = include_str!("../docs/closing.svg")]
//!
//! **Red, green, leaf**: split in four; bisected for the time being, to close a crack; a triangle that is not split in four.
//!
//! **Hierarchy, restriction, shown**: the triangles of all levels over an input; the rule that a triangle is split only if all
//! of its level around its corners are there; what the mesh has of a hierarchy: its leaves, with cracks closed.
//!
//! **Hanging vertex**: one on the inside of an edge of a face, of which it is no corner.
//!
//! **Mobile, static vertex**: under static/mobile subdivision, one that moves in this step; one that stays for ever.
//!
//! **Even, odd triangle, mate**: under √3, one that is whole at its level; a part of a triangle around or beside a new vertex,
//! with a single youngest corner; the edge opposite to that, which is turned when the triangle across it is split too.
//!
#![doc = include_str!("../docs/half-steps.svg")]
//!
//! **Apex, refinement edge, block**: under 4-8, the youngest corner of a triangle; the edge opposite to it, at which the
//! triangle is bisected next; the two triangles that have one refinement edge in common, at a boundary a *half block* of one.
//! All other edges are *exterior*. The level of the apex is the *generation* of the triangle; input triangles, of generation 0,
//! are paired to blocks by a matching.
//!
#![doc = include_str!("../docs/blocks.svg")]
//!
//! **Level, depth**: how many steps made a vertex or a mesh; how often a triangle was refined.
//!
#![doc = include_str!("../docs/levels.svg")]
//!
//! **Conforming**: what two triangles share is nothing, a vertex or a whole edge; every edge has one or two triangles, whose
//! orientations agree.
//!
#![doc = include_str!("../docs/conforming.svg")]
//!
//! **Deliberately not here**: repairing what is no mesh, rendering, quads, and meshes in more than one thread at a time.
//!
//! [`Incremental`]: adaptive::Incremental
//! [`Criterion`]: select::Criterion
//! [`Selection`]: select::Selection
//! [`Subdivider`]: subdivide::Subdivider
//! [`History`]: step::History

pub mod accuracy;
pub mod adaptive;
pub mod angle;
pub mod attributes;
pub mod camera;
pub mod certify;
pub mod check;
pub mod compare;
pub mod error;
pub mod graph;
pub mod id;
pub mod io;
pub mod length;
pub mod limit;
#[cfg(feature = "matrix")]
pub mod matrix;
pub mod mesh;
mod number;
mod parallel;
pub mod pick;
pub mod predict;
pub mod query;
pub mod rotation;
pub mod scheme;
pub mod scratch;
pub mod select;
pub mod shapes;
pub mod soup;
pub mod split;
pub mod step;
pub mod stroke;
pub mod subdivide;
pub mod until;

pub use glam;
pub use petgraph;
#[cfg(feature = "matrix")]
pub use sprs;

pub use accuracy::Accuracy;
pub use angle::Angle;
pub use camera::Camera;
pub use id::{DirectedEdge, Edge, Triangle, VertexId};
pub use length::Length;
pub use mesh::Mesh;
pub use rotation::{Ring, RotationSystem};

/// The code in the README is tested with the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
