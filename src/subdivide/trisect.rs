//! A step of √3.

use super::{Control, Step};
use crate::error::RefineError;
use crate::mesh::Mesh;
use crate::scheme::Sqrt3;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::{History, Region};

/// Refines the triangles inside of a region.
pub(super) fn step(
    _scheme: &Sqrt3,
    _mesh: &mut Mesh,
    _history: &mut History,
    _selection: &Selection,
    _region: &Region,
    _scratch: &mut Scratch,
    _control: &mut Control<'_>,
) -> Result<Step, RefineError> {
    unreachable!("the commits that follow make it")
}
