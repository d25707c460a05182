//! The arguments of every command.

use std::fmt;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use vvmesh::scheme::LoopWeights;
use vvmesh::{Accuracy, Camera, Length};

/// What an expression may be, for the help of the options that take one.
const EXPRESSIONS: &str = "\
Expressions (vertices and faces count from 0, polygons after they are cut into triangles):
  all                   every vertex
  vertices:1,2,3        these vertices; vertices:@FILE reads them from a file
  disk:V,R              all within R edges of vertex V
  sphere:x,y,z,radius   all within a distance of a point
  dihedral:DEG          ends and opposite vertices of edges folded by more than DEG degrees
  faces:1,2,3           these faces; faces:@FILE reads them from a file
  normal-angle:DEG      faces at edges folded by more than DEG degrees; normal-angle:DEG+neighbors also
                        those that share an edge with them
  limit-error:EPS       vertices farther than EPS from their limit under `loop`, and their neighbours
  curvature:K           vertices of Gaussian curvature above K or below -K
  curvature-top:P%      the P percent of the vertices where it is greatest
  mean-curvature:H      vertices of mean curvature above H or below -H
  normal-cone:DEG       vertices with a face more than DEG degrees off the mean of their normals
  flatness:L            vertices with a neighbour farther than L from their plane
  valence:N             vertices of more than N neighbours
  field:NAME>VALUE      vertices by a field, red, green or blue (0 to 1); also with >=, < and <=
  edge-length:L         edges longer than L
  boundary              edges of one face
  sharp                 sharp edges, those on a boundary too
  silhouette:eye=x,y,z  edges between faces seen from outside and from inside, from a point;
                        silhouette:dir=x,y,z from very far away
  pixel-length:N        edges longer than N pixels in the picture of --camera
  area:A                faces of a greater area than A
  frustum               faces of which --camera may see something, refined by `loop` or not
  pixel-area:N          faces that cover more than N pixels in the picture of --camera
  !E   E & E   E | E    not, and, or, in the order in which they bind; parentheses group

EPS and L are in the unit of the mesh, or with % behind them in percent of the diagonal of its box.
With --select-each a threshold may be a list of values, one a level: normal-angle:10/20/30.
!E is what E does not select of its own kind: !boundary are edges, whose ends may lie on the boundary;
!(boundary & all) are the vertices inside.
Steps split faces, so those of the file are named with --select, and followed by what is made of them.
A face stands for itself among faces; with vertices beside it, or where vertices are asked for, it
is its corners. `simple` splits all edges of selected faces, red-green methods these faces.

";

/// Adaptive subdivision of triangle meshes on a graph rotation system.
#[derive(Parser, Debug)]
#[command(name = "vv", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "\
Example:
  vv demo
  vv subdivide spot.obj -o fine.obj --scheme loop --levels 3 --method incremental --select disk:0,2

Meshes are read and written as OBJ, OFF, PLY and STL. Ids count from 0, in OBJ too.
Exit codes: 0 done, 1 check found something or --until was not reached, 2 usage or input.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    Demo(DemoArguments),
    Info(InfoArguments),
    Check(CheckArguments),
    Compare(CompareArguments),
    Select(SelectArguments),
    Subdivide(SubdivideArguments),
    Matrix(MatrixArguments),
    Limit(LimitArguments),
    Predict(PredictArguments),
    Stroke(StrokeArguments),
}

/// Refine a region of a built-in mesh by every method and compare
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  vv demo -o pictures

