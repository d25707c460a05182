//! Values that ride along: a name, some numbers each, and how new ones are made.

use glam::DVec4;

use crate::error::ConfigError;
use crate::id::VertexId;
use crate::scheme::WeightedSum;
use crate::step::SplitKind;
use crate::subdivide::{Follower, StepMasks, ValueId, Values};

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
    /// With 0 for the numbers that a value has not.
    values: Values<DVec4>,
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
        let four = |value: [f64; N]| {
            let mut numbers = [0.0; 4];
            numbers[..N].copy_from_slice(&value);
            DVec4::from(numbers)
        };
        let values = Values::new(values.into_iter().map(four).collect());
        Ok(Self { name: name.into(), blend, components: N, values })
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
        self.values.shown().len()
    }

    /// Whether there is no value.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.shown().is_empty()
    }

    /// The numbers of one value.
    ///
    /// # Panics
    /// If there are not so many values.
    #[must_use]
    pub fn value(&self, index: usize) -> &[f64] {
        &self.values.shown()[index].as_ref()[..self.components]
    }

    /// All values in order.
    pub fn values(&self) -> impl ExactSizeIterator<Item = &[f64]> + Clone {
        self.values.shown().iter().map(|value| &value.as_ref()[..self.components])
    }

    /// The same channel with the values at these places, which may repeat.
    pub(super) fn gathered(&self, places: &[u32]) -> Self {
        let values = Values::new(places.iter().map(|&place| self.values.shown()[place as usize]).collect());
        Self { values, name: self.name.clone(), ..*self }
    }

    /// A value, with 0 for the numbers it has not.
    #[inline]
    pub(super) fn at(&self, id: impl Into<ValueId>) -> DVec4 {
        *self.values.get(id.into())
    }

    /// What takes a mask and makes the value that it says of the present ones.
    #[inline]
    pub(super) fn sum(&self) -> WeightedSum<DVec4, impl Fn(VertexId) -> DVec4> {
        WeightedSum::new(|v: VertexId| self.values.shown()[v.index()])
    }

    /// The value of a new vertex made of these old ones, the older first, where it does not follow the scheme.
    pub(super) fn without_mask(&self, parents: &[VertexId], kind: SplitKind) -> DVec4 {
        match (self.blend, parents) {
            (Blend::Nearest, _) => self.at(parents[0]),
            // A trisection splits boundary edges in three.
            (_, &[near, far]) if kind == SplitKind::Trisect => (2.0 * self.at(near) + self.at(far)) / 3.0,
            _ => parents.iter().map(|&v| self.at(v)).sum::<DVec4>() / parents.len() as f64,
        }
    }

    /// Gives vertices new values by masks of the old ones, if this follows the scheme.
    pub(super) fn move_by(
        &mut self,
        vertices: impl Iterator<Item = VertexId>,
        value: impl Fn(&Self, VertexId) -> Option<DVec4>,
    ) {
        if self.blend != Blend::Scheme {
            return;
        }
        let moved: Vec<_> = vertices.filter_map(|v| Some((v, value(self, v)?))).collect();
        moved.into_iter().for_each(|(v, value)| self.set(v, value));
    }

    pub(super) fn set(&mut self, v: VertexId, value: DVec4) {
        self.put(v.into(), Some(value));
    }

    /// Puts a value in its place; `None` takes a kept one away.
    pub(super) fn put(&mut self, id: ValueId, value: Option<DVec4>) {
        self.values.put(id, value);
    }

    pub(super) fn push(&mut self, value: DVec4) {
        self.values.push(value);
    }

    /// Makes room for the new vertices of a step.
    pub(super) fn grow(&mut self, step: &StepMasks<'_>) {
        self.values.grow(step, DVec4::NAN);
    }

    /// Whether it needs no kept values or has some.
    pub(super) fn has_kept(&self) -> bool {
        self.blend != Blend::Scheme || self.values.has_kept()
    }
}
