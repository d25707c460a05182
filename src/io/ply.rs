//! PLY, read through serde-ply. Only this file and [`Plan`]'s name it.
//!
//! serde-ply reads the header, and hands over every value of every row with the type that the header gives it; a [`Plan`]
//! says which values are wanted. It allocates nothing on the word of the header, and neither does this file. It knows no
//! lines; [`Prepared`] stands before it and knows them.
//!
//! **Deliberately not here**: triangle strips, materials and whatever else an element may hold. They are passed over, and
//! told.

use std::fmt;
use std::io::{self, Cursor};

use glam::DVec3;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_ply::{ElementDef, PlyReader, PropertyType};

use super::attributes::{FaceAttributes, NO_INDEX};
use super::notes::Note;
use super::obj_tags::TagLines;
use super::ply_plan::{COLOR, NORMAL, Plan, Role, SLOTS, Sort, TEXTURE};
use super::ply_prepared::Prepared;
use super::text::shown;
use super::{Format, Loaded};
use crate::error::{ReadError, ReadErrorKind};
use crate::id::VertexId;
use crate::soup::FaceList;

/// Reads a PLY file: as text, or binary in either order of bytes.
///
/// Vertex `k` is the `k`-th of the element `vertex`, at its properties `x`, `y`, `z`; the faces are those of the element
/// `face`, with the corners of its list `vertex_indices` or `vertex_index`. A number has the type that the header says:
/// `0.1` as a `float` is the nearest number of single precision.
///
/// Kept as attributes are normals (`nx`, `ny`, `nz`), colours (`red`, `green`, `blue`; whole numbers become parts of the
/// greatest) and texture coordinates of vertices (`s`, `t`; `u`, `v`; `texture_u`, `texture_v`) or of corners (the list
/// `texcoord` of a face, which wins). All else is told in the notes and ignored, but for comments.
///
/// # Errors
/// With the line, behind the header of a binary file with the byte: a header that is not as it should be, counts that
/// do not fit what follows (the end comes too early, or more comes), a value that does not fit its type, an index out
/// of range, a face of fewer than three corners. Without: an empty file.
///
/// # Complexity
/// O(bytes), in time and space: nothing is reserved on the word of the header.
///
/// ```
/// let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n\
///     property float quality\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
///     0 0 0 7\n1 0 0 7\n0 0.1 0 7\n3 0 1 2\n";
/// let loaded = vvmesh::io::read_ply(text.as_bytes())?;
/// assert_eq!((loaded.faces.face(0), loaded.faces.positions[2].y), (&[0, 1, 2][..], 0.1));
/// assert_eq!(loaded.notes[0].to_string(), "property 'quality' of 3 vertices ignored (line 3)");
/// let error = vvmesh::io::read_ply(text.replace("3 0 1 2", "3 0 1 3").as_bytes()).unwrap_err();
/// assert_eq!(error.to_string(), "line 14: index out of range: vertex 3, there are 3");
/// # Ok::<(), vvmesh::error::ReadError>(())
/// ```
pub fn read_ply(bytes: &[u8]) -> Result<Loaded, ReadError> {
    let prepared = Prepared::new(bytes)?;
    let mut cursor = Cursor::new(&prepared.data[..]);
    let mut reading = Reading::default();
    let done = reading.all(&prepared, &mut cursor);
    let read = cursor.position() as usize;
    let done = done.and_then(|()| prepared.nothing_follows(read));
    done.map_err(|kind| prepared.at(read, kind))?;
    let Reading { faces, attributes, notes, .. } = reading;
    Ok(Loaded { format: Format::Ply, faces, attributes, tag_lines: TagLines::default(), notes })
}

/// What has been read.
#[derive(Default)]
struct Reading {
    faces: FaceList,
    attributes: FaceAttributes,
    notes: Vec<Note>,
    /// As the header has it.
    vertex_count: usize,
    /// The row at hand, from 1, and its property, from 0.
    row: usize,
    property: usize,
    slots: [f64; SLOTS],
    corners: Vec<u32>,
    corner_count: usize,
    texture: Vec<f64>,
    /// Why this file, and not serde-ply, stops reading.
    refusal: Option<ReadErrorKind>,
}