The model is an open vase with a sharp edge. Three levels of Loop subdivision of one side of it
are made by each method. The deviation is the greatest distance of a selected vertex from its
place in the uniform mesh, as a part of the diagonal of the model; 0: not one bit differs.")]
pub(crate) struct DemoArguments {
    /// The folder for the meshes, made if it is not there
    #[arg(short = 'o', value_name = "DIR", default_value = "vv-demo")]
    pub(crate) folder: PathBuf,
    /// Print the table as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Count what is in a mesh: sizes, components, boundary loops, genus, valences, bounds
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  vv info spot.obj --json

All numbers are those of the polygons as they stand in the file, whatever is wrong with them.")]
pub(crate) struct InfoArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Look for T-junctions, cracks and everything else that keeps faces from being a conforming mesh
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  vv check fine.obj

Exit codes: 0 conforming, 1 something was found, 2 the file could not be read.
Isolated vertices are told but do no harm, and a boundary is no defect.")]
pub(crate) struct CheckArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// How near to an edge a vertex lies on it [default: 1e-6 of the bounding-box diagonal]
    #[arg(long, value_name = "T", value_parser = distance, allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Tell which vertices or faces an expression picks, without refining
#[derive(Args, Debug)]
#[command(after_help = format!("\
{EXPRESSIONS}Example:
  vv select spot.obj --select 'dihedral:40 & !disk:0,5' > ids.txt

The ids are printed one a line, so the output can be given back as vertices:@ids.txt, of faces as
faces:@ids.txt; of edges both ends. With --rings it is always vertices."))]
pub(crate) struct SelectArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Which vertices; see below
    #[arg(long, value_name = "EXPR")]
    pub(crate) select: String,
    #[command(flatten)]
    pub(crate) view: ViewArguments,
    #[command(flatten)]
    pub(crate) tags: TagArguments,
    /// Expand the selection by this many rings of neighbours
    #[arg(long, value_name = "R", default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) rings: usize,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Refine a mesh, or a region of it
#[derive(Args, Debug)]
#[command(after_help = format!("\
{EXPRESSIONS}Example:
  vv subdivide spot.obj -o fine.obj --scheme loop --levels 3 --method incremental \\
      --select disk:0,4 --report report.json
  vv subdivide spot.obj -o near.obj --scheme loop --until 0.1%

From OBJ to OBJ texture coordinates, colours, normals, groups, objects and materials are kept; PLY
has texture coordinates and colours in eight bits, STL nothing but corners in single precision.
With an odd number of levels of sqrt3 triangles across seams have no texture coordinates, which is told.
Files are written whole or not at all, and none before the last level is made."))]
pub(crate) struct SubdivideArguments {
    /// Where to write the refined mesh; the ending .obj, .off, .ply or .stl tells the format
    #[arg(short = 'o', value_name = "OUT")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) refine: RefineArguments,
    /// Close the cracks that `mobile` leaves; without it faces are written with vertices on the inside of their edges, as
    /// they were made, and without what the file says of them
    #[arg(long)]
    pub(crate) close: bool,
    /// New texture coordinates: by the scheme, with its boundary rule at seams; the same with straight seams; or half way
    /// between the old ones [default: scheme]
    #[arg(long)]
    pub(crate) uv: Option<TextureName>,
    /// New vertex colours: by the scheme, half way between the old ones, or the older of two [default: scheme]
    #[arg(long)]
    pub(crate) colors: Option<ColorsName>,
    /// Normals: computed from the faces with the hard edges of the file, of the limit surface of `loop`, or none
    /// [default: recompute if the file has any and is refined]
    #[arg(long)]
    pub(crate) normals: Option<NormalsName>,
    /// Go on with the run that this file tells of, if it is there, and write there how to go on after the last level: two
    /// runs of one level make what one of two makes. MESH is the mesh with which the run began, or the one that it made
    #[arg(long, value_name = "FILE.json", conflicts_with = "limit")]
    pub(crate) state: Option<PathBuf>,
    /// Write a report, one row a level
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,
    /// Write a table of the vertices: level, parents (`1,2`, `1,2,5`, or `3>7` for a third of an edge), selected, certified
    #[arg(long, value_name = "FILE.tsv")]
    pub(crate) vertex_table: Option<PathBuf>,
    /// Write a table of the faces: level, kind, selected
    #[arg(long, value_name = "FILE.tsv")]
    pub(crate) face_table: Option<PathBuf>,
    /// Print the report as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Refine a region by every method, and compare each with uniform refinement
#[derive(Args, Debug)]
#[command(after_help = format!("\
{EXPRESSIONS}Example:
  vv compare spot.obj --select disk:0,4 --levels 3 --accuracy 0.01 --markdown

One row a method and level. T- and O-vertices are those of the step, passes those in which it found
what to split; the greatest valence, the level balance (the greatest difference of levels around a
vertex) and the smallest angle are those of the whole mesh. The deviation of a vertex is how far it
is from its place in the uniform mesh of the same level, that of its limit how far the limits are
from each other. Both, and the percentage of those at the very same place, are of the vertices that
follow the selection in the uniform mesh, found by name. Which is exact is computed around the
selection, so the uniform mesh need not fit: then only its sizes are told. Memory is that of the mesh
and its history with the names of all vertices. A row that could not be made has `skipped`, the reason."))]
pub(crate) struct CompareArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Which vertices, chosen once and followed through the levels; see below
    #[arg(long, value_name = "EXPR")]
    pub(crate) select: String,
    #[command(flatten)]
    pub(crate) view: ViewArguments,
    /// How many steps
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..), allow_negative_numbers = true)]
    pub(crate) levels: u8,
    /// Which weights make the new positions, and how triangles are split
    #[arg(long, default_value = "loop")]
    pub(crate) scheme: SchemeName,
    /// How near to its limit `mobile` brings a vertex before it stays for ever; without it that method is skipped
    #[arg(long, value_name = "EPS", value_parser = accuracy, allow_negative_numbers = true)]
    pub(crate) accuracy: Option<Accuracy>,
    /// Refuse to make meshes of more faces than this [default: what fits the memory that is free]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) max_faces: Option<u64>,
    #[command(flatten)]
    pub(crate) form: FormArguments,
}

