//! One scan over an OBJ file before tobj: it checks what tobj lets pass and records what tobj loses.
//!
//! tobj is given plain lines `v x y z` only, so it neither splits the file at groups and materials, nor divides by
//! weights, nor takes polylines for faces. Where a line is such already it is passed on as it stands.
//!
//! **Deliberately not here**: the coordinates of vertices; those tobj reads.

use std::collections::HashSet;
use std::sync::Arc;

use glam::DVec3;

use super::attributes::{FaceAttributes, NO_INDEX, Section, State};
use super::notes::{self, Note, NoteKind};
use super::obj_tags::TagLines;
use super::text::{Words, float, integer, shown};
use crate::error::{ReadError, ReadErrorKind};
use crate::id::VertexId;
use crate::soup::FaceList;

const VERTEX: &str = "vertex";
const TEXTURE: &str = "texture coordinate";
const NORMAL: &str = "normal";

/// What of a line goes to tobj.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Feeding {
    /// Nothing.
    Nothing,
    /// The whole line.
    Whole,
    /// So many bytes from its start.
    Head(usize),
}

/// The state of the scan, and at its end the result.
#[derive(Default)]
pub(super) struct Scan {
    pub(super) vertex_count: usize,
    /// The faces, as yet without positions.
    pub(super) faces: FaceList,
    corner_count: usize,
    /// The corners of the face at hand.
    corners: Vec<u32>,
    pub(super) attributes: FaceAttributes,
    pub(super) tag_lines: TagLines,
    pub(super) notes: Vec<Note>,
    names: HashSet<Arc<str>>,
    state: State,
    /// Whether a line said something of the state since the last face.
    state_was_told: bool,
    /// The greatest index of each sort and its line: a face may name what comes later, so it is checked at the end.
    greatest: [(usize, usize); 3],
}

impl Scan {
    /// Takes in one line; `number` is its number.
    #[inline]
    pub(super) fn line(&mut self, line: &[u8], number: usize) -> Result<Feeding, ReadError> {
        let mut words = Words::new(line);
        let Some(keyword) = words.next() else { return Ok(Feeding::Nothing) };
        let done = match keyword {
            b"v" => self.vertex(words, number),
            b"f" => self.face(words, number).map(|()| Feeding::Nothing),
            _ => self.other(keyword, words, number).map(|()| Feeding::Nothing),
        };
        done.map_err(|kind| ReadError::at(number, kind))
    }

    /// Checks what can only be checked at the end.
    pub(super) fn finish(&mut self) -> Result<(), ReadError> {
        let counts = [self.vertex_count, self.attributes.texture_coordinates.len(), self.attributes.normals.len()];
        for (k, of) in [VERTEX, TEXTURE, NORMAL].into_iter().enumerate() {
            let (index, line) = self.greatest[k];
            if index > counts[k] {
                let kind = ReadErrorKind::IndexOutOfRange { of, index: index as i64, count: counts[k] };
                return Err(ReadError::at(line, kind));
            }
        }
        let attributes = &mut self.attributes;
        for indices in [&mut attributes.texture_indices, &mut attributes.normal_indices] {
            if !indices.is_empty() {
                indices.resize(self.corner_count, NO_INDEX);
            }
        }
        if !attributes.vertex_colors.is_empty() {
            attributes.vertex_colors.resize(self.vertex_count, None);
        }
        Ok(())
    }

    fn vertex(&mut self, mut words: Words<'_>, line: usize) -> Result<Feeding, ReadErrorKind> {
        let mut found = 0;
        let mut ends = [0; 3];
        let mut more = words.clone();
        while let Some(word) = words.next() {
            // tobj splits at the blanks of Unicode too: it must not find other words than are counted here.
            if !word.is_ascii() {
                return Err(ReadErrorKind::NotANumber(shown(word)));
            }
            if found < 3 {
                ends[found] = words.end();
                more = words.clone();
            }
            found += 1;
        }
        match found {
            3 => {}
            4 => {
                more.next().map(float).transpose()?;
                notes::count(&mut self.notes, NoteKind::Weights, line);
            }
            6 | 7 => {
                let mut color = [0.0; 3];
                for (value, word) in color.iter_mut().zip(&mut more) {
                    *value = float(word)?;
                }
                more.next().map(float).transpose()?;
                notes::count(&mut self.notes, NoteKind::VertexColors { kept: true }, line);
                self.attributes.vertex_colors.resize(self.vertex_count, None);
                self.attributes.vertex_colors.push(Some(color));
            }
            _ => return Err(ReadErrorKind::NumberCount { of: "a vertex", expected: "3, 4, 6 or 7", found }),
        }
        if self.vertex_count > VertexId::MAX_INDEX {
            return Err(ReadErrorKind::TooMany("vertices"));
        }
        self.vertex_count += 1;
        let whole = found == 3 && words.next_is_end();
        Ok(if whole { Feeding::Whole } else { Feeding::Head(ends[2]) })
    }

    fn face(&mut self, words: Words<'_>, line: usize) -> Result<(), ReadErrorKind> {
        if std::mem::take(&mut self.state_was_told) {
            self.start_section();
        }
        self.corners.clear();
        for word in words {
            let corner = self.corner(word, line)?;
            self.corners.push(corner);
            self.corner_count += 1;
        }
        if self.corners.len() < 3 {
            return Err(ReadErrorKind::TooFewCorners(self.corners.len()));
        }
        if u32::try_from(self.corner_count).is_err() {
            return Err(ReadErrorKind::TooMany("corners of faces"));
        }
        self.faces.push_face(&self.corners);
        Ok(())
    }

