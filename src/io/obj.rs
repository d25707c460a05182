//! OBJ, read through tobj and written by hand. Only this file names tobj.
//!
//! tobj reads coordinates and faces; [`Scan`] stands before it, passes on the lines it may see, checks and counts them.
//! tobj numbers vertices by first use and drops those without a face, so it is given more faces at the end, which name
//! all vertices in the order of the file: what it makes of them tells where each vertex went.
//!
//! **Deliberately not here**: material files. Their names are kept, they are not opened.

use std::io::{self, BufRead, Read, Write};
use std::ops::Range;

use glam::DVec3;

use super::obj_scan::{Feeding, Scan};
use super::text::{Words, float, normalize, shown};
use super::write::{self, Surface};
use super::{Format, Loaded};
use crate::error::{ReadError, ReadErrorKind};
use crate::id::VertexId;
use crate::soup::FaceList;

/// Reads the text of an OBJ file.
///
/// Vertex `k` is the `k`-th `v` line, whether a face uses it or not, and the faces are those of the file, of any number
/// of sides, in its order; groups and materials split nothing. Corners may repeat and coordinates may be infinite or no
/// numbers: [`FaceList::defects`] tells. An index may point to a line further below. A line that ends in `\` goes on in
/// the next.
///
/// # Errors
/// With the line: a word that is no number, too few or too many numbers, an index that is 0, no integer or out of
/// range (of a texture coordinate or normal too), a face of fewer than three corners. Without: an empty file, one
/// without vertices, UTF-16.
///
/// # Complexity
/// O(bytes), in time and space.
///
/// ```
/// let loaded = vvmesh::io::read_obj(b"v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\ng left\nf 1 3 4 # a comment\n")?;
/// assert_eq!(loaded.faces.face(0), [0, 2, 3]);
/// assert!(loaded.attributes.groups(0).eq(["left"]));
/// let error = vvmesh::io::read_obj(b"v 0 0 0\nf 1 1 2\n").unwrap_err();
/// assert_eq!(error.to_string(), "line 2: index out of range: vertex 2, there are 1");
/// # Ok::<(), vvmesh::error::ReadError>(())
/// ```
pub fn read_obj(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let text = normalize(bytes)?;
    let mut feed = Feed::new(&text);
    // Points and lines are kept for the sake of the last faces; the file's own are refused or left out by the scan.
    let options = tobj::LoadOptions { ignore_lines: false, ignore_points: false, ..tobj::LoadOptions::default() };
    let answer = tobj::load_obj_buf(&mut feed, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    if let Some(error) = feed.error.take() {
        return Err(error);
    }
    let (models, _) = answer.map_err(|_| feed.blame())?;
    let scan = feed.scan;
    let mesh = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    Ok(Loaded {
        format: Format::Obj,
        faces: in_file_order(&mesh, &scan),
        attributes: scan.attributes,
        notes: scan.notes,
    })
}

/// Writes OBJ: `v` lines, then `f` lines, nothing else.
///
/// Numbers are the shortest that give the same bits when read. The faces of a mesh come by smallest corner, then in the
/// order of its ring.
///
/// # Errors
/// What the writer says.
pub fn write_obj(out: &mut impl Write, surface: &impl Surface) -> io::Result<()> {
    let mut lines = write::Lines::new(out);
    for &position in surface.positions() {
        lines.text("v ")?;
        lines.position(position)?;
    }
    surface.try_for_each_face(|face| {
        lines.text("f")?;
        lines.corners(face, 1)
    })?;
    lines.finish()
}

/// How many vertices one of the last faces names.
const NAMED_AT_ONCE: usize = 1024;

/// The text as tobj may see it, line by line.
struct Feed<'a> {
    text: &'a [u8],
    /// Where the next line starts, and its number.
    next: usize,
    number: usize,
    scan: Scan,
    /// What tobj is reading: a part of the text, or of the buffer.
    from_text: bool,
    reading: Range<usize>,
    buffer: Vec<u8>,
    /// The line of the file it comes from.
    reading_number: usize,
    /// How many vertices the last faces have named, once the text is at its end.
    named: Option<usize>,
    error: Option<ReadError>,
}

