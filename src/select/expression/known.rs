//! The criteria that an expression can name, each with how its arguments are read.

use std::sync::Arc;

use glam::DVec3;

use super::Term;
use super::argument::{Argument, ReadFile};
use crate::angle::Angle;
use crate::error::ExpressionError;
use crate::select::criteria::{All, Dihedral, Disk, Faces, NormalAngle, Sphere, Vertices};

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
    From(fn(&Argument<'_, '_>, ReadFile<'_>) -> Made),
    /// The same of faces, whose numbers mean nothing to a mesh alone.
    Faces(fn(&Argument<'_, '_>, ReadFile<'_>) -> Result<Faces, ExpressionError>),
}

/// All of them, in the order in which messages list them.
pub(super) const KNOWN: &[Known] = &[
    Known { name: "all", forms: &["all"], make: Make::Alone(|| Arc::new(All)) },
    Known { name: "vertices", forms: &["vertices:V,V,...", "vertices:@FILE"], make: Make::From(vertices) },
    Known { name: "disk", forms: &["disk:V,R"], make: Make::From(disk) },
    Known { name: "sphere", forms: &["sphere:x,y,z,radius"], make: Make::From(sphere) },
    Known { name: "dihedral", forms: &["dihedral:DEG"], make: Make::From(dihedral) },
    Known { name: "faces", forms: &["faces:F,F,...", "faces:@FILE"], make: Make::Faces(faces) },
    Known {
        name: "normal-angle",
        forms: &["normal-angle:DEG", "normal-angle:DEG+neighbors"],
        make: Make::From(normal_angle),
    },
];

impl Known {
    /// The criterion of this name.
    pub(super) fn find(name: &str) -> Option<&'static Self> {
        KNOWN.iter().find(|known| known.name == name)
    }
}

fn vertices(argument: &Argument<'_, '_>, read: ReadFile<'_>) -> Made {
    Ok(Arc::new(argument.ids(read)?.into_iter().collect::<Vertices>()))
}

fn faces(argument: &Argument<'_, '_>, read: ReadFile<'_>) -> Result<Faces, ExpressionError> {
    Ok(Faces::new(argument.ids(read)?))
}

fn disk(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let [center, radius] = argument.exactly()?;
    Ok(Arc::new(Disk::new(center.vertex("V")?, radius.count("R")?)))
}

fn sphere(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let [x, y, z, radius] = argument.exactly()?;
    let center = DVec3::new(x.number("x")?, y.number("y")?, z.number("z")?);
    let sphere = Sphere::new(center, radius.number("radius")?);
    Ok(Arc::new(sphere.map_err(|error| radius.refused(error))?))
}

fn dihedral(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let [above] = argument.exactly()?;
    let above = above.at_level()?;
    let dihedral = Dihedral::new(Angle::from_deg(above.number("angle")?));
    Ok(Arc::new(dihedral.map_err(|error| above.refused(error))?))
}

fn normal_angle(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let [mut above] = argument.exactly()?;
    let and_neighbors = above.take_suffix("+neighbors");
    let above = above.at_level()?;
    let normal_angle = NormalAngle::new(Angle::from_deg(above.number("angle")?));
    let normal_angle = normal_angle.map_err(|error| above.refused(error))?;
    Ok(Arc::new(if and_neighbors { normal_angle.and_neighbors() } else { normal_angle }))
}