impl Reading {
    fn all(&mut self, prepared: &Prepared<'_>, cursor: &mut Cursor<&[u8]>) -> Result<(), ReadErrorKind> {
        let mut reader = &mut PlyReader::from_reader(&mut *cursor).map_err(|error| match error.0.kind() {
            io::ErrorKind::InvalidData => ReadErrorKind::Header(error.0.to_string()),
            _ => ReadErrorKind::Io(error.0),
        })?;
        prepared.tell_of_header(&mut self.notes);
        let elements = reader.header().elem_defs.clone();
        let plans = Plan::all(&elements)?;
        let Some(vertices) = plans.iter().find(|plan| plan.sort == Sort::Vertex) else {
            return Err(ReadErrorKind::Header("there is no element vertex".to_owned()));
        };
        self.vertex_count = vertices.element.count;
        if self.vertex_count > VertexId::MAX_INDEX + 1 {
            return Err(ReadErrorKind::TooMany("vertices"));
        }
        for (k, plan) in plans.iter().enumerate() {
            plan.tell(prepared.line_of_element(k), &mut self.notes);
            if plan.sort == Sort::Vertex {
                // A row takes a byte at least for each of its values.
                let possible = (prepared.data.len() - prepared.body) / plan.roles.len();
                self.faces.positions.reserve_exact(plan.element.count.min(possible));
            }
            self.row = 0;
            if let Err(error) = reader.next_value_seed(Rows { reading: self, plan }) {
                let word = |cursor: &Cursor<&[u8]>| shown(prepared.last_word(cursor.position() as usize));
                return Err(self.refusal.take().unwrap_or_else(|| self.reason(plan, error.0, word(cursor))));
            }
        }
        self.finish(vertices.has(Role::Slot(TEXTURE)));
        Ok(())
    }

    /// Why serde-ply stopped, `word` being the last that it read.
    fn reason(&self, plan: &Plan<'_>, error: io::Error, word: String) -> ReadErrorKind {
        let ElementDef { name, count, properties } = plan.element;
        match (error.kind(), properties.get(self.property)) {
            (io::ErrorKind::UnexpectedEof, _) => {
                ReadErrorKind::UnexpectedEnd(format!("{} {} of {count}", shown(name.as_bytes()), self.row))
            }
            (io::ErrorKind::InvalidData, Some(property)) => {
                let of = match property.property_type {
                    PropertyType::Scalar(of) => of.to_string(),
                    PropertyType::List { count_type, data_type } => {
                        format!("list of {data_type}, counted in {count_type}")
                    }
                };
                let property = format!("{} ({of})", shown(property.name.as_bytes()));
                // Any bytes are a number; no word stands for them.
                let found = if word.is_empty() { "a length below 0".to_owned() } else { word };
                ReadErrorKind::NotOfType { property, found }
            }
            _ => ReadErrorKind::Io(error),
        }
    }

    /// Takes in the row that was read.
    #[inline]
    fn take_row(&mut self, plan: &Plan<'_>) -> Result<(), ReadErrorKind> {
        match plan.sort {
            Sort::Vertex => self.vertex(plan),
            Sort::Face => return self.face(plan),
            Sort::Other => {}
        }
        Ok(())
    }

    fn vertex(&mut self, plan: &Plan<'_>) {
        let [x, y, z, nx, ny, nz, r, g, b, s, t] = self.slots;
        self.faces.positions.push(DVec3::new(x, y, z));
        if plan.has(Role::Slot(NORMAL)) {
            self.attributes.normals.push(DVec3::new(nx, ny, nz));
        }
        if plan.has(Role::Slot(COLOR)) {
            let [one_r, one_g, one_b] = plan.one;
            self.attributes.vertex_colors.push(Some([r / one_r, g / one_g, b / one_b]));
        }
        if plan.has(Role::Slot(TEXTURE)) {
            self.attributes.texture_coordinates.push([s, t, 0.0]);
        }
    }

