//! What stands at the faces of a file beside their corners: groups, materials, texture coordinates, normals.

use std::ops::Range;

use glam::DVec3;

/// What an OBJ file says about its faces beside their corners, by the number of the face in the file.
///
/// Names are stored once. Runs of faces with the same groups, object, material and smoothing are one entry, so this
/// costs next to nothing for files without them. Reading OFF leaves it empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceAttributes {
    /// Values of `vt` lines in order; a missing second or third value is 0.
    pub texture_coordinates: Vec<[f64; 3]>,
    /// Values of `vn` lines in order.
    pub normals: Vec<DVec3>,
    /// Colours (red, green, blue, mostly 0 to 1) by vertex, `None` for one without; empty if no vertex has one.
    pub vertex_colors: Vec<Option<[f64; 3]>>,
    /// File names of `mtllib` lines in order. The files are not opened.
    pub material_libraries: Vec<String>,
    pub(super) names: Vec<String>,
    /// Lists of group names, one after the other.
    pub(super) group_lists: Vec<NameId>,
    pub(super) sections: Vec<Section>,
    /// By corner, or empty if no corner has one.
    pub(super) texture_indices: Vec<u32>,
    pub(super) normal_indices: Vec<u32>,
}

/// The place of a name among the names.
pub(super) type NameId = u32;

/// In place of an index of a corner that has none.
pub(super) const NO_INDEX: u32 = u32::MAX;

/// What holds from one face on, until the next section.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Section {
    pub(super) first_face: usize,
    pub(super) state: State,
}

/// What `o`, `g`, `usemtl` and `s` lines set.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct State {
    pub(super) object: Option<NameId>,
    /// Where in the lists of group names.
    pub(super) groups: Range<usize>,
    pub(super) material: Option<NameId>,
    pub(super) smoothing: u32,
}

impl FaceAttributes {
    /// The object a face belongs to. O(log sections), as are the next three.
    #[must_use]
    pub fn object(&self, face: usize) -> Option<&str> {
        self.name(self.state(face)?.object)
    }

    /// The groups a face belongs to, in the order of the file.
    pub fn groups(&self, face: usize) -> impl ExactSizeIterator<Item = &str> + Clone {
        let range = self.state(face).map_or(0..0, |state| state.groups.clone());
        self.group_lists[range].iter().map(|&name| self.names[name as usize].as_str())
    }

    /// The material of a face.
    #[must_use]
    pub fn material(&self, face: usize) -> Option<&str> {
        self.name(self.state(face)?.material)
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
        self.texture_indices.get(corner).filter(|&&index| index != NO_INDEX).map(|&index| index as usize)
    }

    /// Which of the [`normals`](Self::normals) a corner has; corners are counted through all faces.
    #[must_use]
    pub fn normal_index(&self, corner: usize) -> Option<usize> {
        self.normal_indices.get(corner).filter(|&&index| index != NO_INDEX).map(|&index| index as usize)
    }

    /// Whether nothing was said.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    fn state(&self, face: usize) -> Option<&State> {
        let after = self.sections.partition_point(|section| section.first_face <= face);
        Some(&self.sections[after.checked_sub(1)?].state)
    }

    fn name(&self, id: Option<NameId>) -> Option<&str> {
        id.map(|id| self.names[id as usize].as_str())
    }
}
