//! What an OBJ file says of its faces, taken through refinement and back.

use std::collections::HashMap;

use super::normals::{CornerNormals, SideNormals};
use super::{Attributes, Blend, Channel, NormalRule, Seams};
use crate::error::{ConfigError, RefineError};
use crate::id::VertexId;
use crate::io::{FaceAttributes, NO_INDEX};
use crate::limit::{Limit, Normals};
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::soup::FaceList;
use crate::step::History;
use crate::subdivide::{Control, Step, Subdivider};

const TEXTURE: &str = "texture";
const NORMAL: &str = "normal";
const COLOR: &str = "color";
const SECTION: &str = "section";

/// How what an OBJ file says is refined.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ObjRules {
    /// Texture coordinates (`vt`).
    pub texture: Blend,
    /// Texture coordinates at seams.
    pub seams: Seams,
    /// Colours of vertices.
    pub colors: Blend,
    /// Normals (`vn`).
    pub normals: NormalRule,
}

/// What an OBJ file says of the faces of a mesh, on its way through refinement; see the [module](super).
///
/// Texture coordinates are a corner channel, colours a vertex channel. Objects, groups, materials and smoothing groups
/// stay with the faces that descend from theirs, which come in the order of the file's sections. Equal texture
/// coordinates at a vertex are one, whatever their numbers: a seam is where values differ.
///
/// ```
/// use vvmesh::adaptive::Uniform;
/// use vvmesh::attributes::{ObjAttributes, ObjRules};
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider};
/// use vvmesh::{Mesh, io};
///
/// let loaded = io::read_obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 8 0\nvt 0 8\nusemtl red\nf 1/1 2/2 3/3\n")?;
/// let mut mesh = Mesh::from_face_list(&loaded.faces)?;
/// let mut history = History::new(&mesh, Keep::default());
/// let mut obj = ObjAttributes::new(&mesh, &history, &loaded.faces, loaded.attributes, ObjRules::default())?;
/// let subdivider = Subdivider::new(Loop::default(), Uniform);
/// let (all, scratch) = (Selection::empty(), &mut Scratch::new());
/// obj.step(&subdivider, &mut mesh, &mut history, &all, scratch, &mut Control::default())?;
///
/// let (faces, said) = obj.finish(&mesh);
/// let mut text = Vec::new();
/// io::write_obj_with(&mut text, &faces, &said)?;
/// let text = String::from_utf8(text)?;
/// assert!(text.contains("vt 1 1\nvt 6 1\nvt 1 6\nvt 4 0\nvt 0 4\nvt 4 4\nusemtl red\nf 1/1 4/4 5/5\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ObjAttributes {
    /// The triangles of the file, in its order.
    triangles: FaceList,
    /// What it said of them.
    said: FaceAttributes,
    normals: NormalRule,
    attributes: Attributes,
    /// The limit normals, once the positions are at the limit.
    sides: Option<SideNormals>,
    is_refined: bool,
}

/// What refinement does not keep.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct LeftOut {
    /// Triangles with texture coordinates at some of their corners only: they lose them.
    pub partly_textured: usize,
    /// Triangles with normals at some of their corners only: they lose them.
    pub partly_normal: usize,
    /// Texture coordinates that no corner names.
    pub unused_texture: usize,
    /// Vertices without a colour where others have one: what is blended with them has none.
    pub uncolored: usize,
}

/// The triangles of a mesh that lie across what they should keep apart: steps of √3 turn edges of seams, hard edges and
/// borders of groups too, and turn them back with the next step.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Across {
    /// Across seams: they have no texture coordinates.
    pub seams: usize,
    /// Across hard edges: they have no normals.
    pub hard_edges: usize,
    /// Half in one section of the file, half in another: they are with one of them.
    pub sections: usize,
}

