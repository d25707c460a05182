//! STL, as text or binary: triangles whose corners are welded where their positions are equal.
//!
//! It is read here and not by a crate, for there is little to read, and much around it that matters: triangles without a
//! normal (`nan`), several solids in a file, attribute bytes, binary files that begin with `solid`, the line of an
//! error.
//!
//! **Deliberately not here**: corners that are near to each other. To weld those is to guess.

use std::collections::HashMap;
use std::io::{self, Write};

use foldhash::fast::RandomState;
use glam::DVec3;

use super::attributes::FaceAttributes;
use super::notes::{self, Note, NoteKind};
use super::obj_tags::TagLines;
use super::text::{Stream, float, normalize, shown};
use super::write::{Lines, Surface};
use super::{Format, Loaded};
use crate::error::{ReadError, ReadErrorKind};
use crate::soup::FaceList;

/// Reads an STL file, as text or binary.
///
/// Corners with equal positions are one vertex, where -0 equals 0; vertices are numbered by their first corner. That, the
/// normals, attribute bytes that are not 0, and solids beside the first are told in the notes. Names and the first 80
/// bytes of a binary file are comments.
///
/// A file is binary if it is as long as the number of triangles in it says, or does not begin with the word `solid`, or
/// has a zero among its first bytes: some writers begin binary files with `solid`.
///
/// # Errors
/// With the line, or the byte of a binary file: an end that comes too early, bytes behind the last triangle, a word that
/// is not the one expected or no number. Without: an empty file.
///
/// # Complexity
/// O(bytes), expected, in time and space: nothing is reserved on the word of the header.
///
/// ```
/// let text = "solid corner\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
///     facet normal 0 1 0\nouter loop\nvertex -0 0 0\nvertex 0 0 1\nvertex 1 0 0\nendloop\nendfacet\nendsolid corner\n";
/// let loaded = vvmesh::io::read_stl(text.as_bytes())?;
/// assert_eq!((loaded.faces.vertex_count(), loaded.faces.face(1)), (4, &[0, 3, 1][..]));
/// assert_eq!(loaded.notes[0].to_string(), "6 corners welded to 4 vertices where their positions are equal");
/// let error = vvmesh::io::read_stl(text.replace("1 0 0\nendloop", "1 0\nendloop").as_bytes()).unwrap_err();
/// assert_eq!(error.to_string(), "line 14: expected a number, found 'endloop'");
/// # Ok::<(), vvmesh::error::ReadError>(())
/// ```
pub fn read_stl(bytes: &[u8]) -> Result<Loaded, ReadError> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(ReadError::whole(ReadErrorKind::Empty));
    }
    let mut reading = Reading::default();
    if is_text(bytes) {
        reading.text(&normalize(bytes)?)?
    } else {
        reading.binary(bytes)?
    }
    let Reading { positions, triangles, mut notes, .. } = reading;
    if !triangles.is_empty() {
        let kind = NoteKind::Welded { vertices: positions.len() };
        notes.insert(0, Note { kind, count: 3 * triangles.len(), line: 0 });
    }
    let faces = FaceList::of_triangles(positions, triangles);
    let (attributes, tag_lines) = (FaceAttributes::default(), TagLines::default());
    Ok(Loaded { format: Format::Stl, faces, attributes, tag_lines, notes })
}

/// Writes binary STL: each triangle with its normal, which is 0 if it has none, and its corners.
///
/// Coordinates are rounded to single precision, and vertices without a face are left out.
///
/// # Errors
/// What the writer says; a face that is no triangle, a coordinate that is no number or too great for single precision, and
/// more triangles than 32 bits count, as [`io::ErrorKind::InvalidInput`].
pub fn write_stl(out: &mut impl Write, surface: &impl Surface) -> io::Result<()> {
    let invalid = |message: String| io::Error::new(io::ErrorKind::InvalidInput, message);
    let too_many = |_| invalid("STL counts triangles in 32 bits, and these are more".to_owned());
    let count = u32::try_from(surface.face_count()).map_err(too_many)?;
    let positions = surface.positions();
    let mut lines = Lines::new(out);
    lines.text(&format!("{:HEADER$}", "vvmesh"))?;
    lines.bytes(&count.to_le_bytes())?;
    surface.try_for_each_face(|face| {
        let &[a, b, c] = face else {
            return Err(invalid(format!("STL has triangles only, and a face has {} corners", face.len())));
        };
        let corners = [a, b, c].map(|v| positions[v as usize]);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        let mut triangle = [0; TRIANGLE];
        let values = [normal].into_iter().chain(corners).flat_map(|point| point.to_array());
        for (bytes, value) in triangle.chunks_exact_mut(4).zip(values) {
            let rounded = value as f32;
            if !rounded.is_finite() {
                return Err(invalid(format!("STL has single precision, in which {value} has no place")));
            }
            bytes.copy_from_slice(&rounded.to_le_bytes());
        }
        lines.bytes(&triangle)
    })?;
    lines.finish()
}

/// The bytes of a binary file before the number of triangles.
const HEADER: usize = 80;
/// The bytes before the first triangle.
const START: usize = HEADER + 4;
/// The bytes of a triangle: a normal, three corners, two more.
const TRIANGLE: usize = 50;

/// Whether a file is binary STL of just the length that it says.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    count(bytes).is_some_and(|count| (bytes.len() - START) as u64 == u64::from(count) * TRIANGLE as u64)
}

