//! `vv demo`: a region of a built-in model, refined by every method and compared.

use std::fs;
use std::path::PathBuf;

use serde::Serialize;
use vvmesh::Mesh;
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::check::mesh_conformity;
use vvmesh::io::save;
use vvmesh::query::measure::bounds;
use vvmesh::scheme::Loop;
use vvmesh::step::Keep;
use vvmesh::subdivide::{Control, Subdivider};

use crate::Outcome;
use crate::args::{DemoArguments, MethodName};
use crate::console::{Failure, print, print_json, refuse};
use crate::demo_model::{SELECT, vase};
use crate::run::Run;
use crate::table::{Table, seconds};
use crate::{input, outputs};

/// How many steps each method makes.
const LEVELS: usize = 3;

#[derive(Serialize)]
struct Demo {
    folder: String,
    select: &'static str,
    levels: usize,
    methods: Vec<Compared>,
}

/// A method, and how what it made compares with the uniform mesh.
#[derive(Serialize)]
struct Compared {
    method: String,
    file: String,
    faces: usize,
    max_valence: usize,
    selected: usize,
    /// The greatest distance of a selected vertex from its uniform position, as a part of the diagonal of the model.
    deviation: f64,
    certified: usize,
    conforming: bool,
    seconds: f64,
}

pub(crate) fn run(arguments: &DemoArguments) -> Result<Outcome, Failure> {
    let file = |name: &str| arguments.folder.join(format!("{name}.obj"));
    let model = vase();
    let uniform = refined(&model, Subdivider::new(Loop::default(), Uniform))?;
    let simple = refined(&model, Subdivider::new(Loop::default(), Simple))?;
    let incremental = refined(&model, Subdivider::new(Loop::default(), Incremental::new(1)?))?;
    let runs =
        [(MethodName::Uniform, &uniform), (MethodName::Simple, &simple), (MethodName::Incremental, &incremental)];

    let outputs = runs.iter().map(|(method, run)| (file(&method.to_string()), &run.mesh));
    let outputs: Vec<(PathBuf, &Mesh)> = [(file("model"), &model)].into_iter().chain(outputs).collect();
    if let Err(error) = fs::create_dir_all(&arguments.folder) {
        return refuse(format!("-o: {}: {error}", arguments.folder.display()));
    }
    let named: Vec<_> = outputs.iter().map(|(path, _)| (outputs::OUT, path.as_path())).collect();
    outputs::check(&named, &[])?;
    for (path, mesh) in &outputs {
        save(path, *mesh)?;
    }

    let compare = |&(method, run): &(MethodName, &Run)| compared(method, &file(&method.to_string()), run, &uniform);
    let demo = Demo {
        folder: arguments.folder.display().to_string(),
        select: SELECT,
        levels: LEVELS,
        methods: runs.iter().map(compare).collect(),
    };
    if arguments.json {
        print_json(&demo)?;
    } else {
        print(&text(&demo, &model))?;
    }
    let promised =
        |of: &Compared| of.conforming && (of.deviation == 0.0 || of.method == MethodName::Simple.to_string());
    Ok(if demo.methods.iter().all(promised) { Outcome::Done } else { Outcome::Found })
}

/// The model after all levels.
fn refined(model: &Mesh, subdivider: Subdivider) -> Result<Run, Failure> {
    let mut run = Run::new(model.clone(), subdivider, Keep { names: true, certificate: true });
    let (expression, _) = input::parse_expression("--select", SELECT, None)?;
    run.selection = input::evaluate("--select", &expression, &run.mesh, &mut run.scratch)?;
    for _ in 0..LEVELS {
        run.step(&mut Control::default())?;
    }
    Ok(run)
}

fn compared(method: MethodName, file: &std::path::Path, run: &Run, uniform: &Run) -> Compared {
    // Ids differ between the runs; names do not. A vertex without its like in the uniform mesh is no point of the surface.
    let same = run.history.same_names(&uniform.history).unwrap_or_default();
    let deviations = run.selection.vertices().iter().map(|&v| match same.get(v.index()).copied().flatten() {
        Some(like) => run.mesh.position(v).distance(uniform.mesh.position(like)),
        None => f64::INFINITY,
    });
    let diagonal = bounds(&uniform.mesh).map_or(1.0, |bounds| bounds.diagonal());
    let totals = run.totals();
    Compared {
        method: method.to_string(),
        file: file.display().to_string(),
        faces: totals.sizes.faces,
        max_valence: totals.sizes.max_valence,
        selected: totals.selected,
        deviation: deviations.fold(0.0, f64::max) / diagonal,
        certified: totals.certified.unwrap_or(0),
        conforming: mesh_conformity(&run.mesh, None).is_conforming(),
        seconds: totals.seconds,
    }
}

fn text(demo: &Demo, model: &Mesh) -> String {
    let mut table =
        Table::new(&["method", "faces", "greatest valence", "deviation", "certified vertices", "conforming", "time"]);
    for of in &demo.methods {
        table.row(&[
            of.method.clone(),
            of.faces.to_string(),
            of.max_valence.to_string(),
            if of.deviation == 0.0 { "0".to_owned() } else { format!("{:.2e}", of.deviation) },
            of.certified.to_string(),
            if of.conforming { "yes" } else { "no" }.to_owned(),
            seconds(of.seconds),
        ]);
    }
    let files: Vec<&str> = demo.methods.iter().map(|of| of.file.as_str()).collect();
    format!(
        "A vase of {} faces, open at the top, with a sharp edge around its foot; {} levels of Loop subdivision of one side \
         of it.\n\n{table}\nDeviation: the greatest distance of a selected vertex from its place in the uniform mesh, as a part \
         of the model's\ndiagonal; 0 says that not one bit differs.\n\nWrote {}, {}.\n",
        model.face_count(),
        demo.levels,
        PathBuf::from(&demo.folder).join("model.obj").display(),
        files.join(", ")
    )
}