impl ObjAttributes {
    /// What is said of the triangles of a list, of which the mesh was made.
    ///
    /// # Errors
    /// If the mesh has not these triangles.
    ///
    /// # Complexity
    /// O(n log n) in the number of faces.
    pub fn new(
        mesh: &Mesh,
        history: &History,
        triangles: &FaceList,
        said: FaceAttributes,
        rules: ObjRules,
    ) -> Result<Self, ConfigError> {
        let corners = file_corners(mesh, triangles)?;
        let mut attributes = Attributes::default();
        if !said.texture_indices.is_empty() {
            let channel = Channel::new(TEXTURE, rules.texture, said.texture_coordinates.clone())?;
            let values = values_at(&corners, &said.texture_indices, &said.texture_coordinates);
            attributes.add_corner_channel(mesh, history, &channel, &values, rules.seams)?;
        }
        if !said.normal_indices.is_empty() && matches!(rules.normals, NormalRule::Keep | NormalRule::Recompute) {
            let normals: Vec<[f64; 3]> = said.normals.iter().map(|normal| normal.to_array()).collect();
            let values = values_at(&corners, &said.normal_indices, &normals);
            // Only its chart is of use.
            let channel = Channel::new(NORMAL, Blend::Nearest, normals)?;
            attributes.add_corner_channel(mesh, history, &channel, &values, Seams::Linear)?;
        }
        if !said.vertex_colors.is_empty() {
            let colors = said.vertex_colors.iter().map(|color| color.unwrap_or([f64::NAN; 3])).collect();
            attributes.add_vertex_channel(mesh, Channel::new(COLOR, rules.colors, colors)?)?;
        }
        if !said.sections.is_empty() {
            // 0 is for faces before the first section.
            let label = |[corner, ..]: &[usize; 3]| said.section_of(corner / 3).map_or(0, |section| section as u32 + 1);
            attributes.add_face_labels(mesh, SECTION, &corners.iter().map(label).collect::<Vec<_>>())?;
        }
        let (triangles, normals) = (triangles.clone(), rules.normals);
        Ok(Self { triangles, said, normals, attributes, sides: None, is_refined: false })
    }

    /// The channels and labels.
    #[must_use]
    pub fn attributes(&self) -> &Attributes {
        &self.attributes
    }

    /// What a step does not keep.
    #[must_use]
    pub fn left_out(&self) -> LeftOut {
        let partly = |indices: &[u32]| {
            let some = |triangle: &&[u32]| {
                let without = triangle.iter().filter(|&&index| index == NO_INDEX).count();
                0 < without && without < triangle.len()
            };
            indices.chunks(3).filter(some).count()
        };
        let mut is_used = vec![false; self.said.texture_coordinates.len()];
        for &index in self.said.texture_indices.iter().filter(|&&index| index != NO_INDEX) {
            is_used[index as usize] = true;
        }
        LeftOut {
            partly_textured: partly(&self.said.texture_indices),
            partly_normal: partly(&self.said.normal_indices),
            unused_texture: is_used.iter().filter(|&&is_used| !is_used).count(),
            uncolored: self.said.vertex_colors.iter().filter(|color| color.is_none()).count(),
        }
    }

    /// The triangles that lie across what they should keep apart. O(faces · steps).
    #[must_use]
    pub fn across(&self, mesh: &Mesh) -> Across {
        let attributes = &self.attributes;
        Across {
            seams: attributes.faces_across_seams(TEXTURE, mesh).unwrap_or(0),
            hard_edges: attributes.faces_across_seams(NORMAL, mesh).unwrap_or(0),
            sections: attributes.faces_across_labels(SECTION, mesh).unwrap_or(0),
        }
    }

    /// The normals that [`NormalRule::Limit`] asks for, once [`ObjAttributes::move_to_limit`] has computed them.
    #[must_use]
    pub fn limit_normals(&self) -> Option<&Normals> {
        self.sides.as_ref().map(SideNormals::normals)
    }

    /// Whether normals of the file give way to others as soon as the mesh changes.
    #[must_use]
    pub fn replaces_normals(&self) -> bool {
        self.normals == NormalRule::Keep && !self.said.normals.is_empty()
    }

