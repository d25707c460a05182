//! Any scheme, chosen while the program runs.

use super::{Butterfly, Loop, Midpoint, ModifiedButterfly, Reach, Scheme};

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
}

/// Does the same for whichever scheme it is.
macro_rules! with_scheme {
    ($any:expr, $scheme:ident => $do:expr) => {
        match $any {
            $crate::scheme::AnyScheme::Loop($scheme) => $do,
            $crate::scheme::AnyScheme::Butterfly($scheme) => $do,
            $crate::scheme::AnyScheme::ModifiedButterfly($scheme) => $do,
            $crate::scheme::AnyScheme::Midpoint($scheme) => $do,
        }
    };
}
pub(crate) use with_scheme;

impl AnyScheme {
    /// What the position of an odd vertex depends on.
    #[must_use]
    pub fn reach(&self) -> Reach {
        with_scheme!(self, scheme => scheme.reach())
    }

    /// Whether sharp edges and corners change its masks.
    #[must_use]
    pub fn reads_tags(&self) -> bool {
        with_scheme!(self, scheme => scheme.reads_tags())
    }

    /// Whether even vertices move.
    #[must_use]
    pub fn moves_even(&self) -> bool {
        with_scheme!(self, scheme => scheme.moves_even())
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

from_scheme!(Loop, Butterfly, ModifiedButterfly, Midpoint);
