//! A refinement under way: a mesh with its history and the selection that follows.

use std::time::Instant;

use vvmesh::Mesh;
use vvmesh::attributes::ObjAttributes;
use vvmesh::certify::Certificate;
use vvmesh::error::RefineError;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Step, Subdivider};

use crate::aim::Aim;
use crate::report::{MobileRow, Row, Sizes, Totals};

/// What all steps of a run share.
pub(crate) struct Run {
    pub(crate) mesh: Mesh,
    pub(crate) history: History,
    /// What is selected in the mesh as it is now.
    pub(crate) selection: Selection,
    pub(crate) scratch: Scratch,
    pub(crate) levels: Vec<Row>,
    /// What was selected in each step, if that is kept.
    pub(crate) selections: Option<Vec<Selection>>,
    /// What the file says of the faces, if it is written again.
    pub(crate) attributes: Option<ObjAttributes>,
    /// What is to be reached, if something is.
    pub(crate) aim: Option<Aim>,
    subdivider: Subdivider,
}

impl Run {
    pub(crate) fn new(mesh: Mesh, subdivider: Subdivider, keep: Keep) -> Self {
        let history = History::new(&mesh, keep);
        let (selection, scratch) = (Selection::empty(), Scratch::new());
        let (levels, selections) = (Vec::new(), None);
        Self { mesh, history, selection, scratch, levels, selections, attributes: None, aim: None, subdivider }
    }

    /// Makes one step for the selection, which then is the one that follows.
    pub(crate) fn step(&mut self, control: &mut Control<'_>) -> Result<Step, RefineError> {
        let started = Instant::now();
        let Self { mesh, history, selection, scratch, subdivider, .. } = self;
        let step = match &mut self.attributes {
            Some(attributes) => attributes.step(subdivider, mesh, history, selection, scratch, control)?,
            None => subdivider.step(mesh, history, selection, scratch, control)?,
        };
        let seconds = started.elapsed().as_secs_f64();
        if step.did_nothing() {
            return Ok(step);
        }
        let sizes = self.sizes();
        self.levels.push(Row {
            level: self.next_level(),
            selected: step.selected,
            region: step.region,
            split_edges: step.split_edges,
            vertices: sizes.vertices,
            edges: sizes.edges,
            faces: sizes.faces,
            t_vertices: step.t_vertices.len(),
            o_vertices: step.o_vertices.len(),
            max_valence: sizes.max_valence,
            certified: step.certified,
            mobile: step.mobile.map(|counts| MobileRow {
                static_vertices: counts.static_vertices,
                faces_by_mobile_corners: counts.faces_by_mobile_corners,
                unclosed_faces: counts.faces,
            }),
            error: None,
            seconds,
        });
        let selected = std::mem::replace(&mut self.selection, step.selection.clone());
        if let Some(selections) = &mut self.selections {
            selections.push(selected);
        }
        Ok(step)
    }

    /// The last level that was made, 0 if none was.
    pub(crate) fn made_levels(&self) -> u8 {
        self.levels.last().map_or(0, |row| row.level)
    }

    /// The level that the next step makes.
    pub(crate) fn next_level(&self) -> u8 {
        // There are at most 255 levels, as that is what can be asked for.
        self.made_levels().saturating_add(1)
    }

    /// The certificate, if it is kept.
    pub(crate) fn certificate(&self) -> Option<Certificate<'_>> {
        Certificate::new(&self.mesh, &self.history)
    }

    pub(crate) fn sizes(&self) -> Sizes {
        Sizes {
            vertices: self.mesh.vertex_count(),
            edges: self.mesh.edge_count(),
            faces: self.mesh.face_count(),
            max_valence: self.history.max_valence(),
        }
    }

    pub(crate) fn totals(&self) -> Totals {
        let certified = match self.levels.last() {
            Some(row) => row.certified,
            None => self.certificate().map(|certificate| certificate.certified().count()),
        };
        Totals {
            sizes: self.sizes(),
            selected: self.selection.vertices().len(),
            certified,
            seconds: self.levels.iter().map(|row| row.seconds).sum(),
        }
    }
}