// Who looks. No doc comment: it would stand in the help.
#[derive(Args, Debug)]
pub(crate) struct ViewArguments {
    /// The camera through which `frustum`, `pixel-area` and `pixel-length` look: from where, to where, what is up, how many
    /// degrees the height of the picture takes, and its size in pixels
    #[arg(long, value_name = "eye=x,y,z,at=x,y,z,up=x,y,z,fov=DEG,size=WxH")]
    pub(crate) camera: Option<Camera>,
}

// How a table is printed. No doc comment: it would stand in the help.
#[derive(Args, Debug)]
#[group(multiple = false)]
pub(crate) struct FormArguments {
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Print comma-separated values, with the names that JSON has
    #[arg(long)]
    pub(crate) csv: bool,
    /// Print a table for Markdown
    #[arg(long)]
    pub(crate) markdown: bool,
}

/// Write a refinement as a sparse matrix: refined positions are this matrix times those of the input
#[derive(Args, Debug)]
#[command(after_help = format!("\
{EXPRESSIONS}Example:
  vv matrix cage.obj -o S.mtx --scheme loop --levels 3 --method uniform

The matrix has a row for each vertex that `vv subdivide` would write with the same options, and a
column for each vertex of the input, both in the order of the files. The file is Matrix Market,
coordinate real general, counted from 1. When the input is moved and its faces stay, one product
takes the place of refining it again; a selection is not made anew, nor are the faces paired that
`four-eight` splits together."))]
pub(crate) struct MatrixArguments {
    /// Where to write the matrix
    #[arg(short = 'o', value_name = "OUT.mtx")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) refine: RefineArguments,
    /// Print the sizes as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

// What every command that refines takes. No doc comment: it would stand in their help.
#[derive(Args, Debug)]
pub(crate) struct RefineArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Which weights make the new positions; `sqrt3` also splits triangles in its own way, in three instead of four
    #[arg(long)]
    pub(crate) scheme: SchemeName,
    /// How many steps; 0 copies the mesh. With `mobile` and --until as many as it takes, but no more than this if it is
    /// given; with lists in --select-each as many as they have values
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(required_unless_present_any = ["accuracy", "select_each", "until"])]
    pub(crate) levels: Option<u8>,
    /// What each step refines: everything; the selection; the selection with the rings around it; the faces inside the
    /// selection, closed anew in each step; the same with what it needs to be exact; all faces around selected vertices,
    /// up to the level of the step, with what that needs; or of the selection what is farther from its limit than
    /// --accuracy, under `loop` [default with --until: dynamic]
    #[arg(long, required = false, required_unless_present = "until")]
    #[arg(default_value_if("until", clap::builder::ArgPredicate::IsPresent, "dynamic"), hide_default_value = true)]
    pub(crate) method: MethodName,
    /// How near to its limit `mobile` brings a vertex before it stays for ever
    #[arg(long, value_name = "EPS", value_parser = accuracy, allow_negative_numbers = true)]
    #[arg(required_if_eq("method", "mobile"))]
    pub(crate) accuracy: Option<Accuracy>,
    /// Refine where the limit surface of `loop` may be farther away than this, until it is nowhere; by `dynamic`,
    /// `red-green-restricted` or `uniform`. A distance, or one in percent (`0.1%`) of the diagonal of the bounding box. If
    /// --levels or --max-faces end it before, all is written that was made, and the exit code is 1
    #[arg(long, value_name = "EPS", value_parser = length, allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["select", "select_each"])]
    pub(crate) until: Option<Length>,
    /// What --until looks at: a proven bound of the distance between each face and the surface, or the distance of the vertices
    /// to their limits, between which the surface may be anywhere [default: bound]
    #[arg(long, requires = "until")]
    pub(crate) measure: Option<MeasureName>,
    /// By how many rings `incremental` expands the selection [default: 1]
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    pub(crate) rings: Option<usize>,
    /// Which vertices, chosen once and followed through the levels; see below [default: all]
    #[arg(long, value_name = "EXPR", conflicts_with = "select_each")]
    pub(crate) select: Option<String>,
    /// Which vertices, chosen anew at every level; see below. A threshold may be a list of values, one a level
    #[arg(long, value_name = "EXPR")]
    pub(crate) select_each: Option<String>,
    /// Which diagonal faces with two split edges get, which `simple` and `mobile` make: the longest, the shortest, that from
    /// the end of smaller valence, or of smaller id [default: valence]
    #[arg(long)]
    pub(crate) diagonal: Option<DiagonalName>,
    /// Do not split edges whose new vertex would be nearer than this to their middle, by `simple` under `butterfly`
    #[arg(long, value_name = "TAU", value_parser = distance, allow_negative_numbers = true)]
    pub(crate) min_move: Option<f64>,
    #[command(flatten)]
    pub(crate) view: ViewArguments,
    /// Weights of smooth vertices under `loop` [default: loop]
    #[arg(long)]
    pub(crate) weights: Option<WeightsName>,
    /// How `four-eight` pairs the faces of the input: as many as can be, or the longest edges first [default: maximum]
    #[arg(long)]
    pub(crate) blocks: Option<BlocksName>,
    #[command(flatten)]
    pub(crate) tags: TagArguments,
    /// Put the vertices where infinitely many steps would, under `loop`, or under `sqrt3` by `uniform`
    #[arg(long)]
    pub(crate) limit: bool,
    /// Refuse to make more faces than this [default: what fits the memory that is free]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) max_faces: Option<u64>,
}

