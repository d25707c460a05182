//! Values that ride along: a name, some numbers each, and how new ones are made.

use glam::DVec4;

use crate::error::ConfigError;
use crate::id::VertexId;
use crate::scheme::Mask;
use crate::step::SplitKind;

/// How the values of new vertices are made, and whether those of old vertices change.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Blend {
    /// By the masks of the scheme, as positions are: old values change if the scheme moves old vertices, and weights
    /// below zero (of Butterfly) may lead out of the range of the old values.
    #[default]
    Scheme,
    /// The mean of what a vertex is made of: of the ends of an edge, of the corners of a triangle. Old values stay.
    Linear,
    /// The value of the first that a vertex is made of: of an edge the older end (see [`Parent`](crate::step::Parent)).
    /// Old values stay, and no other value ever appears: for labels, and whatever else has no mean.
    Nearest,
}

/// A named list of values of 1 to 4 numbers each.
///
/// A number may be NaN for "none"; what is made of it is NaN too.
#[derive(Clone, PartialEq, Debug)]
pub struct Channel {
    name: String,
    blend: Blend,
    components: usize,
    /// All numbers of the first value, then of the next.
    numbers: Vec<f64>,
}

impl Channel {
    /// A channel of these values.
    ///
    /// # Errors
    /// If a value has none or more than 4 numbers.
    ///
    /// ```
    /// use vvmesh::attributes::{Blend, Channel};
    /// let heat = Channel::new("heat", Blend::Linear, vec![[20.0], [21.5]])?;
    /// assert_eq!((heat.len(), heat.components(), heat.value(1)), (2, 1, &[21.5][..]));
    /// assert!(Channel::new("nothing", Blend::Linear, vec![[]; 2]).is_err());
    /// # Ok::<(), vvmesh::error::ConfigError>(())
    /// ```
    pub fn new<const N: usize>(
        name: impl Into<String>,
        blend: Blend,
        values: Vec<[f64; N]>,
    ) -> Result<Self, ConfigError> {
        if !(1..=4).contains(&N) {
            return Err(ConfigError { name: "components", value: N.to_string(), expected: "1 to 4".into() });
        }
        Ok(Self { name: name.into(), blend, components: N, numbers: values.into_flattened() })
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How new values are made.
    #[must_use]
    pub fn blend(&self) -> Blend {
        self.blend
    }

    /// How many numbers a value has.
    #[must_use]
    pub fn components(&self) -> usize {
        self.components
    }

    /// How many values there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.numbers.len() / self.components
    }

    /// Whether there is no value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// The numbers of one value.
    ///
    /// # Panics
    /// If there are not so many values.
    #[must_use]
    pub fn value(&self, index: usize) -> &[f64] {
        &self.numbers[index * self.components..][..self.components]
    }

    /// All values in order.
    pub fn values(&self) -> impl ExactSizeIterator<Item = &[f64]> + Clone {
        self.numbers.chunks_exact(self.components)
    }

    /// The same channel with the values at these places, which may repeat.
    pub(super) fn gathered(&self, places: &[u32]) -> Self {
        let numbers = places.iter().flat_map(|&place| self.value(place as usize)).copied().collect();
        Self { numbers, name: self.name.clone(), ..*self }
    }

    /// A value, with 0 for the numbers it has not.
    #[inline]
    pub(super) fn at(&self, v: VertexId) -> DVec4 {
        let mut value = [0.0; 4];
        value[..self.components].copy_from_slice(self.value(v.index()));
        value.into()
    }

    /// The value of a new vertex with this mask, made of these old ones, the older first.
    pub(super) fn odd(&self, mask: &Mask, parents: &[VertexId], kind: SplitKind) -> DVec4 {
        match (self.blend, parents) {
            (Blend::Scheme, _) => mask.apply(|v| self.at(v)),
            (Blend::Nearest, _) => self.at(parents[0]),
            // A trisection splits boundary edges in three.
            (Blend::Linear, &[near, far]) if kind == SplitKind::Trisect => (2.0 * self.at(near) + self.at(far)) / 3.0,
            (Blend::Linear, _) => parents.iter().map(|&v| self.at(v)).sum::<DVec4>() / parents.len() as f64,
        }
    }

    /// Gives vertices new values by masks of the old ones, if this follows the scheme.
    pub(super) fn move_by(
        &mut self,
        vertices: impl Iterator<Item = VertexId>,
        mut write: impl FnMut(VertexId, &mut Mask),
    ) {
        if self.blend != Blend::Scheme {
            return;
        }
        let mut mask = Mask::default();
        let mut moved = Vec::new();
        for v in vertices {
            mask.clear();
            write(v, &mut mask);
            moved.push((v, mask.apply(|w| self.at(w))));
        }
        moved.into_iter().for_each(|(v, value)| self.set(v, value));
    }

    pub(super) fn set(&mut self, v: VertexId, value: DVec4) {
        let start = v.index() * self.components;
        self.numbers[start..start + self.components].copy_from_slice(&value.to_array()[..self.components]);
    }

    pub(super) fn push(&mut self, value: DVec4) {
        self.numbers.extend_from_slice(&value.to_array()[..self.components]);
    }
}