impl<'a> Feed<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self {
            text,
            next: 0,
            number: 1,
            scan: Scan::default(),
            from_text: false,
            reading: 0..0,
            buffer: Vec::new(),
            reading_number: 0,
            named: None,
            error: None,
        }
    }

    /// Goes on to the next line that tobj is to see, or to an empty one at the end.
    fn advance(&mut self) -> Result<(), ReadError> {
        while self.next < self.text.len() {
            let (start, number) = (self.next, self.number);
            let end = self.end_of_line(start);
            self.reading_number = number;
            if goes_on(&self.text[start..end]) {
                self.join(start, end);
                let joined = std::mem::take(&mut self.buffer);
                let feeding = self.scan.line(&joined, number);
                self.buffer = joined;
                let length = match feeding? {
                    Feeding::Nothing => continue,
                    Feeding::Whole => self.buffer.len(),
                    Feeding::Head(length) => length,
                };
                self.buffer.truncate(length);
            } else {
                match self.scan.line(&self.text[start..end], number)? {
                    Feeding::Nothing => continue,
                    Feeding::Whole if end < self.text.len() => {
                        self.from_text = true;
                        self.reading = start..end + 1;
                        return Ok(());
                    }
                    Feeding::Whole => self.copy(start, end),
                    Feeding::Head(length) => self.copy(start, start + length),
                }
            }
            self.show_buffer();
            return Ok(());
        }
        self.name_vertices()
    }

    /// Where a line ends; the next starts behind it.
    fn end_of_line(&mut self, start: usize) -> usize {
        let length = self.text[start..].iter().position(|&byte| byte == b'\n');
        let end = length.map_or(self.text.len(), |length| start + length);
        self.next = end + 1;
        self.number += 1;
        end
    }

    fn copy(&mut self, start: usize, end: usize) {
        self.buffer.clear();
        self.buffer.extend_from_slice(&self.text[start..end]);
    }

    /// Puts a line and those it goes on in into the buffer.
    fn join(&mut self, start: usize, end: usize) {
        let (mut start, mut end) = (start, end);
        self.buffer.clear();
        loop {
            let line = self.text[start..end].trim_ascii_end();
            let more = line.strip_suffix(b"\\");
            self.buffer.extend_from_slice(more.unwrap_or(line));
            self.buffer.push(b' ');
            if more.is_none() || self.next >= self.text.len() {
                return;
            }
            start = self.next;
            end = self.end_of_line(start);
        }
    }

    fn show_buffer(&mut self) {
        self.buffer.push(b'\n');
        self.from_text = false;
        self.reading = 0..self.buffer.len();
    }

    /// The last faces: all vertices in the order of the file.
    fn name_vertices(&mut self) -> Result<(), ReadError> {
        let named = match self.named {
            Some(named) => named,
            None => {
                self.scan.finish()?;
                if self.scan.vertex_count == 0 {
                    let is_empty = self.text.split(|&byte| byte == b'\n').all(|line| Words::new(line).next().is_none());
                    return Err(ReadError::whole(if is_empty {
                        ReadErrorKind::Empty
                    } else {
                        ReadErrorKind::NoVertex
                    }));
                }
                if VertexId::try_new(self.scan.vertex_count - 1).is_none() {
                    return Err(ReadError::whole(ReadErrorKind::TooMany("vertices")));
                }
                if u32::try_from(self.scan.corner_count).is_err() {
                    return Err(ReadError::whole(ReadErrorKind::TooMany("corners of faces")));
                }
                0
            }
        };
        let end = (named + NAMED_AT_ONCE).min(self.scan.vertex_count);
        self.named = Some(end);
        self.buffer.clear();
        if named == end {
            self.reading = 0..0;
            return Ok(());
        }
        self.buffer.push(b'f');
        for k in named..end {
            self.buffer.push(b' ');
            write::push_integer(&mut self.buffer, k as u64 + 1);
        }
        self.show_buffer();
        Ok(())
    }

    fn current(&self) -> &[u8] {
        if self.from_text { &self.text[self.reading.clone()] } else { &self.buffer[self.reading.clone()] }
    }

    /// What is wrong with the line that tobj read last.
    fn blame(&self) -> ReadError {
        let line = if self.from_text { &self.text[..self.reading.end] } else { &self.buffer[..] };
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        let line = line.rsplit(|&byte| byte == b'\n').next().unwrap_or_default();
        let mut words = Words::new(line).skip(1);
        let kind = words.find_map(|word| float(word).err()).unwrap_or_else(|| ReadErrorKind::NotANumber(shown(line)));
        ReadError::at(self.reading_number, kind)
    }
}

/// Whether a line of numbers goes on in the next. A comment or a name does not: it may end like `C:\`.
fn goes_on(line: &[u8]) -> bool {
    line.trim_ascii_end().ends_with(b"\\")
        && matches!(line.trim_ascii_start(), [b'v' | b'f' | b'l' | b'p' | b'c' | b's' | b't', ..])
}

impl Read for Feed<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let length = self.fill_buf()?.read(into)?;
        self.consume(length);
        Ok(length)
    }
}

impl BufRead for Feed<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.reading.is_empty() {
            if let Err(error) = self.advance() {
                self.error = Some(error);
                return Err(io::ErrorKind::InvalidData.into());
            }
        }
        Ok(self.current())
    }

    fn consume(&mut self, amount: usize) {
        self.reading.start += amount;
    }
}

/// The faces of the file with the numbers of the file.
fn in_file_order(mesh: &tobj::Mesh, scan: &Scan) -> FaceList {
    let (corners, went_to) = mesh.indices.split_at(scan.corner_count);
    let position = |k: usize| DVec3::from_slice(&mesh.positions[3 * k..]);
    let mut came_from = vec![0; went_to.len()];
    for (k, &place) in went_to.iter().enumerate() {
        came_from[place as usize] = k as u32;
    }
    let mut faces = FaceList::new(went_to.iter().map(|&place| position(place as usize)).collect());
    // tobj leaves the numbers of sides out if all are three.
    let mut sides = mesh.face_arities.iter().map(|&sides| sides as usize);
    let mut face = Vec::new();
    let mut rest = corners;
    for _ in 0..scan.face_count {
        let (here, after) = rest.split_at(sides.next().unwrap_or(3));
        face.clear();
        face.extend(here.iter().map(|&place| came_from[place as usize]));
        faces.push_face(&face);
        rest = after;
    }
    faces
}