/// Put every vertex of a mesh where infinitely many steps would, with the normal there
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  vv limit spot.obj -o smooth.obj --normals --sharp-angle 40

At a sharp edge a vertex has a normal for each side, and the corners of faces name that of theirs.
Where there is none (an isolated vertex, the tip of a cone, a fold) none is made up: that is told,
and faces there are written without.")]
pub(crate) struct LimitArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// Where to write the mesh; the ending .obj, .off, .ply or .stl tells the format
    #[arg(short = 'o', value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// The steps of which scheme
    #[arg(long, default_value = "loop")]
    pub(crate) scheme: LimitName,
    /// Write the normals of the limit surface, in OBJ
    #[arg(long)]
    pub(crate) normals: bool,
    /// Weights of smooth vertices under `loop` [default: loop]
    #[arg(long)]
    pub(crate) weights: Option<WeightsName>,
    #[command(flatten)]
    pub(crate) tags: TagArguments,
    /// Print what was done as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Tell how deep Loop subdivision has to go for an accuracy, and how many faces it makes, without refining
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  vv predict spot.obj --accuracy 0.01 --verify

Accuracy is the distance between a point of the mesh and the point of the limit surface with the
same parameters. The estimate goes by the distances of the vertices and is a rule of thumb, too
small at times; the depth that is called proven is never too small. Boundaries, creases, darts and
corners are part of both; a finite sharpness is refused. JSON has the measured distance at the
proven depth, and lists of how many vertices and faces reach the accuracy at depth 0, 1 and so on.")]
pub(crate) struct PredictArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// The distance from the limit surface to stay below
    #[arg(long, value_name = "EPS", value_parser = accuracy, allow_negative_numbers = true)]
    pub(crate) accuracy: Accuracy,
    /// Tell the finest accuracy, too, that so many faces allow
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) budget: Option<u64>,
    /// Refine, and measure the greatest distance at both depths
    #[arg(long)]
    pub(crate) verify: bool,
    /// Weights of smooth vertices [default: loop]
    #[arg(long)]
    pub(crate) weights: Option<WeightsName>,
    #[command(flatten)]
    pub(crate) tags: TagArguments,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Refine a mesh by drawing on it: do again what a file says that a pen did
#[derive(Args, Debug)]
#[command(after_help = "\
Example:
  vv stroke head.off --stroke pen.json -o drawn --frames 3

