//! A mesh that is refined with what rides along.

use vvmesh::Mesh;
use vvmesh::attributes::{Attributes, Blend, Channel, CornerChannel, Seams};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};

/// A mesh with what rides along.
pub struct Ride {
    pub mesh: Mesh,
    pub history: History,
    pub attributes: Attributes,
}

impl Ride {
    pub fn new(mesh: &Mesh) -> Self {
        let history = History::new(mesh, Keep { names: true, certificate: false });
        Self { mesh: mesh.clone(), history, attributes: Attributes::default() }
    }

    pub fn step(&mut self, subdivider: &Subdivider, selection: &Selection) -> Selection {
        let Self { mesh, history, attributes } = self;
        let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
        attributes
            .step(subdivider, mesh, history, selection, scratch, control)
            .expect("nothing limits the step")
            .selection
    }

    /// The positions as a channel of vertices and one of corners, without seams.
    pub fn add_positions(&mut self, blend: Blend) {
        let positions: Vec<[f64; 3]> = self.mesh.positions().iter().map(|p| p.to_array()).collect();
        let channel = Channel::new("position", blend, positions).expect("three numbers each");
        let corners: Vec<_> = self.mesh.triangles().map(|t| Some(t.corners().map(|v| v.index() as u32))).collect();
        self.attributes
            .add_corner_channel(&self.mesh, &self.history, &channel, &corners, Seams::Scheme)
            .expect("one for each vertex");
        self.attributes.add_vertex_channel(&self.mesh, channel).expect("one for each vertex");
    }

    pub fn corner(&self, name: &str) -> &CornerChannel {
        self.attributes.corner_channel(name).expect("it was added")
    }

    /// For each triangle the values at its corners.
    pub fn values_at_corners(&self, name: &str) -> Vec<Option<[Vec<f64>; 3]>> {
        let channel = self.corner(name);
        let values = |face: [u32; 3]| face.map(|k| channel.values().value(k as usize).to_vec());
        channel.faces(&self.mesh).map(|face| face.map(values)).collect()
    }
}
