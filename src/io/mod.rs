//! Files: OBJ, OFF, PLY and STL, read into a list of faces and written from one or from a mesh.
//!
//! A reader is lenient about what a file holds and strict about how it is written. Coordinates that are no finite
//! numbers, repeated corners, vertices without a face: all that is kept, and [`FaceList::defects`] tells of it. What
//! cannot be read as it stands is a [`ReadError`] that names the line or the byte. Nothing is ignored in silence: see [`Note`].
//!
//! PLY is read with the feature `ply` alone, as that brings serde; without it, it is refused.
//!
//! Read in this order: [`read`], [`Loaded`], [`FaceAttributes`], [`TagLines`], [`save`], [`save_with`].
//!
//! **Deliberately not here**: triangles of polygons ([`FaceList::triangulate`]) and the mesh itself
//! ([`Mesh::from_triangles`](crate::Mesh::from_triangles)).

mod atomic;
mod attributes;
#[cfg(feature = "matrix")]
mod matrix_market;
mod notes;
mod obj;
mod obj_scan;
mod obj_tags;
mod obj_write;
mod off;
#[cfg(feature = "ply")]
mod ply;
#[cfg(feature = "ply")]
mod ply_plan;
#[cfg(feature = "ply")]
mod ply_prepared;
mod ply_write;
mod stl;
mod text;
mod write;

pub use atomic::write_atomically;
pub use attributes::FaceAttributes;
pub(crate) use attributes::NO_INDEX;
#[cfg(feature = "matrix")]
pub use matrix_market::write_matrix_market;
pub use notes::{Note, NoteKind};
pub use obj::read_obj;
pub use obj_tags::{ObjTags, TagLines};
pub use obj_write::{write_obj, write_obj_with};
pub use off::{read_off, write_off};
#[cfg(feature = "ply")]
pub use ply::read_ply;
pub use ply_write::{write_ply, write_ply_with};
pub use stl::{read_stl, write_stl};
pub use write::Surface;

use std::fmt;
use std::path::Path;

use crate::error::{ReadError, ReadErrorKind, WriteError, WriteErrorKind};
use crate::soup::FaceList;

/// A format of mesh files.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Object File Format of Geomview, as text.
    Off,
    /// Polygon File Format of Stanford, as text or binary.
    Ply,
    /// The triangles of stereolithography, as text or binary.
    Stl,
}

impl Format {
    /// The format that the ending of a name tells, in small or capital letters.
    #[must_use]
    pub fn from_ending(path: impl AsRef<Path>) -> Option<Self> {
        let ending = path.as_ref().extension()?;
        [(Self::Obj, "obj"), (Self::Off, "off"), (Self::Ply, "ply"), (Self::Stl, "stl")]
            .into_iter()
            .find(|(_, name)| ending.eq_ignore_ascii_case(name))
            .map(|(format, _)| format)
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::Off => "OFF",
            Self::Ply => "PLY",
            Self::Stl => "STL",
        })
    }
}

/// What a file held.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The format it was read as.
    pub format: Format,
    /// Vertices and faces with the numbers they have in the file, counted from 0; those of STL are numbered as they come.
    pub faces: FaceList,
    /// What stands at the faces beside their corners.
    pub attributes: FaceAttributes,
    /// Lines that say what is sharp, not looked at; only OBJ has any.
    pub tag_lines: TagLines,
    /// What was ignored or set aside, in the order of its first appearance.
    pub notes: Vec<Note>,
}

/// Reads a file.
///
/// What the content says counts more than the ending of the name; if it says nothing, the ending decides.
///
/// # Errors
/// The file system's; a format that is not read, or that neither content nor ending tell; else those of [`read_obj`],
/// [`read_off`], `read_ply` and [`read_stl`]. Every message names the file.
pub fn read(path: impl AsRef<Path>) -> Result<Loaded, ReadError> {
    let path = path.as_ref();
    let loaded = std::fs::read(path).map_err(|error| ReadError::whole(ReadErrorKind::Io(error))).and_then(|bytes| {
        let ending = Format::from_ending(path);
        let format =
            told_by_content(&bytes)?.or(ending).ok_or_else(|| ReadError::whole(ReadErrorKind::UnknownFormat))?;
        let mut loaded = match format {
            Format::Obj => read_obj(&bytes)?,
            Format::Off => read_off(&bytes)?,
            Format::Ply => read_ply(&bytes)?,
            Format::Stl => read_stl(&bytes)?,
        };
        if ending.is_some_and(|ending| ending != format) {
            notes::count(&mut loaded.notes, NoteKind::Ending(format), 1);
        }
        Ok(loaded)
    });
    loaded.map_err(|error| ReadError { path: Some(path.to_owned()), ..error })
}

#[cfg(not(feature = "ply"))]
fn read_ply(_: &[u8]) -> Result<Loaded, ReadError> {
    Err(ReadError::whole(ReadErrorKind::Unsupported("PLY")))
}

/// Writes a file, whose format the ending of its name tells, whole or not at all: see [`write_atomically`].
///
/// # Errors
/// Another ending; else those of [`write_atomically`].
///
/// ```
/// use vvmesh::{io, shapes};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("tetrahedron.off");
/// let mesh = shapes::tetrahedron();
/// io::save(&path, &mesh)?;
/// assert_eq!(io::read(&path)?.faces, mesh.to_face_list());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn save(path: impl AsRef<Path>, surface: &impl Surface) -> Result<(), WriteError> {
    save_with(path, surface, &FaceAttributes::default())
}

/// As [`save`], with what is said of faces and vertices as far as the format [holds it](FaceAttributes::held_by).
///
/// # Errors
/// Those of [`save`].
pub fn save_with(
    path: impl AsRef<Path>,
    surface: &impl Surface,
    attributes: &FaceAttributes,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    match Format::from_ending(path) {
        Some(Format::Obj) => write_atomically(path, |out| write_obj_with(out, surface, attributes)),
        Some(Format::Off) => write_atomically(path, |out| write_off(out, surface)),
        Some(Format::Ply) => write_atomically(path, |out| write_ply_with(out, surface, attributes)),
        Some(Format::Stl) => write_atomically(path, |out| write_stl(out, surface)),
        None => Err(WriteError { path: path.to_owned(), kind: WriteErrorKind::UnknownEnding }),
    }
}

/// The format that the first word tells, or that a binary file has, if they do.
fn told_by_content(bytes: &[u8]) -> Result<Option<Format>, ReadError> {
    let unsupported = |format| Err(ReadError::whole(ReadErrorKind::Unsupported(format)));
    if stl::is_binary(bytes) {
        return Ok(Some(Format::Stl));
    }
    let text = text::normalize(bytes)?;
    let mut words = text.split(|&byte| byte == b'\n').filter_map(|line| {
        let mut words = text::Words::new(line);
        words.next().map(|first| (first, words.next().is_some()))
    });
    let Some((first, followed)) = words.next() else {
        return Err(ReadError::whole(ReadErrorKind::Empty));
    };
    match first {
        b"ply" => Ok(Some(Format::Ply)),
        b"v" | b"vt" | b"vn" | b"f" | b"o" | b"mtllib" | b"usemtl" if followed => Ok(Some(Format::Obj)),
        b"g" | b"s" => Ok(Some(Format::Obj)),
        _ if first.eq_ignore_ascii_case(b"solid") => Ok(Some(Format::Stl)),
        _ if off::Header::parse(first).is_some() => Ok(Some(Format::Off)),
        _ if first.starts_with(b"glTF") => unsupported("glTF"),
        _ => Ok(None),
    }
}
