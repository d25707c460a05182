//! Tables of vertices and faces, tab-separated, one header line.

use std::io::{self, Write};

use vvmesh::Edge;

use crate::run::Run;

/// One line a vertex in the order of the output: `id level parents selected certified`.
///
/// The run keeps names and a certificate.
pub(crate) fn vertices(run: &Run, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "id\tlevel\tparents\tselected\tcertified")?;
    let mut selected = run.selection.vertices().iter().peekable();
    for v in run.mesh.vertices() {
        let level = run.history.level(v).unwrap_or(0);
        write!(out, "{}\t{level}\t", v.index())?;
        if let Some(lineage) = run.history.parents(v) {
            write!(out, "{lineage}")?;
        }
        let is_selected = selected.next_if_eq(&&v).is_some();
        writeln!(out, "\t{}\t{}", u8::from(is_selected), u8::from(run.is_certified(v)))?;
    }
    Ok(())
}

/// One line a face in the order of the output: `id level kind selected`. A face is selected if its corners are.
///
/// The run keeps names.
pub(crate) fn faces(run: &Run, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "id\tlevel\tkind\tselected")?;
    let closing: Vec<Edge> = run.history.closing_edges(&run.mesh).unwrap_or_default();
    let mut selected = vec![false; run.mesh.vertex_count()];
    for v in run.selection.vertices() {
        selected[v.index()] = true;
    }
    for (id, triangle) in run.mesh.triangles().enumerate() {
        let (level, closes) = run.history.face_level(triangle, &closing).unwrap_or((0, false));
        let kind = if closes { "closure" } else { "regular" };
        let is_selected = triangle.corners().iter().all(|v| selected[v.index()]);
        writeln!(out, "{id}\t{level}\t{kind}\t{}", u8::from(is_selected))?;
    }
    Ok(())
}
