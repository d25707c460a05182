//! `vv predict`: how deep and how large for an accuracy, without refining.

use std::fmt::Write;

use serde::Serialize;
use vvmesh::adaptive::Uniform;
use vvmesh::predict::{DistanceBound, Estimate, FullSize, Measured, Rate};
use vvmesh::scheme::{Loop, LoopWeights};
use vvmesh::step::Keep;
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Accuracy, Mesh};

use crate::Outcome;
use crate::args::{MethodName, PredictArguments, loop_weights};
use crate::console::{Failure, note, print, print_json, refuse};
use crate::input::Input;
use crate::memory::FaceLimit;
use crate::progress::Bar;
use crate::run::Run;
use crate::table::{Table, count};
use crate::{input, sharp};

/// Into how many parts a side of a face is cut when distances are measured.
const DIVISIONS: u32 = 4;

#[derive(Serialize)]
struct Prediction {
    m0: f64,
    max_valence: usize,
    n: usize,
    contraction: f64,
    depth: u32,
    full_faces: u64,
    vertex_depths: Vec<u64>,
    vertex_depths_raw: Vec<u64>,
    face_depths: Vec<u64>,
    adaptive_bound: u64,
    memory_bytes: u64,
    rigorous: Rigorous,
    /// At the depth of `rigorous`.
    measured: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    budget: Option<Budget>,
}

#[derive(Serialize)]
struct Rigorous {
    depth: u32,
    full_faces: u64,
    bound: f64,
}

/// The finest accuracies that a number of faces allows.
#[derive(Serialize)]
struct Budget {
    faces: u64,
    full_accuracy: f64,
    adaptive_accuracy: f64,
    rigorous_accuracy: f64,
}

/// What a mesh is predicted from.
struct Foretold<'a> {
    mesh: &'a Mesh,
    estimate: Estimate<'a>,
    bound: DistanceBound,
}

pub(crate) fn run(arguments: &PredictArguments) -> Result<Outcome, Failure> {
    let path = &arguments.mesh;
    let Input { mut mesh, tags, .. } = input::read_mesh(path, arguments.tags.of_mesh.is_some())?;
    sharp::tag(&mut mesh, path, tags.as_ref(), &arguments.tags)?;
    let weights = loop_weights(arguments.weights);
    let foretold =
        Foretold { mesh: &mesh, estimate: Estimate::new(&mesh, weights)?, bound: DistanceBound::new(&mesh, weights)? };
    let budget = arguments.budget.map(|faces| foretold.budget(faces)).transpose()?;
    let mut prediction = foretold.prediction(arguments.accuracy, budget)?;
    let at_estimate = match arguments.verify {
        true => {
            let depths = [prediction.depth, prediction.rigorous.depth];
            let [at_estimate, at_rigorous] = measure(&mesh, weights, depths, prediction.rigorous.full_faces)?;
            note(format_args!(
                "measured at {} points of each face; at depth {}, that of the estimate, the distance is {at_estimate:e}",
                (DIVISIONS + 1) * (DIVISIONS + 2) / 2,
                prediction.depth
            ));
            prediction.measured = Some(at_rigorous);
            Some(at_estimate)
        }
        false => None,
    };
    if arguments.json {
        print_json(&prediction)?;
    } else {
        print(&text(&mesh, arguments, &prediction, at_estimate))?;
    }
    Ok(Outcome::Done)
}

impl Foretold<'_> {
    fn prediction(&self, accuracy: Accuracy, budget: Option<Budget>) -> Result<Prediction, Failure> {
        let Self { mesh, estimate, bound } = self;
        let depth = estimate.depth(accuracy);
        let too_fine =
            || Failure(format!("--accuracy {:e} asks for more faces than can be counted", accuracy.distance()));
        let size = FullSize::new(mesh, depth).ok_or_else(too_fine)?;
        let adaptive_bound = estimate.adaptive_bound(accuracy).ok_or_else(too_fine)?;
        let Some(proven) = bound.depth(accuracy) else {
            return refuse(format!(
                "--accuracy {:e} cannot be proven for any depth: numbers of this size are rounded by more; \
                 the finest is {:e}",
                accuracy.distance(),
                bound.at(u32::MAX)
            ));
        };
        let full_faces = FullSize::new(mesh, proven).ok_or_else(too_fine)?.faces;
        Ok(Prediction {
            m0: estimate.greatest_distance(),
            max_valence: estimate.max_valence(),
            n: estimate.n(),
            contraction: estimate.contraction(),
            depth,
            full_faces: size.faces,
            vertex_depths: estimate.vertex_depths(accuracy, Rate::WithNewVertices),
            vertex_depths_raw: estimate.vertex_depths(accuracy, Rate::OwnValence),
            face_depths: estimate.face_depths(accuracy),
            adaptive_bound,
            memory_bytes: size.memory_bytes,
            rigorous: Rigorous { depth: proven, full_faces, bound: bound.at(proven) },
            measured: None,
            budget,
        })
    }

    fn budget(&self, faces: u64) -> Result<Budget, Failure> {
        let Self { mesh, estimate, bound } = self;
        let full = |depth| FullSize::new(mesh, depth).map(|size| size.faces);
        let finest = |needed: &dyn Fn(Accuracy) -> Option<u64>| {
            Accuracy::finest(|accuracy| needed(accuracy).is_some_and(|needed| needed <= faces)).map(Accuracy::distance)
        };
        let found = [
            finest(&|accuracy| full(estimate.depth(accuracy))),
            finest(&|accuracy| estimate.adaptive_bound(accuracy)),
            finest(&|accuracy| bound.depth(accuracy).and_then(full)),
        ];
        let [Some(full_accuracy), Some(adaptive_accuracy), Some(rigorous_accuracy)] = found else {
            let there = count(mesh.face_count(), "face", "faces");
            return refuse(format!("--budget {faces}: the mesh has {there} already"));
        };
        Ok(Budget { faces, full_accuracy, adaptive_accuracy, rigorous_accuracy })
    }
}

