//! A recorded stroke as a file: what `--stroke` reads.

use std::fmt::Display;
use std::fs;
use std::path::Path;

use serde::Deserialize;
use vvmesh::error::ConfigError;
use vvmesh::glam::DVec3;
use vvmesh::pick::Ray;
use vvmesh::query::measure::triangle_normal;
use vvmesh::stroke::{Aim, Brush, Event, Radius};
use vvmesh::{Angle, Camera, Mesh, VertexId};

use crate::console::{Failure, refuse};

const FORMAT: &str = "vv stroke";
const VERSION: u32 = 1;

/// What every version says first.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u32,
}

/// A recorded stroke, not yet on a mesh.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StrokeFile {
    #[serde(rename = "format")]
    _format: String,
    #[serde(rename = "version")]
    _version: u32,
    /// Through which points of a screen are seen.
    camera: Option<SavedCamera>,
    /// That of events which name none.
    brush: SavedBrush,
    events: Vec<SavedEvent>,
}

/// One of three radii, the greatest level, and the seconds after which one more is wanted.
#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
struct SavedBrush {
    euclidean: Option<f64>,
    edge_path: Option<f64>,
    edges: Option<usize>,
    level: u8,
    #[serde(default)]
    pace: f64,
}

/// A time, and one of three ways to point at the mesh.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedEvent {
    time: f64,
    ray: Option<SavedRay>,
    /// A point of the picture in pixels, from its upper left corner.
    screen: Option<[f64; 2]>,
    place: Option<SavedPlace>,
    brush: Option<SavedBrush>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedRay {
    origin: [f64; 3],
    direction: [f64; 3],
}

/// A point of a face of the input: its corners, and the weights that they have.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedPlace {
    face: [usize; 3],
    weights: [f64; 3],
}

/// A pinhole camera: its eye, the point in the middle of the picture, what is up in it, the degrees that its height takes, and
/// how many columns and rows it has.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedCamera {
    eye: [f64; 3],
    at: [f64; 3],
    up: [f64; 3],
    fov: f64,
    size: [u32; 2],
}

impl StrokeFile {
    /// What a file says.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let bytes = match fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) => return refused(path, error),
        };
        let header: Header = match serde_json::from_slice(&bytes) {
            Ok(header) => header,
            Err(error) => return refused(path, format_args!("this is no stroke of `vv`: {error}")),
        };
        if header.format != FORMAT {
            return refused(path, "this is no stroke of `vv`");
        }
        if header.version != VERSION {
            let found = header.version;
            return refused(path, format_args!("version {found} of the format is not read, only version {VERSION}"));
        }
        serde_json::from_slice(&bytes).or_else(|error| refused(path, error))
    }

    /// The events on a mesh, in the order of their times. A refusal names the event, counted from 1.
    pub(crate) fn events(&self, path: &Path, mesh: &Mesh) -> Result<Vec<Event>, Failure> {
        let camera = match self.camera.as_ref().map(SavedCamera::check).transpose() {
            Ok(camera) => camera,
            Err(error) => return refused(path, format_args!("camera: {error}")),
        };
        let brush = match self.brush.check() {
            Ok(brush) => brush,
            Err(error) => return refused(path, error),
        };
        let mut before = f64::NEG_INFINITY;
        let mut events = Vec::with_capacity(self.events.len());
        for (number, saved) in (1..).zip(&self.events) {
            let event = saved.check(mesh, camera.as_ref(), brush).and_then(|event| match event.time >= before {
                true => Ok(event),
                false => Err(format!("its time {} is before {before}, that of the event before it", event.time)),
            });
            match event {
                Ok(event) => events.push(event),
                Err(why) => return refused(path, format_args!("event {number}: {why}")),
            }
            before = saved.time;
        }
        Ok(events)
    }
}

impl SavedBrush {
    fn check(&self) -> Result<Brush, String> {
        let radius = match (self.euclidean, self.edge_path, self.edges) {
            (Some(length), None, None) => Radius::Euclidean(length),
            (None, Some(length), None) => Radius::EdgePath(length),
            (None, None, Some(count)) => Radius::Edges(count),
            _ => return Err("a brush has one of `euclidean`, `edge_path` and `edges`".to_owned()),
        };
        Brush::new(radius, self.level, self.pace).map_err(|error| error.to_string())
    }
}

impl SavedEvent {
    fn check(&self, mesh: &Mesh, camera: Option<&Camera>, brush: Brush) -> Result<Event, String> {
        let aim = match (&self.ray, self.screen, &self.place) {
            (Some(ray), None, None) => Aim::Along(ray.check().map_err(|error| error.to_string())?),
            (None, Some(point), None) => {
                let camera = camera.ok_or("`screen` needs a `camera` in the file")?;
                let ray = Ray::new(camera.eye(), camera.direction_through(point));
                Aim::Along(ray.map_err(|error| error.to_string())?)
            }
            (None, None, Some(place)) => Aim::Near(place.check(mesh)?),
            _ => return Err("an event has one of `ray`, `screen` and `place`".to_owned()),
        };
        let brush = self.brush.as_ref().map(SavedBrush::check).transpose()?.unwrap_or(brush);
        Ok(Event { time: self.time, aim, brush })
    }
}

impl SavedCamera {
    fn check(&self) -> Result<Camera, ConfigError> {
        let &Self { eye, at, up, fov, size } = self;
        Camera::new(eye.into(), at.into(), up.into(), Angle::from_deg(fov), size)
    }
}

impl SavedRay {
    fn check(&self) -> Result<Ray, ConfigError> {
        Ray::new(self.origin.into(), self.direction.into())
    }
}

impl SavedPlace {
    /// The normal of the face at the place.
    fn check(&self, mesh: &Mesh) -> Result<Ray, String> {
        let [a, b, c] = self.face;
        let corners = self.face.map(VertexId::try_new);
        let is_face = match corners {
            [Some(a), Some(b), Some(c)] => mesh.rotation().contains(a) && mesh.rotation().left_of(a, b) == Some(c),
            _ => false,
        };
        if !is_face {
            return Err(format!("the mesh has no face {a}, {b}, {c}, counted from 0 and counter-clockwise"));
        }
        let sum: f64 = self.weights.iter().sum();
        if !(self.weights.iter().all(|&weight| weight >= 0.0) && sum > 0.0 && sum.is_finite()) {
            return Err("weights are 0 or more, and not all 0".to_owned());
        }
        let corners = corners.into_iter().flatten().map(|v| mesh.position(v));
        let corners = <[DVec3; 3]>::try_from(corners.collect::<Vec<_>>()).expect("a face has three corners");
        let place = corners.iter().zip(self.weights).map(|(&corner, weight)| corner * (weight / sum)).sum();
        let normal = triangle_normal(corners).ok_or_else(|| format!("the face {a}, {b}, {c} has no area"))?;
        Ray::new(place, normal).map_err(|error| error.to_string())
    }
}

fn refused<T>(path: &Path, why: impl Display) -> Result<T, Failure> {
    refuse(format!("--stroke: {}: {why}", path.display()))
}