    /// Makes a step, and takes everything along: see [`Attributes::step`].
    ///
    /// # Errors
    /// Those of [`Attributes::step`].
    pub fn step(
        &mut self,
        subdivider: &Subdivider,
        mesh: &mut Mesh,
        history: &mut History,
        selection: &Selection,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<Step, RefineError> {
        let step = self.attributes.step(subdivider, mesh, history, selection, scratch, control)?;
        self.is_refined = true;
        Ok(step)
    }

    /// Puts values where infinitely many steps would: see [`Attributes::move_to_limit`]. To be called before the
    /// positions of the mesh are put there: limit normals follow from those before.
    pub fn move_to_limit(&mut self, mesh: &Mesh, limit: &impl Limit) {
        self.attributes.move_to_limit(mesh, limit);
        if let NormalRule::Limit(limit) = self.normals {
            self.sides = Some(SideNormals::new(mesh, limit));
        }
        self.is_refined = true;
    }

    /// The faces of the mesh as it is now, and what is said of them.
    ///
    /// Of a mesh that was not refined these are the triangles of the file in its order, with all that was said of them;
    /// of a refined one those of each section of the file together, in the order of the mesh.
    #[must_use]
    pub fn finish(self, mesh: &Mesh) -> (FaceList, FaceAttributes) {
        let (faces, said) = if self.is_refined { self.refined(mesh) } else { self.as_read(mesh) };
        let ids: Vec<[VertexId; 3]> =
            faces.faces().map(|face| [0, 1, 2].map(|k| VertexId::new(face[k] as usize))).collect();
        let chart = self.attributes.corner_channel(NORMAL).map(|channel| &channel.chart);
        let normals = match self.normals {
            NormalRule::Keep if !self.is_refined => return (faces, said),
            NormalRule::Keep if chart.is_none() => CornerNormals::default(),
            NormalRule::Keep | NormalRule::Recompute => CornerNormals::recomputed(mesh, chart, &ids),
            NormalRule::Limit(limit) => {
                self.sides.unwrap_or_else(|| SideNormals::new(mesh, limit)).at_corners(mesh, &ids)
            }
            NormalRule::Drop => CornerNormals::default(),
        };
        // In OBJ all corners of a face have a normal, or none has.
        let whole = |corners: &[Option<u32>]| {
            let all = corners.iter().all(Option::is_some);
            [0, 1, 2].map(|k| corners[k].filter(|_| all).unwrap_or(NO_INDEX))
        };
        let normal_indices = normals.corners.chunks(3).flat_map(whole).collect();
        (faces, FaceAttributes { normals: normals.values, normal_indices, ..said })
    }

    fn as_read(&self, mesh: &Mesh) -> (FaceList, FaceAttributes) {
        let mut faces = self.triangles.clone();
        faces.positions.copy_from_slice(mesh.positions());
        (faces, self.said.clone())
    }

    fn refined(&self, mesh: &Mesh) -> (FaceList, FaceAttributes) {
        let sections = self.attributes.face_labels(SECTION, mesh).unwrap_or_default();
        let section = |face: usize| sections.get(face).and_then(|label| label.checked_sub(1)).map(|k| k as usize);
        let mut order: Vec<usize> = (0..mesh.face_count()).collect();
        order.sort_by_key(|&face| section(face));
        let triangles: Vec<_> = mesh.triangles().collect();
        let mut faces = FaceList::new(mesh.positions().to_vec());
        for &face in &order {
            faces.push_face(&triangles[face].corners().map(|v| v.index() as u32));
        }
        let mut said = self.said.for_faces(order.iter().map(|&face| section(face)));
        if let Some(channel) = self.attributes.corner_channel(TEXTURE) {
            let at_faces: Vec<_> = channel.faces(mesh).collect();
            said.texture_indices = order.iter().flat_map(|&face| at_faces[face].unwrap_or([NO_INDEX; 3])).collect();
            said.texture_coordinates = channel.values().values().map(three).collect();
        }
        if let Some(colors) = self.attributes.vertex_channel(COLOR) {
            let is_color = |color: &[f64; 3]| !color.iter().any(|value| value.is_nan());
            said.vertex_colors = colors.values().map(three).map(|color| Some(color).filter(is_color)).collect();
        }
        (faces, said)
    }
}

fn three(value: &[f64]) -> [f64; 3] {
    [value[0], value[1], value[2]]
}

/// For each triangle of the mesh the numbers of its corners in a list of the same triangles.
fn file_corners(mesh: &Mesh, list: &FaceList) -> Result<Vec<[usize; 3]>, ConfigError> {
    let mut by_corners = HashMap::with_capacity(list.face_count());
    for (k, face) in list.faces().enumerate() {
        if let [a, b, c] = *face {
            let smallest = (0..3).min_by_key(|&corner| face[corner]).unwrap_or(0);
            let turned = |corner: usize| (corner + smallest) % 3;
            let corners = [a, b, c];
            by_corners.insert([0, 1, 2].map(|j| corners[turned(j)]), [0, 1, 2].map(|j| 3 * k + turned(j)));
        }
    }
    let found = mesh.triangles().map(|triangle| {
        let corners = triangle.corners().map(|v| v.index() as u32);
        by_corners.get(&corners).copied().ok_or_else(|| ConfigError {
            name: "triangles",
            value: format!("a list of {}", list.face_count()),
            expected: format!("those of the mesh; {triangle} is missing"),
        })
    });
    found.collect()
}

/// The numbers of the values at the corners of each triangle. Equal values have one number, the first.
fn values_at(corners: &[[usize; 3]], indices: &[u32], values: &[[f64; 3]]) -> Vec<Option<[u32; 3]>> {
    let mut first = HashMap::with_capacity(values.len());
    // + 0 makes 0 of -0.
    let bits = |value: &[f64; 3]| value.map(|number| (number + 0.0).to_bits());
    let number_of: Vec<u32> = (0..).zip(values).map(|(k, value)| *first.entry(bits(value)).or_insert(k)).collect();
    let at_corner = |corner: usize| number_of.get(indices[corner] as usize).copied();
    let of = |&[a, b, c]: &[usize; 3]| Some([at_corner(a)?, at_corner(b)?, at_corner(c)?]);
    corners.iter().map(of).collect()
}
