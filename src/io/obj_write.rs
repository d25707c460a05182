//! OBJ, written: vertices, faces, and what is said of them.
//!
//! **Deliberately not here**: what becomes of the attributes when a mesh is refined.

use std::io::{self, Write};

use super::attributes::{FaceAttributes, State};
use super::write::{Lines, Surface};

/// Writes OBJ: `v` lines, then `f` lines, nothing else.
///
/// Numbers are the shortest that give the same bits when read. The faces of a mesh come by smallest corner, then in the
/// order of its ring.
///
/// # Errors
/// What the writer says.
pub fn write_obj(out: &mut impl Write, surface: &impl Surface) -> io::Result<()> {
    write_obj_with(out, surface, &FaceAttributes::default())
}

/// Writes OBJ with what is said of its faces and vertices; faces and corners are counted in the order of the surface.
///
/// The order is `mtllib`, `v` with colours, `vt`, `vn`, then the faces with `o`, `g`, `usemtl` and `s` where these
/// change. Of texture coordinates the third value is written if any is not 0. What was read and is written comes back
/// equal when it is read again.
///
/// # Errors
/// What the writer says.
///
/// ```
/// use vvmesh::io;
/// let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.5\ng left\nusemtl red\nf 1/1 2/1 3/1\n";
/// let loaded = io::read_obj(text.as_bytes())?;
/// let mut written = Vec::new();
/// io::write_obj_with(&mut written, &loaded.faces, &loaded.attributes)?;
/// assert_eq!(String::from_utf8(written)?, text);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_obj_with(out: &mut impl Write, surface: &impl Surface, attributes: &FaceAttributes) -> io::Result<()> {
    let mut lines = Lines::new(out);
    for library in &attributes.material_libraries {
        statement(&mut lines, "mtllib", [library.as_str()])?;
    }
    for (k, position) in surface.positions().iter().enumerate() {
        lines.text("v ")?;
        match attributes.vertex_colors.get(k).copied().flatten() {
            Some([r, g, b]) => lines.numbers(&[position.x, position.y, position.z, r, g, b])?,
            None => lines.numbers(&position.to_array())?,
        }
    }
    let texture_values = if attributes.texture_coordinates.iter().any(|values| values[2] != 0.0) { 3 } else { 2 };
    for values in &attributes.texture_coordinates {
        lines.text("vt ")?;
        lines.numbers(&values[..texture_values])?;
    }
    for normal in &attributes.normals {
        lines.text("vn ")?;
        lines.numbers(&normal.to_array())?;
    }
    faces(&mut lines, surface, attributes)?;
    lines.finish()
}

fn faces<W: Write>(lines: &mut Lines<'_, W>, surface: &impl Surface, attributes: &FaceAttributes) -> io::Result<()> {
    let has_indices = !(attributes.texture_indices.is_empty() && attributes.normal_indices.is_empty());
    let mut sections = attributes.sections.iter().peekable();
    let before_all = State::default();
    let (mut state, mut face_count, mut corner_count) = (&before_all, 0, 0);
    surface.try_for_each_face(|corners| {
        while let Some(section) = sections.next_if(|section| section.first_face == face_count) {
            change_state(lines, state, &section.state)?;
            state = &section.state;
        }
        face_count += 1;
        lines.text("f")?;
        if !has_indices {
            return lines.corners(corners, 1);
        }
        for &v in corners {
            lines.corner(v, attributes.texture_index(corner_count), attributes.normal_index(corner_count))?;
            corner_count += 1;
        }
        lines.text("\n")
    })
}

/// The lines that lead from one state to the next.
fn change_state<W: Write>(lines: &mut Lines<'_, W>, from: &State, to: &State) -> io::Result<()> {
    if from.object != to.object {
        statement(lines, "o", to.object.as_deref())?;
    }
    if from.groups != to.groups {
        statement(lines, "g", to.groups.iter().map(|name| &**name))?;
    }
    if from.material != to.material {
        statement(lines, "usemtl", to.material.as_deref())?;
    }
    if from.smoothing != to.smoothing {
        match to.smoothing {
            0 => statement(lines, "s", ["off"])?,
            group => statement(lines, "s", [group.to_string().as_str()])?,
        }
    }
    Ok(())
}

fn statement<'a, W: Write>(
    lines: &mut Lines<'_, W>,
    keyword: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> io::Result<()> {
    lines.text(keyword)?;
    for name in names {
        lines.text(" ")?;
        lines.text(name)?;
    }
    lines.text("\n")
}