The file is JSON:
  {\"format\": \"vv stroke\", \"version\": 1,
   \"brush\": {\"euclidean\": 0.05, \"level\": 3, \"pace\": 0.2},
   \"camera\": {\"eye\": [0, 0, 9], \"at\": [0, 0, 0], \"up\": [0, 1, 0], \"fov\": 40, \"size\": [640, 480]},
   \"events\": [
     {\"time\": 0.00, \"ray\": {\"origin\": [0, 0, 9], \"direction\": [0, 0.1, -1]}},
     {\"time\": 0.02, \"screen\": [320, 200]},
     {\"time\": 0.04, \"place\": {\"face\": [0, 1, 2], \"weights\": [0.2, 0.3, 0.5]}}]}
Times are seconds and do not fall. An event points along a ray, through a pixel counted from the
upper left corner (which needs the camera; fov is that of the height, in degrees), or to a place
on a face of the input, across which the refined mesh is looked for; and may have a brush of its
own.

A brush touches the corners of the face that is met, and all vertices within `euclidean` in
space, as far as the surface does not leave that ball, within `edge_path` along edges, which is
longer than along the surface, or within a number of `edges`. Of these level 1 is wanted, and
one more after every `pace` seconds (0, or none: at once all) for which the pen stays within the
radius of where it came, but not more than `level`. By `incremental` an event refines what is
touched and coarser by one level, so several have to come; by `dynamic` it brings all of it to
the level that is wanted.

DIR gets mesh.off (as the input ends), report.json with a row an event, and the frames; the same
files to the last bit whenever it is done again, unless --times is given. `proven` counts the
refined vertices that are proven to be where a uniform mesh of some level has them: by `dynamic`
all, by `incremental` those, with their neighbours, on ground on which nothing was drawn before.")]
pub(crate) struct StrokeArguments {
    /// The mesh: OBJ, OFF, PLY or STL
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
    /// What the pen did; see below
    #[arg(long, value_name = "FILE.json")]
    pub(crate) stroke: PathBuf,
    /// The folder for what is made, made if it is not there
    #[arg(short = 'o', value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Which weights make the new positions
    #[arg(long, default_value = "loop")]
    pub(crate) scheme: SchemeName,
    /// How an event refines; see below
    #[arg(long, default_value = "incremental")]
    pub(crate) method: PenName,
    /// Write so many meshes on the way, evenly spread over the events, or one after each
    #[arg(long, value_name = "N|all", value_parser = frames, allow_negative_numbers = true)]
    pub(crate) frames: Option<Frames>,
    #[command(flatten)]
    pub(crate) tags: TagArguments,
    /// Tell in the report how many milliseconds each event took
    #[arg(long)]
    pub(crate) times: bool,
    /// Refuse to make more faces than this [default: what fits the memory that is free]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) max_faces: Option<u64>,
    /// Print the report as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// After which events of a stroke meshes are written.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Frames {
    /// After each.
    All,
    /// After so many, evenly spread, the last among them.
    Count(usize),
}

impl Frames {
    /// Counted from 1, ascending.
    pub(crate) fn of(self, events: usize) -> Vec<usize> {
        let count = match self {
            Self::All => events,
            Self::Count(count) => count.min(events),
        };
        (1..=count).map(|k| (k * events).div_ceil(count)).collect()
    }
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PenName {
    Incremental,
    Dynamic,
}

/// What is sharp in a mesh that is read.
#[derive(Args, Debug)]
pub(crate) struct TagArguments {
    /// Boundary vertices that stay as corners: none, those of valence 2, or all of the input [default: smooth]
    #[arg(long)]
    pub(crate) boundary: Option<BoundaryName>,
    /// Make edges folded by more than this sharp
    #[arg(long, value_name = "DEG", value_parser = degrees, allow_negative_numbers = true, conflicts_with = "sharp")]
    pub(crate) sharp_angle: Option<f64>,
    /// Make the edges and vertices in a file sharp: a line `a b` names an edge, `a b s` its sharpness, `a` a corner,
    /// `a - s` the sharpness of a vertex; 0 is smooth, `inf` sharp for ever; `#` starts a comment
    #[arg(long, value_name = "FILE")]
    pub(crate) sharp: Option<PathBuf>,
    /// Read the tag lines of the mesh: `t crease`, `t corner`, `t interpolateboundary`; --boundary and --sharp win over
    /// them
    #[arg(long = "tags")]
    pub(crate) of_mesh: Option<TagsName>,
    /// What the halves of an edge of finite sharpness inherit: 1 less, or evened out along the crease first
    /// [default: uniform]
    #[arg(long)]
    pub(crate) creases: Option<CreasesName>,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum LimitName {
    Loop,
    Butterfly,
    ModifiedButterfly,
    Sqrt3,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum SchemeName {
    Loop,
    Butterfly,
    ModifiedButterfly,
    Midpoint,
    Sqrt3,
    #[value(name = "four-eight")]
    FourEight,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BlocksName {
    Maximum,
    LongestEdge,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum DiagonalName {
    Longest,
    Shortest,
    Valence,
    Id,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum MethodName {
    Uniform,
    Simple,
    Incremental,
    RedGreen,
    RedGreenRestricted,
    Dynamic,
    Mobile,
}

impl MethodName {
    /// Whether its steps go on with a hierarchy that is kept beside the mesh.
    pub(crate) fn is_on_hierarchy(self) -> bool {
        matches!(self, Self::RedGreen | Self::RedGreenRestricted | Self::Dynamic)
    }
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum MeasureName {
    Bound,
    Vertex,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BoundaryName {
    Smooth,
    Corners,
    Fixed,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum TagsName {
    Obj,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum CreasesName {
    Uniform,
    Chaikin,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WeightsName {
    Loop,
    Warren,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum TextureName {
    Scheme,
    LinearSeams,
    Linear,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ColorsName {
    Scheme,
    Linear,
    Nearest,
}

#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NormalsName {
    Recompute,
    Limit,
    Drop,
}

/// The weights that a name, or none, stands for.
pub(crate) fn loop_weights(name: Option<WeightsName>) -> LoopWeights {
    match name {
        None | Some(WeightsName::Loop) => LoopWeights::Loop,
        Some(WeightsName::Warren) => LoopWeights::Warren,
    }
}

impl SubdivideArguments {
    /// Whether faces are written before cracks between them are closed.
    pub(crate) fn is_unclosed(&self) -> bool {
        self.refine.method == MethodName::Mobile && !self.close
    }
}

impl RefineArguments {
    /// How many steps are made at most.
    pub(crate) fn levels(&self) -> u8 {
        self.levels.unwrap_or(u8::MAX)
    }
}

impl TagArguments {
    /// The first of the options that was given.
    pub(crate) fn first_given(&self) -> Option<&'static str> {
        let given = [
            ("--boundary", self.boundary.is_some()),
            ("--sharp", self.sharp.is_some()),
            ("--sharp-angle", self.sharp_angle.is_some()),
            ("--tags", self.of_mesh.is_some()),
        ];
        given.into_iter().find_map(|(option, given)| given.then_some(option))
    }
}

/// Names print as they are typed.
macro_rules! print_as_typed {
    ($($name:ty),*) => {
        $(impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let value = self.to_possible_value();
                f.write_str(value.as_ref().map_or("", clap::builder::PossibleValue::get_name))
            }
        })*
    };
}

print_as_typed!(
    SchemeName,
    LimitName,
    MethodName,
    PenName,
    DiagonalName,
    BlocksName,
    WeightsName,
    BoundaryName,
    CreasesName
);

fn accuracy(text: &str) -> Result<Accuracy, String> {
    let accuracy = text.parse().ok().and_then(|distance| Accuracy::new(distance).ok());
    accuracy.ok_or_else(|| "expected a finite distance above 0".to_owned())
}

fn frames(text: &str) -> Result<Frames, String> {
    match (text, text.parse()) {
        ("all", _) => Ok(Frames::All),
        (_, Ok(count @ 1..)) => Ok(Frames::Count(count)),
        _ => Err("expected a number, 1 or more, or `all`".to_owned()),
    }
}

fn length(text: &str) -> Result<Length, String> {
    let (number, make): (_, fn(f64) -> _) = match text.strip_suffix('%') {
        Some(percent) => (percent, Length::percent),
        None => (text, Length::absolute),
    };
    let length = number.parse().ok().filter(|length| *length > 0.0).and_then(|length| make(length).ok());
    length.ok_or_else(|| "expected a finite distance above 0, or one in percent, as in 0.1%".to_owned())
}

fn distance(text: &str) -> Result<f64, String> {
    number(text, 0.0..=f64::MAX, "a distance, 0 or more")
}

fn degrees(text: &str) -> Result<f64, String> {
    number(text, 0.0..=180.0, "degrees from 0 to 180")
}

fn number(text: &str, allowed: std::ops::RangeInclusive<f64>, expected: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if allowed.contains(&number) => Ok(number),
        _ => Err(format!("expected {expected}")),
    }
}