    /// Starts a section at the next face, unless it would be like the one before: a file may say `g` at each face.
    fn start_section(&mut self) {
        let sections = &mut self.attributes.sections;
        if sections.last().map_or(self.state != State::default(), |last| last.state != self.state) {
            sections.push(Section { first_face: self.faces.face_count(), state: self.state.clone() });
        }
    }

    /// A corner `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[inline]
    fn corner(&mut self, word: &[u8], line: usize) -> Result<u32, ReadErrorKind> {
        let mut parts = word.split(|&byte| byte == b'/');
        let vertex = parts.next().unwrap_or_default();
        let corner = self.resolve(0, vertex, self.vertex_count, line)?;
        if vertex.len() == word.len() {
            return Ok(corner);
        }
        if let Some(texture) = parts.next().filter(|part| !part.is_empty()) {
            let index = self.resolve(1, texture, self.attributes.texture_coordinates.len(), line)?;
            self.attributes.texture_indices.resize(self.corner_count, NO_INDEX);
            self.attributes.texture_indices.push(index);
        }
        if let Some(normal) = parts.next().filter(|part| !part.is_empty()) {
            let index = self.resolve(2, normal, self.attributes.normals.len(), line)?;
            self.attributes.normal_indices.resize(self.corner_count, NO_INDEX);
            self.attributes.normal_indices.push(index);
        }
        if parts.next().is_some() {
            return Err(ReadErrorKind::NotAnInteger(shown(word)));
        }
        Ok(corner)
    }

    /// An index from 0, of the `sort` vertex, texture coordinate or normal, of which there are `count` so far.
    #[inline]
    fn resolve(&mut self, sort: usize, word: &[u8], count: usize, line: usize) -> Result<u32, ReadErrorKind> {
        let of = [VERTEX, TEXTURE, NORMAL][sort];
        let index = integer(word)?;
        let from_one = if index < 0 { count as i64 + index + 1 } else { index };
        if index == 0 {
            return Err(ReadErrorKind::IndexZero { of });
        }
        if from_one <= 0 || from_one > i64::from(u32::MAX) {
            return Err(ReadErrorKind::IndexOutOfRange { of, index, count });
        }
        if from_one as usize > self.greatest[sort].0 {
            self.greatest[sort] = (from_one as usize, line);
        }
        Ok((from_one - 1) as u32)
    }

    fn other(&mut self, keyword: &[u8], mut words: Words<'_>, line: usize) -> Result<(), ReadErrorKind> {
        match keyword {
            b"vt" => {
                let (values, found) = numbers(&mut words)?;
                if !(1..=3).contains(&found) {
                    return Err(ReadErrorKind::NumberCount { of: "a texture coordinate", expected: "1 to 3", found });
                }
                self.attributes.texture_coordinates.push(values);
            }
            b"vn" => {
                let (values, found) = numbers(&mut words)?;
                if found != 3 {
                    return Err(ReadErrorKind::NumberCount { of: "a normal", expected: "3", found });
                }
                self.attributes.normals.push(DVec3::from(values));
            }
            b"o" | b"g" | b"usemtl" | b"s" => self.tell_state(keyword, words, line),
            b"mtllib" => self.attributes.material_libraries.push(words.rest().into_owned()),
            b"t" => {
                notes::count(&mut self.notes, NoteKind::Tags, line);
                self.tag_lines.push(line, words.rest().into_owned());
            }
            b"l" => notes::count(&mut self.notes, NoteKind::Polylines, line),
            b"p" => notes::count(&mut self.notes, NoteKind::Points, line),
            b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm" | b"trim"
            | b"hole" | b"scrv" | b"sp" | b"end" | b"con" => notes::count(&mut self.notes, NoteKind::FreeForm, line),
            b"mg" | b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"maplib" | b"usemap" | b"shadow_obj"
            | b"trace_obj" | b"ctech" | b"stech" => notes::count(&mut self.notes, NoteKind::Rendering, line),
            _ => notes::count(&mut self.notes, NoteKind::Unknown(shown(keyword)), line),
        }
        Ok(())
    }

    fn tell_state(&mut self, keyword: &[u8], mut words: Words<'_>, line: usize) {
        self.state_was_told = true;
        match keyword {
            b"o" => self.state.object = self.name(&words.rest()),
            b"usemtl" => self.state.material = self.name(&words.rest()),
            b"g" => self.state.groups = words.filter_map(|word| self.name(&String::from_utf8_lossy(word))).collect(),
            _ => match words.next() {
                None | Some(b"off") => self.state.smoothing = 0,
                Some(word) => match integer(word).ok().and_then(|group| u32::try_from(group).ok()) {
                    Some(group) => self.state.smoothing = group,
                    None => notes::count(&mut self.notes, NoteKind::Unknown(format!("s {}", shown(word))), line),
                },
            },
        }
    }

    fn name(&mut self, name: &str) -> Option<Arc<str>> {
        if name.is_empty() {
            return None;
        }
        if let Some(known) = self.names.get(name) {
            return Some(Arc::clone(known));
        }
        let name: Arc<str> = name.into();
        self.names.insert(Arc::clone(&name));
        Some(name)
    }
}

/// The numbers of a line: the first three, and how many there are.
fn numbers(words: &mut Words<'_>) -> Result<([f64; 3], usize), ReadErrorKind> {
    let mut values = [0.0; 3];
    let mut found = 0;
    for word in words {
        let value = float(word)?;
        if let Some(slot) = values.get_mut(found) {
            *slot = value;
        }
        found += 1;
    }
    Ok((values, found))
}
