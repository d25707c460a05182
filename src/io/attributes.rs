//! What stands at the faces of a file beside their corners: groups, materials, texture coordinates, normals.

use std::sync::Arc;

use glam::DVec3;

use super::Format;
use crate::soup::{FaceList, Triangulation};

/// What an OBJ or PLY file says about its faces beside their corners, by the number of the face in the file.
///
/// Names are stored once. Runs of faces with the same groups, object, material and smoothing are one entry, so this
/// costs next to nothing for files without them. Reading OFF and STL leaves it empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceAttributes {
    /// Values of `vt` lines in order; a missing second or third value is 0. Of PLY, those of the vertices or corners.
    pub texture_coordinates: Vec<[f64; 3]>,
    /// Values of `vn` lines in order; of PLY, those of the vertices.
    pub normals: Vec<DVec3>,
    /// Colours (red, green, blue, mostly 0 to 1) by vertex, `None` for one without; empty if no vertex has one.
    pub vertex_colors: Vec<Option<[f64; 3]>>,
    /// File names of `mtllib` lines in order. The files are not opened.
    pub material_libraries: Vec<String>,
    /// Ascending by face, each unlike the one before.
    pub(crate) sections: Vec<Section>,
    /// By corner, or empty if no corner has one.
    pub(crate) texture_indices: Vec<u32>,
    pub(crate) normal_indices: Vec<u32>,
}

/// In place of an index of a corner that has none.
pub(crate) const NO_INDEX: u32 = u32::MAX;

/// What holds from one face on, until the next section.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Section {
    pub(super) first_face: usize,
    pub(super) state: State,
}

/// What `o`, `g`, `usemtl` and `s` lines set. Equal names are one text in memory.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct State {
    pub(super) object: Option<Arc<str>>,
    pub(super) groups: Arc<[Arc<str>]>,
    pub(super) material: Option<Arc<str>>,
    pub(super) smoothing: u32,
}

impl FaceAttributes {
    /// The object a face belongs to. O(log sections), as are the next three.
    #[must_use]
    pub fn object(&self, face: usize) -> Option<&str> {
        self.state(face)?.object.as_deref()
    }

    /// The groups a face belongs to, in the order of the file.
    pub fn groups(&self, face: usize) -> impl ExactSizeIterator<Item = &str> + Clone {
        self.state(face).map_or(&[][..], |state| &state.groups).iter().map(|name| &**name)
    }

    /// The material of a face.
    #[must_use]
    pub fn material(&self, face: usize) -> Option<&str> {
        self.state(face)?.material.as_deref()
    }

    /// The smoothing group of a face, 0 for none.
    #[must_use]
    pub fn smoothing_group(&self, face: usize) -> u32 {
        self.state(face).map_or(0, |state| state.smoothing)
    }

    /// Which of the [`texture_coordinates`](Self::texture_coordinates) a corner has.
    ///
    /// Corners are counted through all faces: see [`FaceList::corner_range`](crate::soup::FaceList::corner_range).
    #[must_use]
    pub fn texture_index(&self, corner: usize) -> Option<usize> {
        index(&self.texture_indices, corner)
    }

    /// Which of the [`normals`](Self::normals) a corner has; corners are counted through all faces.
    #[must_use]
    pub fn normal_index(&self, corner: usize) -> Option<usize> {
        index(&self.normal_indices, corner)
    }

    /// Whether nothing was said.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What of it a file of a format has a place for: all in OBJ, colours and texture coordinates of two values in PLY,
    /// nothing in others.
    #[must_use]
    pub fn held_by(self, format: Format) -> Self {
        match format {
            Format::Obj => self,
            Format::Ply => {
                let Self { vertex_colors, texture_indices, mut texture_coordinates, .. } = self;
                if texture_indices.is_empty() {
                    texture_coordinates.clear();
                }
                texture_coordinates.iter_mut().for_each(|values| values[2] = 0.0);
                Self { vertex_colors, texture_indices, texture_coordinates, ..Self::default() }
            }
            Format::Off | Format::Stl => Self::default(),
        }
    }

    /// The same for the triangles into which the faces of a list were [cut](FaceList::triangulate): a triangle has what
    /// its face has, and each of its corners what the corner of the face has. O(corners).
    ///
    /// ```
    /// let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng quad\nf 1/1 2/2 3/3 4/4\n";
    /// let loaded = vvmesh::io::read_obj(text)?;
    /// let cut = loaded.faces.triangulate();
    /// let attributes = loaded.attributes.of_triangles(&loaded.faces, &cut);
    /// assert_eq!(cut.triangles, [[0, 1, 2], [0, 2, 3]]);
    /// assert!((0..6).map(|corner| attributes.texture_index(corner).unwrap()).eq([0, 1, 2, 0, 2, 3]));
    /// assert!(attributes.groups(1).eq(["quad"]));
    /// # Ok::<(), vvmesh::error::ReadError>(())
    /// ```
    #[must_use]
    pub fn of_triangles(&self, faces: &FaceList, cut: &Triangulation) -> Self {
        let at_corners = |indices: &[u32]| -> Vec<u32> {
            if indices.is_empty() {
                return Vec::new();
            }
            let of = |(&face, triangle): (&u32, &[u32; 3])| {
                let corners = faces.corner_range(face as usize);
                let place = |v: &u32| faces.face(face as usize).iter().position(|w| w == v);
                triangle.map(|v| place(&v).and_then(|k| indices.get(corners.start + k)).copied().unwrap_or(NO_INDEX))
            };
            cut.face_of.iter().zip(&cut.triangles).flat_map(of).collect()
        };
        let first_triangle = |face: usize| cut.face_of.partition_point(|&of| (of as usize) < face);
        let section = |section: &Section| Section {
            first_face: first_triangle(section.first_face),
            state: section.state.clone(),
        };
        Self {
            texture_coordinates: self.texture_coordinates.clone(),
            normals: self.normals.clone(),
            vertex_colors: self.vertex_colors.clone(),
            material_libraries: self.material_libraries.clone(),
            sections: self.sections.iter().map(section).collect(),
            texture_indices: at_corners(&self.texture_indices),
            normal_indices: at_corners(&self.normal_indices),
        }
    }

    /// What is left for other faces that stand in these sections, ascending; `None` is before the first. What belongs
    /// to corners and vertices is left out.
    pub(crate) fn for_faces(&self, sections: impl Iterator<Item = Option<usize>>) -> Self {
        let mut kept: Vec<Section> = Vec::new();
        let mut last = None;
        for (first_face, section) in sections.enumerate() {
            if let Some(section) = section.filter(|_| section != last) {
                kept.push(Section { first_face, state: self.sections[section].state.clone() });
            }
            last = section;
        }
        Self { material_libraries: self.material_libraries.clone(), sections: kept, ..Self::default() }
    }

    /// The place of the section that a face is in; `None` before the first.
    pub(crate) fn section_of(&self, face: usize) -> Option<usize> {
        self.sections.partition_point(|section| section.first_face <= face).checked_sub(1)
    }

    fn state(&self, face: usize) -> Option<&State> {
        self.section_of(face).map(|section| &self.sections[section].state)
    }
}

fn index(indices: &[u32], corner: usize) -> Option<usize> {
    indices.get(corner).filter(|&&index| index != NO_INDEX).map(|&index| index as usize)
}
