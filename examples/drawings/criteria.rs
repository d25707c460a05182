//! The pictures of the page on criteria: each on a small model, what it selects and what is refined then.

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::io::ErrorKind;

use vvmesh::adaptive::Simple;
use vvmesh::angle::Angle;
use vvmesh::error::ConfigError;
use vvmesh::glam::DVec3;
use vvmesh::scheme::{Loop, Midpoint};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk, Elements, Expression, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Dynamic, Subdivider};
use vvmesh::{Camera, Edge, Mesh, VertexId, shapes};

use super::canvas::{Canvas, Point, ink};
use super::solid::View;

/// A criterion and the model that shows it.
pub struct Row {
    /// The model.
    pub model: fn() -> Mesh,
    /// The criterion, as it is written.
    pub expression: &'static str,
}

/// One picture each.
pub const ROWS: &[Row] = &[
    Row { model: shapes::icosahedron, expression: "all" },
    Row { model: landscape, expression: "vertices:49,50,51,62,77" },
    Row { model: landscape, expression: "faces:88,89,90,91,114,115" },
    Row { model: landscape, expression: "disk:66,2" },
    Row { model: landscape, expression: "sphere:9,5,1.5,2.5" },
    Row { model: landscape, expression: "dihedral:40" },
    Row { model: landscape, expression: "normal-angle:40" },
    Row { model: landscape, expression: "normal-cone:20" },
    Row { model: landscape, expression: "flatness:2%" },
    Row { model: landscape, expression: "limit-error:1%" },
    Row { model: landscape, expression: "curvature:0.2 & !(boundary & all)" },
    Row { model: landscape, expression: "curvature-top:10% & !(boundary & all)" },
    Row { model: landscape, expression: "mean-curvature:0.25" },
    Row { model: refined, expression: "valence:6" },
    Row { model: landscape, expression: "field:red>0.5" },
    Row { model: globe, expression: "edge-length:12%" },
    Row { model: globe, expression: "area:0.07" },
    Row { model: crater, expression: "boundary" },
    Row { model: tagged, expression: "sharp" },
    Row { model: ring, expression: "silhouette:dir=0.3,-1,0.9" },
    Row { model: landscape, expression: "frustum" },
    Row { model: landscape, expression: "pixel-length:75" },
    Row { model: landscape, expression: "pixel-area:1200" },
];

/// From where all models are seen.
const EYE: DVec3 = DVec3::new(0.3, -1.0, 0.9);

/// Pixels for a model, around it, and for the text below it.
const PANEL: Point = [310.0, 190.0];
const MARGIN: f64 = 12.0;
const TEXT: f64 = 42.0;

impl Row {
    /// The name of the criterion.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.expression.split([':', ' ']).next().unwrap_or_default()
    }

    /// The criterion, with what it needs to be asked of a mesh.
    ///
    /// # Errors
    /// If the text is none.
    pub fn criterion(&self, mesh: &Mesh) -> Result<Expression, Box<dyn Error>> {
        let criterion = Expression::parse_seen(self.expression, camera()?, &mut |_| Err(ErrorKind::NotFound.into()))?;
        let reds = mesh.positions().iter().copied().map(red).collect();
        Ok(criterion.with_fields(&mut |name| (name == "red").then_some(&reds).cloned()))
    }

    /// The picture.
    ///
    /// # Errors
    /// If the criterion is none, or names what the model has not.
    pub fn draw(&self) -> Result<String, Box<dyn Error>> {
        let (mut mesh, mut scratch) = ((self.model)(), Scratch::new());
        let criterion = self.criterion(&mesh)?;
        let selection = criterion.select(&mesh, &mut scratch)?;

        let mut canvas = Canvas::new(2.0 * PANEL[0] + 3.0 * MARGIN, PANEL[1] + 2.0 * MARGIN + TEXT);
        let eye = criterion.uses_camera().then_some(CAMERA_EYE);
        let points = mesh.positions().iter().copied().chain(eye);
        let mut view = View::from(EYE, DVec3::Z).fit(points, [MARGIN; 2], PANEL);
        view.paint(&mut canvas, &mesh, &selection, true);
        if let Some(eye) = eye.map(|eye| view.at(eye)) {
            let rays = corners_of_picture().map(|corner| view.at(corner));
            for (k, &ray) in rays.iter().enumerate() {
                canvas.line([eye, ray], ink::BLUE, 1.5);
                canvas.line([ray, rays[(k + 1) % 4]], ink::BLUE, 1.5);
            }
            canvas.dot(eye, 3.0, ink::BLUE, ink::BLUE);
        }
        let (kind, of) = match selection.elements() {
            Elements::Vertices(_) => ("vertices", mesh.vertex_count()),
            Elements::Edges(_) => ("edges", mesh.edge_count()),
            Elements::Faces(_) => ("faces", mesh.face_count()),
        };
        let [width, below] = [PANEL[0] + MARGIN, PANEL[1] + 2.0 * MARGIN];
        let written = self.expression.replace('&', "&amp;").replace('>', "&gt;");
        canvas.text([width + MARGIN / 2.0, below + 14.0], &written, ink::BLUE);
        let caption = format!("selects {} of {of} {kind}", selection.len());
        canvas.text([0.5 * width + MARGIN / 2.0, below + 34.0], &caption, ink::DARK);

        let mut history = History::new(&mesh, Keep::default());
        let dynamic = Dynamic::new(Loop::default())?;
        dynamic.refine(&mut mesh, &mut history, &selection, 1, &mut scratch, &mut Control::default())?;
        view.origin[0] += width;
        view.paint(&mut canvas, &mesh, &Selection::empty(), false);
        let caption = format!("refined there: {} faces", mesh.face_count());
        canvas.text([1.5 * width + MARGIN / 2.0, below + 34.0], &caption, ink::DARK);
        Ok(canvas.finish())
    }
}