    fn face(&mut self, plan: &Plan<'_>) -> Result<(), ReadErrorKind> {
        if self.corners.len() < 3 {
            return Err(ReadErrorKind::TooFewCorners(self.corners.len()));
        }
        self.corner_count += self.corners.len();
        if u32::try_from(self.corner_count).is_err() {
            return Err(ReadErrorKind::TooMany("corners of faces"));
        }
        self.faces.push_face(&self.corners);
        if plan.has(Role::Texture) {
            let FaceAttributes { texture_coordinates, texture_indices, .. } = &mut self.attributes;
            if self.texture.len() == 2 * self.corners.len() {
                let first = texture_coordinates.len() as u32;
                texture_indices.extend((first..).take(self.corners.len()));
                texture_coordinates.extend(self.texture.chunks_exact(2).map(|values| [values[0], values[1], 0.0]));
            } else {
                texture_indices.resize(self.corner_count, NO_INDEX);
                if !self.texture.is_empty() {
                    let found = self.texture.len();
                    return Err(ReadErrorKind::NumberCount { of: "texcoord", expected: "2 for each corner", found });
                }
            }
        }
        Ok(())
    }

    /// What vertices have, their corners have.
    fn finish(&mut self, vertices_have_texture: bool) {
        let corners = || self.faces.faces().flatten().copied().collect();
        if vertices_have_texture {
            self.attributes.texture_indices = corners();
        }
        if self.attributes.texture_coordinates.is_empty() {
            self.attributes.texture_indices.clear();
        }
        if !self.attributes.normals.is_empty() {
            self.attributes.normal_indices = corners();
        }
    }
}

/// The rows of an element.
struct Rows<'r, 'p> {
    reading: &'r mut Reading,
    plan: &'p Plan<'p>,
}

impl<'de> DeserializeSeed<'de> for Rows<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, rows: D) -> Result<(), D::Error> {
        rows.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Rows<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("rows")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut rows: A) -> Result<(), A::Error> {
        let Self { reading, plan } = self;
        // Rows of nothing take no bytes, so there may be any number of them.
        while !plan.roles.is_empty() {
            reading.row += 1;
            if rows.next_element_seed(Row { reading, plan })?.is_none() {
                break;
            }
        }
        Ok(())
    }
}

/// One row: the values of its properties in the order of the header.
struct Row<'r, 'p> {
    reading: &'r mut Reading,
    plan: &'p Plan<'p>,
}

impl<'de> DeserializeSeed<'de> for Row<'_, '_> {
    type Value = ();

    #[inline]
    fn deserialize<D: Deserializer<'de>>(self, row: D) -> Result<(), D::Error> {
        row.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Row<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a row")
    }

    #[inline]
    fn visit_map<A: MapAccess<'de>>(self, mut row: A) -> Result<(), A::Error> {
        let Self { reading, plan } = self;
        for (k, &role) in plan.roles.iter().enumerate() {
            reading.property = k;
            row.next_key::<IgnoredAny>()?;
            match role {
                Role::Slot(slot) => reading.slots[slot] = row.next_value()?,
                Role::Corners => row.next_value_seed(Corners(reading))?,
                Role::Texture => {
                    reading.texture.clear();
                    row.next_value_seed(Numbers(&mut reading.texture))?;
                }
                Role::Ignored => drop(row.next_value::<IgnoredAny>()?),
            }
        }
        reading.take_row(plan).map_err(|kind| refuse(reading, kind))
    }
}

/// Stops serde-ply for a reason of ours.
fn refuse<E: Error>(reading: &mut Reading, kind: ReadErrorKind) -> E {
    reading.refusal = Some(kind);
    E::custom("refused")
}

/// The corners of a face, each checked when it is read, so that an error has its place.
struct Corners<'r>(&'r mut Reading);

impl<'de> DeserializeSeed<'de> for Corners<'_> {
    type Value = ();

    #[inline]
    fn deserialize<D: Deserializer<'de>>(self, list: D) -> Result<(), D::Error> {
        list.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Corners<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("indices of vertices")
    }

    #[inline]
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Self(reading) = self;
        reading.corners.clear();
        while let Some(index) = list.next_element::<i64>()? {
            let count = reading.vertex_count;
            if !usize::try_from(index).is_ok_and(|index| index < count) {
                return Err(refuse(reading, ReadErrorKind::IndexOutOfRange { of: "vertex", index, count }));
            }
            reading.corners.push(index as u32);
        }
        Ok(())
    }
}

/// A list of numbers.
struct Numbers<'r>(&'r mut Vec<f64>);

impl<'de> DeserializeSeed<'de> for Numbers<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, list: D) -> Result<(), D::Error> {
        list.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Numbers<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while let Some(value) = list.next_element()? {
            self.0.push(value);
        }
        Ok(())
    }
}
