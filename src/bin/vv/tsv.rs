//! Tables of vertices and faces, tab-separated, one header line.

use std::io::{self, Write};

use vvmesh::certify::Certificate;
use vvmesh::step::SplitKind;
use vvmesh::{Edge, Triangle};

use crate::run::Run;

/// One line a vertex in the order of the output: `id level parents selected certified`, the last `-` without a certificate.
///
/// The run keeps names.
pub(crate) fn vertices(run: &Run, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "id\tlevel\tparents\tselected\tcertified")?;
    let certificate = run.certificate();
    let mut selected = run.selection.vertices().iter().peekable();
    for v in run.mesh.vertices() {
        let level = run.history.level(v).unwrap_or(0);
        write!(out, "{}\t{level}\t", v.index())?;
        if let Some(lineage) = run.history.parents(v) {
            write!(out, "{lineage}")?;
        }
        let is_selected = selected.next_if_eq(&&v).is_some();
        let flag = |certificate: &Certificate<'_>| if certificate.is_certified(v) { "1" } else { "0" };
        let certified = certificate.as_ref().map_or("-", flag);
        writeln!(out, "\t{}\t{certified}", u8::from(is_selected))?;
    }
    Ok(())
}

/// One line a face in the order of the output: `id level kind selected`. A face is selected if it is in a selection
/// of faces, or its corners are in another.
///
/// The kind is `regular`, or `closure` of what closes a crack; under √3 `even`, or `odd` of what comes before an edge is turned.
///
/// The run keeps names; `triangles` are those of its mesh.
pub(crate) fn faces(run: &Run, triangles: impl IntoIterator<Item = Triangle>, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "id\tlevel\tkind\tselected")?;
    let closing: Vec<Edge> = run.history.closing_edges(&run.mesh).unwrap_or_default();
    for (id, triangle) in triangles.into_iter().enumerate() {
        let (level, closes) = run.history.face_level(triangle, &closing).unwrap_or((0, false));
        let kind = match run.history.split_kind() {
            Some(SplitKind::Trisect) if run.history.generation(triangle).is_some_and(|made| made % 2 == 1) => "odd",
            Some(SplitKind::Trisect) => "even",
            _ if closes => "closure",
            _ => "regular",
        };
        let is_selected = run.selection.contains_face(triangle);
        writeln!(out, "{id}\t{level}\t{kind}\t{}", u8::from(is_selected))?;
    }
    Ok(())
}
