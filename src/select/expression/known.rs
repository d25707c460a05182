//! The criteria that an expression can name, each with how its arguments are read.

use std::sync::Arc;

use glam::DVec3;

use super::Term;
use super::argument::{Argument, ReadFile};
use crate::angle::Angle;
use crate::camera::Camera;
use crate::error::{ConfigError, ExpressionError};
use crate::select::criteria::{
    All, Area, Boundary, Curvature, CurvatureTop, Dihedral, Disk, EdgeLength, Faces, Field, Flatness, Frustum,
    LimitError, MeanCurvature, NormalAngle, NormalCone, PixelArea, PixelLength, Sharp, Silhouette, Sphere, Valence,
    Vertices,
};

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
pub(super) type Made = Result<Arc<dyn Term>, ExpressionError>;

/// How a criterion is made.
pub(super) enum Make {
    /// From nothing.
    Alone(fn() -> Arc<dyn Term>),
    /// From the text after `:`.
    From(fn(&Argument<'_, '_>, ReadFile<'_>) -> Made),
    /// The same of faces, whose numbers mean nothing to a mesh alone.
    Faces(fn(&Argument<'_, '_>, ReadFile<'_>) -> Result<Faces, ExpressionError>),
    /// From the text after `:`, of a field, whose values the mesh has not.
    Field(fn(&Argument<'_, '_>) -> Result<Field, ExpressionError>),
    /// From a camera.
    Seen(fn(Camera) -> Arc<dyn Term>),
    /// From a camera and the text after `:`.
    SeenFrom(fn(Camera, &Argument<'_, '_>) -> Made),
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
    Known { name: "limit-error", forms: &["limit-error:EPS", "limit-error:EPS%"], make: Make::From(limit_error) },
    Known { name: "curvature", forms: &["curvature:K"], make: Make::From(curvature) },
    Known { name: "curvature-top", forms: &["curvature-top:P%"], make: Make::From(curvature_top) },
    Known { name: "mean-curvature", forms: &["mean-curvature:H"], make: Make::From(mean_curvature) },
    Known { name: "normal-cone", forms: &["normal-cone:DEG"], make: Make::From(normal_cone) },
    Known { name: "flatness", forms: &["flatness:L", "flatness:L%"], make: Make::From(flatness) },
    Known { name: "valence", forms: &["valence:N"], make: Make::From(valence) },
    Known { name: "field", forms: &["field:NAME>VALUE"], make: Make::Field(field) },
    Known { name: "edge-length", forms: &["edge-length:L", "edge-length:L%"], make: Make::From(edge_length) },
    Known { name: "boundary", forms: &["boundary"], make: Make::Alone(|| Arc::new(Boundary)) },
    Known { name: "sharp", forms: &["sharp"], make: Make::Alone(|| Arc::new(Sharp)) },
    Known {
        name: "silhouette",
        forms: &["silhouette:eye=x,y,z", "silhouette:dir=x,y,z"],
        make: Make::From(silhouette),
    },
    Known { name: "pixel-length", forms: &["pixel-length:N"], make: Make::SeenFrom(pixel_length) },
    Known { name: "area", forms: &["area:A"], make: Make::From(area) },
    Known { name: "frustum", forms: &["frustum"], make: Make::Seen(|camera| Arc::new(Frustum::new(camera))) },
    Known { name: "pixel-area", forms: &["pixel-area:N"], make: Make::SeenFrom(pixel_area) },
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
    let above = argument.threshold()?;
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

fn limit_error(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    Ok(Arc::new(LimitError::new(above.length("EPS")?)))
}

fn curvature(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    let curvature = Curvature::new(above.number("curvature")?);
    Ok(Arc::new(curvature.map_err(|error| above.refused(error))?))
}

fn curvature_top(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let mut share = argument.threshold()?;
    if !share.take_suffix("%") {
        return Err(share.is_not("percent", "expected a number with `%` behind it"));
    }
    let top = CurvatureTop::new(share.number("percent")?);
    Ok(Arc::new(top.map_err(|error| share.refused(error))?))
}

fn mean_curvature(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    let curvature = MeanCurvature::new(above.number("curvature")?);
    Ok(Arc::new(curvature.map_err(|error| above.refused(error))?))
}

fn normal_cone(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    let cone = NormalCone::new(Angle::from_deg(above.number("angle")?));
    Ok(Arc::new(cone.map_err(|error| above.refused(error))?))
}

fn flatness(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    Ok(Arc::new(Flatness::new(above.length("L")?)))
}

fn valence(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    Ok(Arc::new(Valence::new(above.count("N")?)))
}

fn field(argument: &Argument<'_, '_>) -> Result<Field, ExpressionError> {
    let [compared] = argument.exactly()?;
    let (name, comparison, threshold) = compared.comparison()?;
    Field::new(name, comparison, threshold.number("VALUE")?).map_err(|error| threshold.refused(error))
}

fn edge_length(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    Ok(Arc::new(EdgeLength::new(above.length("L")?)))
}

fn silhouette(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let [mut x, y, z] = argument.exactly()?;
    let make: fn(DVec3) -> Result<Silhouette, ConfigError> = if x.take_key("eye") {
        Silhouette::from_eye
    } else if x.take_key("dir") {
        Silhouette::along
    } else {
        return Err(x.is_not("silhouette", "expected eye=x,y,z or dir=x,y,z"));
    };
    let silhouette = make(DVec3::new(x.number("x")?, y.number("y")?, z.number("z")?));
    Ok(Arc::new(silhouette.map_err(|error| x.refused(error))?))
}

fn pixel_length(camera: Camera, argument: &Argument<'_, '_>) -> Made {
    let above = argument.threshold()?;
    let length = PixelLength::new(camera, above.number("pixels")?);
    Ok(Arc::new(length.map_err(|error| above.refused(error))?))
}

fn area(argument: &Argument<'_, '_>, _: ReadFile<'_>) -> Made {
    let above = argument.threshold()?;
    let area = Area::new(above.number("area")?);
    Ok(Arc::new(area.map_err(|error| above.refused(error))?))
}

fn pixel_area(camera: Camera, argument: &Argument<'_, '_>) -> Made {
    let above = argument.threshold()?;
    let area = PixelArea::new(camera, above.number("pixels")?);
    Ok(Arc::new(area.map_err(|error| above.refused(error))?))
}