/// The greatest distances found at two depths, the second of which makes so many faces.
fn measure(mesh: &Mesh, weights: LoopWeights, depths: [u32; 2], faces: u64) -> Result<[f64; 2], Failure> {
    let limit = FaceLimit::new(None, MethodName::Uniform);
    if !limit.holds(faces) {
        return refuse(format!(
            "--verify would make {faces} faces, and the free memory holds about {}; ask for a coarser --accuracy",
            limit.faces
        ));
    }
    let mut bar = Bar::new();
    let mut run = Run::new(mesh.clone(), Subdivider::new(Loop::new(weights), Uniform), Keep::default());
    let mut found = [0.0; 2];
    for depth in 0..=depths[0].max(depths[1]) {
        if depth > 0 {
            run.step(&mut Control::default())?;
        }
        if depths.contains(&depth) {
            bar.show_stage(format!("measuring at depth {depth}"));
            let distance = Measured::new(&run.mesh, weights, DIVISIONS)?.distance;
            found.iter_mut().zip(depths).filter(|(_, of)| *of == depth).for_each(|(found, _)| *found = distance);
        }
    }
    bar.hide();
    Ok(found)
}

fn text(mesh: &Mesh, arguments: &PredictArguments, prediction: &Prediction, at_estimate: Option<f64>) -> String {
    let Prediction { m0, max_valence, contraction, depth, rigorous, .. } = prediction;
    let mut text = format!(
        "{}: {}, {}, greatest valence {max_valence}; for an accuracy of {}\n\n",
        arguments.mesh.display(),
        count(mesh.vertex_count(), "vertex", "vertices"),
        count(mesh.face_count(), "face", "faces"),
        arguments.accuracy.distance()
    );
    let number = |value: f64| format!("{value:.4e}");
    let measured = |value: Option<f64>| value.map(number);
    let estimated = m0 * contraction.powi(i32::try_from(*depth).unwrap_or(i32::MAX));
    let mut headers = vec!["", "depth", "faces", "distance"];
    headers.extend(at_estimate.map(|_| "measured"));
    let mut table = Table::new(&headers);
    for (name, depth, faces, distance, measured) in [
        ("estimated", *depth, prediction.full_faces, number(estimated), measured(at_estimate)),
        ("proven", rigorous.depth, rigorous.full_faces, number(rigorous.bound), measured(prediction.measured)),
    ] {
        let mut row = vec![name.to_owned(), depth.to_string(), faces.to_string(), distance];
        row.extend(measured);
        table.row(&row);
    }
    let _ = write!(
        text,
        "{table}\nThe estimate can be too small; what is proven holds. The mesh of the estimate takes {:.1} MiB.\n\
         With every face at its own estimated depth: {} at most.\n",
        prediction.memory_bytes as f64 / f64::from(1 << 20),
        count(prediction.adaptive_bound as usize, "face", "faces")
    );
    let mut histograms = Table::new(&["depth", "vertices", "by own valence", "faces"]);
    let lists = [&prediction.vertex_depths, &prediction.vertex_depths_raw, &prediction.face_depths];
    for depth in 0..lists.iter().map(|list| list.len()).max().unwrap_or(0) {
        let counts = lists.map(|list| list.get(depth).copied().unwrap_or(0));
        histograms.row(&[depth as u64, counts[0], counts[1], counts[2]]);
    }
    let _ = write!(text, "\n{histograms}");
    if let Some(Budget { faces, full_accuracy, adaptive_accuracy, rigorous_accuracy }) = &prediction.budget {
        let [full, adaptive, proven] =
            [full_accuracy, adaptive_accuracy, rigorous_accuracy].map(|&value| number(value));
        let _ = writeln!(
            text,
            "\n{faces} faces allow an accuracy of {full} estimated, {adaptive} estimated with every face at its own depth, \
             {proven} proven."
        );
    }
    text
}
