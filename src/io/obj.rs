//! OBJ, read through tobj. Only this file names tobj.
//!
//! tobj reads the vertices. [`Scan`] stands before it: it counts the lines, checks them, passes `v x y z` on and takes the
//! faces itself, for tobj loses the line, the groups and what stands at a corner, and splits shared vertices.
//! tobj drops vertices that no face names and numbers the others by first use. So every thousand of them it is given a
//! face that names them in their order, as an object of its own: one object after the other, they are the vertices of
//! the file.
//!
//! **Deliberately not here**: material files. Their names are kept, they are not opened.

use std::io::{self, BufRead, Read};
use std::ops::Range;

use glam::DVec3;

use super::obj_scan::{Feeding, Scan};
use super::text::{Words, float, normalize, shown};
use super::write;
use super::{Format, Loaded};
use crate::error::{ReadError, ReadErrorKind};

/// Reads the text of an OBJ file.
///
/// Vertex `k` is the `k`-th `v` line, whether a face uses it or not, and the faces are those of the file, of any number
/// of sides, in its order; groups and materials split nothing. Corners may repeat and coordinates may be infinite or no
/// numbers: [`FaceList::defects`](crate::soup::FaceList::defects) tells. An index may point to a line further below. A line that ends in `\` goes on in
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
    // The last face may name one vertex or two, which tobj takes for a point or a line.
    let options = tobj::LoadOptions { ignore_lines: false, ignore_points: false, ..tobj::LoadOptions::default() };
    let answer = tobj::load_obj_buf(&mut feed, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    if let Some(error) = feed.error.take() {
        return Err(error);
    }
    let (models, _) = answer.map_err(|_| feed.blame())?;
    let Scan { mut faces, attributes, tag_lines, notes, vertex_count, .. } = feed.scan;
    faces.positions.reserve_exact(vertex_count);
    for model in &models {
        faces.positions.extend(model.mesh.positions.chunks_exact(3).map(DVec3::from_slice));
    }
    debug_assert_eq!(faces.positions.len(), vertex_count);
    Ok(Loaded { format: Format::Obj, faces, attributes, tag_lines, notes })
}

/// How many vertices one of the added faces names. More would make tobj's hash map outgrow the cache.
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
    /// How many vertices the added faces have named.
    named: usize,
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
            named: 0,
            error: None,
        }
    }

    /// Goes on to the next line that tobj is to see, or to an empty one at the end.
    fn advance(&mut self) -> Result<(), ReadError> {
        if self.scan.vertex_count - self.named == NAMED_AT_ONCE {
            self.name_vertices();
            return Ok(());
        }
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
        self.finish()
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

    /// Checks the whole, and gives tobj a face for the last vertices.
    fn finish(&mut self) -> Result<(), ReadError> {
        if self.scan.vertex_count > self.named {
            self.name_vertices();
            return Ok(());
        }
        if self.scan.vertex_count == 0 {
            let is_empty = self.text.split(|&byte| byte == b'\n').all(|line| Words::new(line).next().is_none());
            return Err(ReadError::whole(if is_empty { ReadErrorKind::Empty } else { ReadErrorKind::NoVertex }));
        }
        self.reading = 0..0;
        self.scan.finish()
    }

    /// Puts a face into the buffer that names the vertices that none has named, counted from the last, and starts a
    /// new object behind it.
    fn name_vertices(&mut self) {
        self.buffer.clear();
        self.buffer.push(b'f');
        for k in (1..=self.scan.vertex_count - self.named).rev() {
            self.buffer.extend_from_slice(b" -");
            write::push_integer(&mut self.buffer, k as u64);
        }
        self.buffer.extend_from_slice(b"\no");
        self.named = self.scan.vertex_count;
        self.show_buffer();
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