/// The camera of those criteria that look through one; it stands low in front of the landscape.
///
/// # Errors
/// None: all numbers of it are as they should be.
pub fn camera() -> Result<Camera, ConfigError> {
    Camera::new(CAMERA_EYE, CAMERA_AT, DVec3::Z, Angle::from_deg(FIELD_OF_VIEW), [400, 300])
}

const CAMERA_EYE: DVec3 = DVec3::new(7.0, -3.0, 2.0);
const CAMERA_AT: DVec3 = DVec3::new(8.0, 3.0, 0.0);
const FIELD_OF_VIEW: f64 = 35.0;

/// Points before the camera that it sees in the corners of its picture, in turn.
fn corners_of_picture() -> [DVec3; 4] {
    let into = 0.3 * (CAMERA_AT - CAMERA_EYE);
    let up = into.length() * (FIELD_OF_VIEW.to_radians() / 2.0).tan();
    let right = into.cross(DVec3::Z).normalize();
    let upwards = right.cross(into).normalize();
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| CAMERA_EYE + into + up * (4.0 / 3.0 * x * right + y * upwards))
}

/// A plain with a ridge, a hill and a spike: a fold in one direction, a smooth bend in all, and a sharp one in all.
fn landscape() -> Mesh {
    let mut mesh = shapes::grid(13, 8);
    for p in mesh.positions_mut() {
        let ridge = 0.6 * (2.0 - (p.x - 3.0).abs()).max(0.0);
        let hill = 1.8 * (-((p.x - 9.0).powi(2) + (p.y - 5.0).powi(2)) / 4.0).exp();
        let spike = if (p.x, p.y) == (11.0, 1.0) { 1.2 } else { 0.0 };
        p.z = ridge + if hill > 0.02 { hill } else { 0.0 } + spike;
    }
    mesh
}

/// The red of the landscape: a painted stroke.
#[must_use]
pub fn red(point: DVec3) -> f64 {
    (1.5 - (point.y - 4.0 - 2.0 * (0.5 * point.x).sin()).abs()).clamp(0.0, 1.0)
}

/// The landscape with its hill taken out.
fn crater() -> Mesh {
    let whole = landscape();
    let is_kept = |corners: [VertexId; 3]| corners.iter().all(|&v| whole.position(v).z < 1.3);
    let kept = whole.triangles().map(|face| face.corners()).filter(|&corners| is_kept(corners));
    let kept: Vec<[u32; 3]> = kept.map(|corners| corners.map(|v| v.index() as u32)).collect();
    Mesh::from_triangles(whole.positions().to_vec(), &kept).expect("what is left of a mesh is one")
}

/// The landscape with the top of its ridge tagged.
fn tagged() -> Mesh {
    let mut mesh = landscape();
    for y in 0..8 {
        let [a, b] = [14 * y + 3, 14 * (y + 1) + 3].map(VertexId::new);
        assert!(mesh.set_sharp(Edge::new(a, b), true), "the top runs along edges");
    }
    mesh
}

/// The landscape after steps that closed their cracks with edges to old vertices.
fn refined() -> Mesh {
    let mut mesh = landscape();
    let mut history = History::new(&mesh, Keep::default());
    let mut scratch = Scratch::new();
    let disk = Disk::new(VertexId::new(65), 2).select(&mesh, &mut scratch).expect("it has the vertex");
    Subdivider::new(Midpoint, Simple)
        .step(&mut mesh, &mut history, &disk, &mut scratch, &mut Control::default())
        .expect("a small mesh can be refined");
    mesh
}

/// A sphere of radius 1 by longitude and latitude: its faces shrink to the poles.
fn globe() -> Mesh {
    const AROUND: usize = 16;
    const ROWS: usize = 8;
    let mut corners = vec![DVec3::Z];
    for row in 1..ROWS {
        let (radius, z) = (row as f64 / ROWS as f64 * PI).sin_cos();
        for k in 0..AROUND {
            let (sin, cos) = ((k as f64 + 0.5 * row as f64) / AROUND as f64 * TAU).sin_cos();
            corners.push(DVec3::new(radius * cos, radius * sin, z));
        }
    }
    corners.push(-DVec3::Z);
    let at = |row: usize, k: usize| (1 + row * AROUND + k % AROUND) as u32;
    let last = corners.len() as u32 - 1;
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for k in 0..AROUND {
        triangles.push([0, at(0, k), at(0, k + 1)]);
        for row in 0..ROWS - 2 {
            let [a, b, c, d] = [at(row, k), at(row, k + 1), at(row + 1, k), at(row + 1, k + 1)];
            triangles.extend([[a, c, b], [b, c, d]]);
        }
        triangles.push([last, at(ROWS - 2, k + 1), at(ROWS - 2, k)]);
    }
    Mesh::from_triangles(corners, &triangles).expect("a sphere is a mesh")
}

fn ring() -> Mesh {
    shapes::torus(18, 10, 2.0, 0.9)
}