fn is_text(bytes: &[u8]) -> bool {
    let begins = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && !is_binary(bytes) && !bytes[..bytes.len().min(START)].contains(&0)
}

/// The number of triangles that a binary file says it has.
fn count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER..START)?;
    count.try_into().ok().map(u32::from_le_bytes)
}

#[derive(Default)]
struct Reading {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The vertex at a position, by its bits. The seed of the hashes differs from run to run, so no file is made to be slow.
    at: HashMap<[u64; 3], u32, RandomState>,
    notes: Vec<Note>,
}

impl Reading {
    fn binary(&mut self, bytes: &[u8]) -> Result<(), ReadError> {
        let end = |what: String| ReadError::behind(bytes.len(), ReadErrorKind::UnexpectedEnd(what));
        let count = count(bytes).ok_or_else(|| end(format!("{START} bytes before the first triangle")))? as usize;
        let triangles = bytes[START..].chunks_exact(TRIANGLE);
        let there = triangles.len();
        self.triangles.reserve_exact(count.min(there));
        for (k, triangle) in triangles.take(count).enumerate() {
            let mut corners = [[0.0; 3]; 3];
            // The normal stands before them.
            for (value, bytes) in corners.as_flattened_mut().iter_mut().zip(triangle[12..48].chunks_exact(4)) {
                *value = f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]).into();
            }
            let read = START + TRIANGLE * (k + 1);
            self.triangle(corners).map_err(|kind| ReadError::behind(read, kind))?;
            if triangle[TRIANGLE - 2..] != [0, 0] {
                notes::count(&mut self.notes, NoteKind::AttributeBytes, 0);
            }
        }
        if there < count {
            return Err(end(format!("triangle {} of {count}", there + 1)));
        }
        match bytes.len() - START - TRIANGLE * count {
            0 => Ok(()),
            more => Err(ReadError::behind(bytes.len() - more, ReadErrorKind::TrailingBytes(more))),
        }
    }

    fn text(&mut self, text: &[u8]) -> Result<(), ReadError> {
        let mut words = Stream::new(text);
        let mut solids = 0;
        while words.peek().is_some() {
            expect(&mut words, "solid")?;
            words.skip_line();
            solids += 1;
            while self.facet(&mut words)? {}
            words.skip_line();
        }
        if solids > 1 {
            self.notes.push(Note { kind: NoteKind::Solids, count: solids, line: 0 });
        }
        Ok(())
    }

    /// Reads a triangle, or the end of the solid.
    fn facet(&mut self, words: &mut Stream<'_>) -> Result<bool, ReadError> {
        const EXPECTED: &str = "'facet' or 'endsolid'";
        match next(words, EXPECTED)? {
            word if word.eq_ignore_ascii_case(b"endsolid") => return Ok(false),
            word if word.eq_ignore_ascii_case(b"facet") => {}
            word => return Err(wrong(words, EXPECTED, word)),
        }
        expect(words, "normal")?;
        numbers(words)?;
        expect(words, "outer")?;
        expect(words, "loop")?;
        let mut corners = [[0.0; 3]; 3];
        for corner in &mut corners {
            expect(words, "vertex")?;
            *corner = numbers(words)?;
        }
        self.triangle(corners).map_err(|kind| words.error(kind))?;
        expect(words, "endloop")?;
        expect(words, "endfacet")?;
        Ok(true)
    }

    fn triangle(&mut self, corners: [[f64; 3]; 3]) -> Result<(), ReadErrorKind> {
        /// As many triangles have their corners counted in 32 bits.
        const MOST: usize = u32::MAX as usize / 3;
        if self.triangles.len() == MOST {
            return Err(ReadErrorKind::TooMany("corners of faces"));
        }
        let mut vertices = [0; 3];
        for (vertex, corner) in vertices.iter_mut().zip(corners) {
            // + 0 makes 0 of -0. There are no more vertices than corners, so their ids have a place.
            let bits = corner.map(|value| (value + 0.0).to_bits());
            let next = self.positions.len() as u32;
            *vertex = *self.at.entry(bits).or_insert(next);
            if *vertex == next {
                self.positions.push(corner.into());
            }
        }
        self.triangles.push(vertices);
        notes::count(&mut self.notes, NoteKind::FaceNormals, 0);
        Ok(())
    }
}

fn next<'a>(words: &mut Stream<'a>, expected: &str) -> Result<&'a [u8], ReadError> {
    let end = |words: &Stream<'_>| words.error(ReadErrorKind::UnexpectedEnd(expected.to_owned()));
    match words.next() {
        Some(word) => Ok(word),
        None => Err(end(words)),
    }
}

fn expect(words: &mut Stream<'_>, expected: &'static str) -> Result<(), ReadError> {
    let word = next(words, expected)?;
    if word.eq_ignore_ascii_case(expected.as_bytes()) { Ok(()) } else { Err(wrong(words, expected, word)) }
}

fn wrong(words: &Stream<'_>, expected: &'static str, found: &[u8]) -> ReadError {
    words.error(ReadErrorKind::Word { expected, found: shown(found) })
}

fn numbers(words: &mut Stream<'_>) -> Result<[f64; 3], ReadError> {
    let mut values = [0.0; 3];
    for value in &mut values {
        let word = next(words, "a number")?;
        *value = float(word).map_err(|kind| words.error(kind))?;
    }
    Ok(values)
}
