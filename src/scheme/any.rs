//! Any scheme, chosen while the program runs.

use super::{Butterfly, FourEight, Loop, Midpoint, ModifiedButterfly, Reach, Scheme, Sqrt3};
use crate::error::ConfigError;
use crate::step::SplitKind;

/// One of the schemes. The pipeline tells them apart once a step; inside a step everything is static.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "a run has one, and a table at hand is faster")]
pub enum AnyScheme {
    /// [`Loop`].
    Loop(Loop),
    /// [`Butterfly`].
    Butterfly(Butterfly),
    /// [`ModifiedButterfly`].
    ModifiedButterfly(ModifiedButterfly),
    /// [`Midpoint`].
    Midpoint(Midpoint),
    /// [`Sqrt3`].
    Sqrt3(Sqrt3),
    /// [`FourEight`].
    FourEight(FourEight),
}

/// Does the same for whichever [`Scheme`] of the split in four it is, and something else for all others.
macro_rules! with_scheme {
    ($any:expr, $scheme:ident => $do:expr, else $otherwise:expr) => {
        match $any {
            $crate::scheme::AnyScheme::Loop($scheme) => $do,
            $crate::scheme::AnyScheme::Butterfly($scheme) => $do,
            $crate::scheme::AnyScheme::ModifiedButterfly($scheme) => $do,
            $crate::scheme::AnyScheme::Midpoint($scheme) => $do,
            $crate::scheme::AnyScheme::Sqrt3(_) | $crate::scheme::AnyScheme::FourEight(_) => $otherwise,
        }
    };
}
pub(crate) use with_scheme;

impl AnyScheme {
    /// The words for all of them.
    pub const NAMES: [&str; 6] = ["loop", "butterfly", "modified-butterfly", "midpoint", "sqrt3", "four-eight"];

    /// The scheme of this name, as it is by default.
    ///
    /// # Errors
    /// For another name.
    pub fn named(name: &str) -> Result<Self, ConfigError> {
        Ok(match name {
            "loop" => Loop::default().into(),
            "butterfly" => Butterfly.into(),
            "modified-butterfly" => ModifiedButterfly.into(),
            "midpoint" => Midpoint.into(),
            "sqrt3" => Sqrt3::default().into(),
            "four-eight" => FourEight::default().into(),
            _ => {
                let expected = format!("one of {}", Self::NAMES.join(", "));
                return Err(ConfigError { name: "scheme", value: name.into(), expected });
            }
        })
    }

    /// The word for it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Loop(_) => "loop",
            Self::Butterfly(_) => "butterfly",
            Self::ModifiedButterfly(_) => "modified-butterfly",
            Self::Midpoint(_) => "midpoint",
            Self::Sqrt3(_) => "sqrt3",
            Self::FourEight(_) => "four-eight",
        }
    }

    /// How its steps cut triangles.
    #[must_use]
    pub fn split_kind(&self) -> SplitKind {
        match self {
            Self::Loop(_) | Self::Butterfly(_) | Self::ModifiedButterfly(_) | Self::Midpoint(_) => {
                SplitKind::Quadrisect
            }
            Self::Sqrt3(_) => SplitKind::Trisect,
            Self::FourEight(_) => SplitKind::Bisect,
        }
    }

    /// What the position of an odd vertex depends on; `None` unless triangles are split in four.
    #[must_use]
    pub fn reach(&self) -> Option<Reach> {
        with_scheme!(self, scheme => Some(scheme.reach()), else None)
    }

    /// Whether sharp edges and corners change its masks.
    #[must_use]
    pub fn reads_tags(&self) -> bool {
        with_scheme!(self, scheme => scheme.reads_tags(), else false)
    }

    /// Whether semi-sharp edges and vertices blend its masks.
    #[must_use]
    pub fn blends_sharpness(&self) -> bool {
        with_scheme!(self, scheme => scheme.blends_sharpness(), else false)
    }

    /// Whether even vertices move.
    #[must_use]
    pub fn moves_even(&self) -> bool {
        with_scheme!(self, scheme => scheme.moves_even(), else true)
    }
}

macro_rules! from_scheme {
    ($($scheme:ident),*) => {
        $(impl From<$scheme> for AnyScheme {
            fn from(scheme: $scheme) -> Self {
                Self::$scheme(scheme)
            }
        })*
    };
}

from_scheme!(Loop, Butterfly, ModifiedButterfly, Midpoint, Sqrt3, FourEight);
