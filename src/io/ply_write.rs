//! PLY, written: binary, with coordinates in double precision.
//!
//! **Deliberately not here**: PLY as text. What is read again by programs is better not printed.

use std::convert::Infallible;
use std::io::{self, Write};

use super::attributes::FaceAttributes;
use super::write::{Lines, Surface};

/// Writes PLY: vertices and faces, binary with the small byte first.
///
/// Coordinates are doubles, so that reading gives the same bits. The faces of a mesh come by smallest corner, then in the
/// order of its ring.
///
/// # Errors
/// What the writer says.
pub fn write_ply(out: &mut impl Write, surface: &impl Surface) -> io::Result<()> {
    write_ply_with(out, surface, &FaceAttributes::default())
}

/// Writes PLY with the colours of vertices and the texture coordinates of corners; corners are counted in the order of the
/// surface. For what else is said there is no place, see [`FaceAttributes::held_by`].
///
/// Colours are written as other programs read them, in whole numbers from 0 to 255 to which they are rounded; vertices
/// without one are white. The two texture coordinates of each corner stand in a list `texcoord` of the face, which is
/// empty if a corner has none.
///
/// # Errors
/// What the writer says.
///
/// ```
/// use vvmesh::io;
/// let loaded = io::read_obj(b"v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0.5\nf 1/1 2/1 3/1\n")?;
/// let mut ply = Vec::new();
/// io::write_ply_with(&mut ply, &loaded.faces, &loaded.attributes)?;
/// # #[cfg(feature = "ply")]
/// # {
/// let again = io::read_ply(&ply)?;
/// assert_eq!(again.faces, loaded.faces);
/// assert_eq!(again.attributes.vertex_colors, loaded.attributes.vertex_colors);
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_ply_with(out: &mut impl Write, surface: &impl Surface, attributes: &FaceAttributes) -> io::Result<()> {
    let has_colors = !attributes.vertex_colors.is_empty();
    let has_texture = !attributes.texture_indices.is_empty();
    let count = CountType::of(surface);
    let mut lines = Lines::new(out);
    lines.text(&header(surface, has_colors, has_texture, count))?;
    for (k, position) in surface.positions().iter().enumerate() {
        lines.bytes(position.to_array().map(f64::to_le_bytes).as_flattened())?;
        if has_colors {
            let color = attributes.vertex_colors.get(k).copied().flatten().unwrap_or([1.0; 3]);
            lines.bytes(&color.map(in_eight_bits))?;
        }
    }
    if has_texture {
        faces_with_texture(&mut lines, surface, attributes, count)?;
    } else {
        surface.try_for_each_face(|face| corners(&mut lines, face, count))?;
    }
    lines.finish()
}

fn corners<W: Write>(lines: &mut Lines<'_, W>, face: &[u32], count: CountType) -> io::Result<()> {
    count.write(lines, face.len())?;
    face.iter().try_for_each(|v| lines.bytes(&v.to_le_bytes()))
}

fn faces_with_texture<W: Write>(
    lines: &mut Lines<'_, W>,
    surface: &impl Surface,
    attributes: &FaceAttributes,
    count: CountType,
) -> io::Result<()> {
    let mut corner_count = 0;
    surface.try_for_each_face(|face| {
        corners(lines, face, count)?;
        let here = corner_count..corner_count + face.len();
        corner_count = here.end;
        if here.clone().any(|corner| attributes.texture_index(corner).is_none()) {
            return count.write(lines, 0);
        }
        count.write(lines, 2 * face.len())?;
        let values = here.filter_map(|corner| attributes.texture_index(corner));
        let mut values = values.flat_map(|index| attributes.texture_coordinates[index].into_iter().take(2));
        values.try_for_each(|value| lines.bytes(&value.to_le_bytes()))
    })
}

/// The colour as it is written, from 0 for none to 255 for 1.
fn in_eight_bits(value: f64) -> u8 {
    (255.0 * value).round() as u8
}

fn header(surface: &impl Surface, has_colors: bool, has_texture: bool, count: CountType) -> String {
    // Most programs expect indices to be `int`; they are read as `uint` only where they have to.
    let index = if i32::try_from(surface.positions().len()).is_ok() { "int" } else { "uint" };
    let count = count.name();
    let mut header = format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", surface.positions().len());
    for axis in ["x", "y", "z"] {
        header += &format!("property double {axis}\n");
    }
    for color in ["red", "green", "blue"].into_iter().filter(|_| has_colors) {
        header += &format!("property uchar {color}\n");
    }
    header += &format!("element face {}\nproperty list {count} {index} vertex_indices\n", surface.face_count());
    if has_texture {
        header += &format!("property list {count} double texcoord\n");
    }
    header + "end_header\n"
}

/// How the lengths of lists are written: in a byte, if each has a place in it.
#[derive(Clone, Copy)]
enum CountType {
    Byte,
    Word,
}

impl CountType {
    fn of(surface: &impl Surface) -> Self {
        // Of texture coordinates there are twice as many as corners.
        const MOST: usize = u8::MAX as usize / 2;
        let mut greatest = 0;
        let Ok(()) = surface.try_for_each_face(|face| {
            greatest = greatest.max(face.len());
            Ok::<_, Infallible>(())
        });
        if greatest <= MOST { Self::Byte } else { Self::Word }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Byte => "uchar",
            Self::Word => "uint",
        }
    }

    fn write<W: Write>(self, lines: &mut Lines<'_, W>, count: usize) -> io::Result<()> {
        match self {
            Self::Byte => lines.bytes(&[count as u8]),
            Self::Word => lines.bytes(&(count as u32).to_le_bytes()),
        }
    }
}
