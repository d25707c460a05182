//! OFF, the text format of Geomview, with the variants found in the field.
//!
//! It is a stream of words: lines matter only where optional colours end. Counted things come one after the other,
//! however they are broken into lines.
//!
//! **Deliberately not here**: binary OFF and vertices of more or fewer than three coordinates; they are refused.

use std::io::{self, Write};

use glam::DVec3;

use super::attributes::FaceAttributes;
use super::notes::{self, Note, NoteKind};
use super::obj_tags::TagLines;
use super::text::{Stream, float, integer, normalize, shown};
use super::write::{self, Surface};
use super::{Format, Loaded};
use crate::error::{ReadError, ReadErrorKind};
use crate::id::VertexId;
use crate::soup::FaceList;

/// Reads the text of an OFF file.
///
/// The header is `OFF` with any of `ST`, `C`, `N` before it, or missing; counts of vertices, faces and edges follow (that
/// of edges may be missing), then vertices, then faces; `#` starts a comment anywhere. Normals, colours and texture
/// coordinates are told in the notes and ignored. The words after a face that starts a line are its colour if there are
/// 1, 3 or 4 of them, else the next faces. Vertex `k` is the `k`-th of the file, and corners count from 0.
///
/// # Errors
/// With the line: counts that do not fit what follows (the end comes too early, or more comes), a word that is no number,
/// an index out of range, a face of fewer than three corners. Without: an empty file, binary OFF, vertices that
/// have not three coordinates (`4OFF`, `nOFF`), UTF-16.
///
/// # Complexity
/// O(bytes), in time and space: nothing is reserved on the word of the header.
///
/// ```
/// let loaded = vvmesh::io::read_off(b"OFF 3 1 # no count of edges\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2  255 0 0\n")?;
/// assert_eq!(loaded.faces.face(0), [0, 1, 2]);
/// assert_eq!(loaded.notes[0].to_string(), "colours of 1 face ignored (line 5)");
/// let error = vvmesh::io::read_off(b"OFF 3 1 0\n0 0 0\n").unwrap_err();
/// assert_eq!(error.to_string(), "line 2: unexpected end of the file, expected vertex 2 of 3");
/// # Ok::<(), vvmesh::error::ReadError>(())
/// ```
pub fn read_off(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let text = normalize(bytes)?;
    let mut reader = Reader { words: Stream::new(&text), notes: Vec::new() };
    let (header, counts) = reader.header()?;
    let positions = reader.vertices(&header, counts.vertices)?;
    let faces = reader.faces(positions, counts.faces)?;
    if let Some(word) = reader.words.next() {
        return Err(reader.words.error(ReadErrorKind::Trailing(shown(word))));
    }
    let (attributes, tag_lines) = (FaceAttributes::default(), TagLines::default());
    Ok(Loaded { format: Format::Off, faces, attributes, tag_lines, notes: reader.notes })
}

/// Writes OFF: the header with the counts, vertices, faces. The count of edges is 0, as most writers have it.
///
/// Numbers are the shortest that give the same bits when read. The faces of a mesh come by smallest corner, then in the
/// order of its ring.
///
/// # Errors
/// What the writer says.
pub fn write_off(out: &mut impl Write, surface: &impl Surface) -> io::Result<()> {
    let mut lines = write::Lines::new(out);
    lines.text(&format!("OFF\n{} {} 0\n", surface.positions().len(), surface.face_count()))?;
    for &position in surface.positions() {
        lines.numbers(&position.to_array())?;
    }
    surface.try_for_each_face(|face| {
        lines.integer(face.len());
        lines.corners(face, 0)
    })?;
    lines.finish()
}

/// What the first word says of the vertices.
#[derive(Default)]
pub(super) struct Header {
    texture: bool,
    colors: bool,
    normals: bool,
    four: bool,
    any_dimension: bool,
}

impl Header {
    /// `[ST][C][N][4][n]OFF`, or `off` in small letters.
    pub(super) fn parse(word: &[u8]) -> Option<Self> {
        let mut flags = word.strip_suffix(b"OFF").or(if word == b"off" { Some(b"") } else { None })?;
        let mut take = |flag: &[u8]| match flags.strip_prefix(flag) {
            Some(rest) => {
                flags = rest;
                true
            }
            None => false,
        };
        let mut header = Self { texture: take(b"ST"), colors: take(b"C"), ..Self::default() };
        // Both orders of these two are found.
        header.normals = take(b"N");
        header.colors |= take(b"C");
        header.four = take(b"4");
        header.any_dimension = take(b"n");
        flags.is_empty().then_some(header)
    }
}

struct Counts {
    vertices: usize,
    faces: usize,
}

struct Reader<'a> {
    words: Stream<'a>,
    notes: Vec<Note>,
}

