//! What is wanted of the elements that the header of a PLY file names, and what is told of the rest.
//!
//! **Deliberately not here**: the values.

use serde_ply::{ElementDef, PlyProperty, PropertyType, ScalarType};

use super::notes::{Note, NoteKind};
use super::text::shown;
use crate::error::ReadErrorKind;

/// How many values of a vertex are wanted at most, and where each sort of them begins.
pub(super) const SLOTS: usize = 11;
const POSITION: usize = 0;
pub(super) const NORMAL: usize = 3;
pub(super) const COLOR: usize = 6;
pub(super) const TEXTURE: usize = 9;

/// Properties of a vertex that belong together, and the slot of the first.
const SETS: [(&[&str], usize); 8] = [
    (&["x", "y", "z"], POSITION),
    (&["nx", "ny", "nz"], NORMAL),
    (&["red", "green", "blue"], COLOR),
    (&["diffuse_red", "diffuse_green", "diffuse_blue"], COLOR),
    (&["s", "t"], TEXTURE),
    (&["u", "v"], TEXTURE),
    (&["texture_u", "texture_v"], TEXTURE),
    (&["texture_s", "texture_t"], TEXTURE),
];

/// What is done with a property.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Its value goes to this slot.
    Slot(usize),
    /// It is the list of the corners of a face.
    Corners,
    /// It is the list of their texture coordinates.
    Texture,
    /// It is passed over.
    Ignored,
}

/// What an element is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Sort {
    Vertex,
    Face,
    Other,
}

/// What is done with an element and its properties.
pub(super) struct Plan<'a> {
    pub(super) element: &'a ElementDef,
    pub(super) sort: Sort,
    pub(super) roles: Vec<Role>,
    /// The value that stands for 1 in each colour.
    pub(super) one: [f64; 3],
}

impl<'a> Plan<'a> {
    /// A plan for each element.
    pub(super) fn all(elements: &'a [ElementDef]) -> Result<Vec<Self>, ReadErrorKind> {
        let mut plans = Vec::with_capacity(elements.len());
        for (k, element) in elements.iter().enumerate() {
            refuse_uncounted(element)?;
            let is_first = elements[..k].iter().all(|before| before.name != element.name);
            plans.push(match element.name.as_str() {
                "vertex" if is_first => Self::of_vertex(element)?,
                "face" if is_first => Self::of_face(element)?,
                _ => Self::new(element, Sort::Other),
            });
        }
        if plans.iter().any(|plan| plan.has(Role::Texture)) {
            // What stands at a corner says more than what stands at its vertex.
            let at_vertices = plans.iter_mut().flat_map(|plan| &mut plan.roles);
            at_vertices.filter(|role| matches!(role, Role::Slot(TEXTURE..))).for_each(|role| *role = Role::Ignored);
        }
        Ok(plans)
    }

    fn new(element: &'a ElementDef, sort: Sort) -> Self {
        Self { element, sort, roles: vec![Role::Ignored; element.properties.len()], one: [1.0; 3] }
    }

    fn of_vertex(element: &'a ElementDef) -> Result<Self, ReadErrorKind> {
        let mut plan = Self::new(element, Sort::Vertex);
        let scalar = |name: &str| {
            let is_it = |property: &PlyProperty| property.name == name && scalar_type(property).is_some();
            element.properties.iter().position(is_it)
        };
        for (names, first) in SETS {
            let places: Vec<usize> = names.iter().filter_map(|name| scalar(name)).collect();
            if places.len() == names.len() && !plan.has(Role::Slot(first)) {
                for (k, &place) in places.iter().enumerate() {
                    plan.roles[place] = Role::Slot(first + k);
                    if first == COLOR {
                        plan.one[k] = scalar_type(&element.properties[place]).map_or(1.0, greatest);
                    }
                }
            }
        }
        if !plan.has(Role::Slot(POSITION)) {
            return Err(ReadErrorKind::Header("the element vertex has not all of the properties x, y, z".to_owned()));
        }
        Ok(plan)
    }

    fn of_face(element: &'a ElementDef) -> Result<Self, ReadErrorKind> {
        let mut plan = Self::new(element, Sort::Face);
        for (property, role) in element.properties.iter().zip(&mut plan.roles) {
            let PropertyType::List { data_type, .. } = property.property_type else { continue };
            *role = match property.name.as_str() {
                "vertex_indices" | "vertex_index" => Role::Corners,
                "texcoord" => Role::Texture,
                _ => Role::Ignored,
            };
            if *role == Role::Corners && is_float(data_type) {
                return Err(ReadErrorKind::Header(format!(
                    "indices are whole numbers, {} are {data_type}",
                    property.name
                )));
            }
        }
        match plan.roles.iter().filter(|role| **role == Role::Corners).count() {
            1 => Ok(plan),
            _ => Err(ReadErrorKind::Header("the element face has not one list vertex_indices".to_owned())),
        }
    }

    pub(super) fn has(&self, role: Role) -> bool {
        self.roles.contains(&role)
    }

    /// Tells what of the element is ignored, and that colours are kept.
    pub(super) fn tell(&self, line: usize, notes: &mut Vec<Note>) {
        let Self { element: ElementDef { name, count, properties }, sort, roles, .. } = self;
        let mut tell = |kind| notes.push(Note { kind, count: *count, line });
        if *count == 0 {
            return;
        }
        if *sort == Sort::Other {
            return tell(NoteKind::Element(shown(name.as_bytes())));
        }
        if self.has(Role::Slot(COLOR)) {
            tell(NoteKind::VertexColors { kept: true });
        }
        let ignored = properties.iter().zip(roles).filter(|(_, role)| **role == Role::Ignored);
        let names: Vec<String> = ignored.map(|(property, _)| shown(property.name.as_bytes())).collect();
        if !names.is_empty() {
            tell(NoteKind::Properties { of: if *sort == Sort::Face { "face" } else { "vertex" }, names });
        }
    }
}

/// Refuses lists whose lengths are no whole numbers.
fn refuse_uncounted(element: &ElementDef) -> Result<(), ReadErrorKind> {
    let is_uncounted = |property: &&PlyProperty| match property.property_type {
        PropertyType::List { count_type, .. } => is_float(count_type),
        PropertyType::Scalar(_) => false,
    };
    match element.properties.iter().find(is_uncounted) {
        Some(PlyProperty { name, .. }) => {
            let name = shown(name.as_bytes());
            Err(ReadErrorKind::Header(format!("lists are counted in whole numbers, {name} is not")))
        }
        None => Ok(()),
    }
}

fn scalar_type(property: &PlyProperty) -> Option<ScalarType> {
    match property.property_type {
        PropertyType::Scalar(of) => Some(of),
        PropertyType::List { .. } => None,
    }
}

fn is_float(of: ScalarType) -> bool {
    matches!(of, ScalarType::F32 | ScalarType::F64)
}

/// The value that stands for 1 in a colour.
fn greatest(of: ScalarType) -> f64 {
    match of {
        ScalarType::I8 => i8::MAX.into(),
        ScalarType::U8 => u8::MAX.into(),
        ScalarType::I16 => i16::MAX.into(),
        ScalarType::U16 => u16::MAX.into(),
        ScalarType::I32 => i32::MAX.into(),
        ScalarType::U32 => u32::MAX.into(),
        ScalarType::F32 | ScalarType::F64 => 1.0,
    }
}
