//! Files: OBJ and OFF, read into a list of faces and written from one or from a mesh.
//!
//! A reader is lenient about what a file holds and strict about how it is written. Coordinates that are no finite
//! numbers, repeated corners, vertices without a face: all that is kept, and [`FaceList::defects`] tells of it. What
//! cannot be read as it stands is a [`ReadError`] that names the line. Nothing is ignored in silence: see [`Note`].
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
}

impl Format {
    /// The format that the ending of a name tells, in small or capital letters.
    #[must_use]
    pub fn from_ending(path: impl AsRef<Path>) -> Option<Self> {
        let ending = path.as_ref().extension()?;
        [(Self::Obj, "obj"), (Self::Off, "off")]
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
        })
    }
}

/// What a file held.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The format it was read as.
    pub format: Format,
    /// Vertices and faces with the numbers they have in the file, counted from 0.
    pub faces: FaceList,
    /// What stands at the faces beside their corners.
    pub attributes: FaceAttributes,
    /// Lines that say what is sharp, not looked at; reading OFF leaves it empty.
    pub tag_lines: TagLines,
    /// What was ignored or set aside, in the order of its first appearance.
    pub notes: Vec<Note>,
}

/// Reads a file, OBJ or OFF.
///
/// What the content says counts more than the ending of the name; if it says nothing, the ending decides.
///
/// # Errors
/// The file system's; a format that is not read, or that neither content nor ending tell; else those of [`read_obj`] and
/// [`read_off`]. Every message names the file.
pub fn read(path: impl AsRef<Path>) -> Result<Loaded, ReadError> {
    let path = path.as_ref();
    let loaded = std::fs::read(path).map_err(|error| ReadError::whole(ReadErrorKind::Io(error))).and_then(|bytes| {
        let ending = Format::from_ending(path);
        let format =
            told_by_content(&bytes)?.or(ending).ok_or_else(|| ReadError::whole(ReadErrorKind::UnknownFormat))?;
        let mut loaded = match format {
            Format::Obj => read_obj(&bytes)?,
            Format::Off => read_off(&bytes)?,
        };
        if ending.is_some_and(|ending| ending != format) {
            notes::count(&mut loaded.notes, NoteKind::Ending(format), 1);
        }
        Ok(loaded)
    });
    loaded.map_err(|error| ReadError { path: Some(path.to_owned()), ..error })
}

/// Writes a file, OBJ or OFF by the ending of its name, whole or not at all: see [`write_atomically`].
///
/// # Errors
/// An ending that is neither; else those of [`write_atomically`].
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

/// As [`save`], with what is said of faces and vertices as [`write_obj_with`] writes it. OFF is written without.
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
        None => Err(WriteError { path: path.to_owned(), kind: WriteErrorKind::UnknownEnding }),
    }
}

/// The format that the first word tells, if it does.
fn told_by_content(bytes: &[u8]) -> Result<Option<Format>, ReadError> {
    let unsupported = |format| Err(ReadError::whole(ReadErrorKind::Unsupported(format)));
    let text = text::normalize(bytes)?;
    let mut words = text.split(|&byte| byte == b'\n').filter_map(|line| {
        let mut words = text::Words::new(line);
        words.next().map(|first| (first, words.next().is_some()))
    });
    let Some((first, followed)) = words.next() else {
        return Err(ReadError::whole(ReadErrorKind::Empty));
    };
    match first {
        b"ply" => unsupported("PLY"),
        b"solid" => unsupported("STL"),
        b"v" | b"vt" | b"vn" | b"f" | b"o" | b"mtllib" | b"usemtl" if followed => Ok(Some(Format::Obj)),
        b"g" | b"s" => Ok(Some(Format::Obj)),
        _ if off::Header::parse(first).is_some() => Ok(Some(Format::Off)),
        _ if first.starts_with(b"glTF") => unsupported("glTF"),
        _ => Ok(None),
    }
}
