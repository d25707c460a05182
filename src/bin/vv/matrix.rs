//! `vv matrix`: a mesh in, a region refined, the matrix of the refinement out.

use serde::Serialize;
use vvmesh::io::{write_atomically, write_matrix_market};
use vvmesh::matrix::{SubdivisionMatrix, WeightMatrix};
use vvmesh::step::Keep;

use crate::Outcome;
use crate::aim::Aim;
use crate::args::{MatrixArguments, MethodName};
use crate::console::{Failure, print, print_json, refuse};
use crate::input::Input;
use crate::memory::FaceLimit;
use crate::outputs::{self, OUT};
use crate::progress::Bar;
use crate::table::count;
use crate::{input, limit, refine};

/// What is told of a matrix: its sizes, and what it takes in memory.
#[derive(Serialize)]
struct Sizes {
    rows: usize,
    columns: usize,
    nonzeros: usize,
    bytes: usize,
}

pub(crate) fn run(arguments: &mut MatrixArguments) -> Result<Outcome, Failure> {
    let mut bar = Bar::new();
    let (subdivider, mut selecting) = refine::prepare(&mut arguments.refine)?;
    let MatrixArguments { output, refine: asked, json } = &*arguments;
    if !output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtx")) {
        return refuse(format!("{OUT}: {}: the name must end in .mtx", output.display()));
    }
    outputs::check(&[(OUT, output)], &refine::inputs(asked, &selecting))?;

    let Input { mut mesh, face_numbers, said, tags } = input::read_mesh(&asked.mesh, asked.tags.of_mesh.is_some())?;
    selecting.number_faces(face_numbers);
    selecting.take_fields(said.as_ref())?;
    refine::tag(&mut mesh, tags.as_ref(), asked)?;
    let mut matrix = SubdivisionMatrix::new(&mesh);
    let face_limit = FaceLimit::with_matrix(asked, &mesh);
    let certificate = refine::scheme(asked).reach().is_some() && asked.method != MethodName::Uniform;
    let keep = Keep { names: false, certificate };
    let mut run = refine::begin(mesh, asked, subdivider, keep)?;
    selecting.select(&mut run, 1)?;
    refine::refine(&mut run, asked, &selecting, face_limit, Some(&mut matrix), &mut bar)?;
    let weights = match limit::of_refinement(asked) {
        Ok(limit) if asked.limit => {
            limit::refuse_unready("--limit: ", &run.mesh, asked)?;
            matrix.limit(&run.mesh, &limit)
        }
        _ => matrix.weights(),
    };

    bar.show_stage(format!("writing {}", output.display()));
    let written = write_atomically(output, |out| write_matrix_market(out, weights.csr(), &command()));
    bar.hide();
    written?;
    let sizes = Sizes::of(&weights);
    if *json {
        print_json(&sizes)?;
    } else {
        let [rows, columns] = [count(sizes.rows, "row", "rows"), count(sizes.columns, "column", "columns")];
        print(&format!("wrote {}: {rows}, {columns}, {} nonzeros\n", output.display(), sizes.nonzeros))?;
    }
    Ok(run.aim.as_ref().map_or(Outcome::Done, Aim::outcome))
}

impl Sizes {
    fn of(weights: &WeightMatrix) -> Self {
        Self {
            rows: weights.row_count(),
            columns: weights.column_count(),
            nonzeros: weights.nonzero_count(),
            bytes: weights.memory_bytes(),
        }
    }
}

/// The command as it was typed, which says what the matrix is one of.
fn command() -> String {
    let words = std::env::args_os().skip(1).map(|word| {
        let word = word.to_string_lossy().into_owned();
        if word.contains(char::is_whitespace) { format!("{word:?}") } else { word }
    });
    format!("vv {} {}", env!("CARGO_PKG_VERSION"), words.collect::<Vec<_>>().join(" "))
}