impl Reader<'_> {
    fn header(&mut self) -> Result<(Header, Counts), ReadError> {
        let Some(first) = self.words.peek() else {
            return Err(ReadError::whole(ReadErrorKind::Empty));
        };
        let header = match Header::parse(first) {
            Some(header) => {
                self.words.next();
                header
            }
            None if first[0].is_ascii_digit() => {
                notes::count(&mut self.notes, NoteKind::NoHeader, 1);
                Header::default()
            }
            None => {
                self.words.next();
                return Err(self.words.error(ReadErrorKind::NotAnInteger(shown(first))));
            }
        };
        if header.four || header.any_dimension {
            return Err(self.words.error(ReadErrorKind::Unsupported("OFF with vertices that have not 3 coordinates")));
        }
        if self.words.peek() == Some(b"BINARY") {
            return Err(self.words.error(ReadErrorKind::Unsupported("binary OFF")));
        }
        let vertices = self.count("the count of vertices")?;
        let faces = self.count("the count of faces")?;
        // The count of edges stands in the line of the counts, or alone in its own.
        let edges_follow = self.words.is_in_line()
            || self.words.peek().is_some_and(|word| integer(word).is_ok()) && self.words.words_in_next_line() == 1;
        if edges_follow {
            self.count("the count of edges")?;
        }
        if vertices > VertexId::MAX_INDEX + 1 {
            return Err(self.words.error(ReadErrorKind::TooMany("vertices")));
        }
        Ok((header, Counts { vertices, faces }))
    }

    fn vertices(&mut self, header: &Header, count: usize) -> Result<Vec<DVec3>, ReadError> {
        let normals = if header.normals { 3 } else { 0 };
        let texture = if header.texture { 2 } else { 0 };
        let mut positions = Vec::new();
        let mut more = normals + texture;
        if header.colors {
            // A colour has four values, or three, or is left out: the first vertex shows it if it stands in its line.
            let in_line = self.words.words_in_next_line();
            let without = 3 + more;
            more += if in_line == without || in_line == without + 3 { in_line - without } else { 4 };
        }
        for k in 0..count {
            let expected = || format!("vertex {} of {count}", k + 1);
            let mut values = [0.0; 3];
            for value in &mut values {
                *value = self.float(expected)?;
            }
            positions.push(DVec3::from(values));
            for (there, kind) in [
                (header.normals, NoteKind::VertexNormals),
                (header.colors && more > normals + texture, NoteKind::VertexColors { kept: false }),
                (header.texture, NoteKind::VertexTexture),
            ] {
                if there {
                    notes::count(&mut self.notes, kind, self.words.line);
                }
            }
            for _ in 0..more {
                self.float(expected)?;
            }
        }
        Ok(positions)
    }

    fn faces(&mut self, positions: Vec<DVec3>, count: usize) -> Result<FaceList, ReadError> {
        let vertices = positions.len();
        let mut list = FaceList::new(positions);
        let mut corners = Vec::new();
        let mut corner_count = 0;
        for k in 0..count {
            let expected = || format!("face {} of {count}", k + 1);
            let starts_line = !self.words.is_in_line();
            let sides = self.integer(expected)?;
            if sides < 3 {
                return Err(self.words.error(ReadErrorKind::TooFewCorners(sides.max(0) as usize)));
            }
            corners.clear();
            for _ in 0..sides {
                let index = self.integer(expected)?;
                let kind = ReadErrorKind::IndexOutOfRange { of: "vertex", index, count: vertices };
                let in_range = usize::try_from(index).is_ok_and(|index| index < vertices);
                corners.push(if in_range { index as u32 } else { return Err(self.words.error(kind)) });
            }
            corner_count += corners.len();
            if u32::try_from(corner_count).is_err() {
                return Err(self.words.error(ReadErrorKind::TooMany("corners of faces")));
            }
            list.push_face(&corners);
            let left = if starts_line { self.words.left_in_line(5) } else { 0 };
            if matches!(left, 1 | 3 | 4) {
                notes::count(&mut self.notes, NoteKind::FaceColors, self.words.line);
                for _ in 0..left {
                    self.float(expected)?;
                }
            }
        }
        Ok(list)
    }

    fn count(&mut self, what: &'static str) -> Result<usize, ReadError> {
        let count = self.integer(|| what.to_owned())?;
        usize::try_from(count).map_err(|_| self.words.error(ReadErrorKind::NotAnInteger(count.to_string())))
    }

    #[inline]
    fn float(&mut self, expected: impl Fn() -> String) -> Result<f64, ReadError> {
        let word = self.word(expected)?;
        float(word).map_err(|kind| self.words.error(kind))
    }

    #[inline]
    fn integer(&mut self, expected: impl Fn() -> String) -> Result<i64, ReadError> {
        let word = self.word(expected)?;
        integer(word).map_err(|kind| self.words.error(kind))
    }

    #[inline]
    fn word(&mut self, expected: impl Fn() -> String) -> Result<&[u8], ReadError> {
        match self.words.next() {
            Some(word) => Ok(word),
            None => Err(self.words.error(ReadErrorKind::UnexpectedEnd(expected()))),
        }
    }
}
