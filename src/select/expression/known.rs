//! The criteria that an expression can name, each with how its arguments are read.

use std::sync::Arc;

use glam::DVec3;

use super::Term;
use super::argument::{Argument, ReadFile};
use crate::angle::Angle;
use crate::error::ExpressionError;
use crate::select::criteria::{All, Dihedral, Disk, Sphere, Vertices};

/// One criterion that can be named.
pub(super) struct Known {
    /// Its name.
    pub(super) name: &'static str,
    /// How it is written.
    pub(super) forms: &'static [&'static str],
    /// How it is made from what stands after its name.
    pub(super) make: Make,
}

/// A criterion, or why there is none.
type Made = Result<Arc<dyn Term>, ExpressionError>;

/// How a criterion is made.
pub(super) enum Make {
    /// From nothing.
    Alone(fn() -> Arc<dyn Term>),
    /// From the text after `:`.
    From(fn(&Argument<'_>, ReadFile<'_>) -> Made),
}

/// All of them, in the order in which messages list them.
pub(super) const KNOWN: &[Known] = &[
    Known { name: "all", forms: &["all"], make: Make::Alone(|| Arc::new(All)) },
    Known { name: "vertices", forms: &["vertices:V,V,...", "vertices:@FILE"], make: Make::From(vertices) },
    Known { name: "disk", forms: &["disk:V,R"], make: Make::From(disk) },
    Known { name: "sphere", forms: &["sphere:x,y,z,radius"], make: Make::From(sphere) },
    Known { name: "dihedral", forms: &["dihedral:DEG"], make: Make::From(dihedral) },
];

impl Known {
    /// The criterion of this name.
    pub(super) fn find(name: &str) -> Option<&'static Self> {
        KNOWN.iter().find(|known| known.name == name)
    }
}

fn vertices(argument: &Argument<'_>, read: ReadFile<'_>) -> Made {
    let vertices: Vertices = match argument.file_ids(read)? {
        Some(ids) => ids.into_iter().collect(),
        None if argument.is_empty() => Vertices::default(),
        None => argument.fields().map(|field| field.vertex("vertex")).collect::<Result<_, _>>()?,
    };
    Ok(Arc::new(vertices))
}

fn disk(argument: &Argument<'_>, _: ReadFile<'_>) -> Made {
    let [center, radius] = argument.exactly()?;
    Ok(Arc::new(Disk::new(center.vertex("V")?, radius.count("R")?)))
}

fn sphere(argument: &Argument<'_>, _: ReadFile<'_>) -> Made {
    let [x, y, z, radius] = argument.exactly()?;
    let center = DVec3::new(x.number("x")?, y.number("y")?, z.number("z")?);
    let sphere = Sphere::new(center, radius.number("radius")?);
    Ok(Arc::new(sphere.map_err(|error| radius.refused(error))?))
}

fn dihedral(argument: &Argument<'_>, _: ReadFile<'_>) -> Made {
    let [above] = argument.exactly()?;
    let dihedral = Dihedral::new(Angle::from_deg(above.number("angle")?));
    Ok(Arc::new(dihedral.map_err(|error| above.refused(error))?))
}
