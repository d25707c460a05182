//! Criteria as text: what it means and how it is written. How it is read is in `parse`, the arguments of each criterion
//! in `known`.

mod argument;
mod known;
mod parse;

use std::fmt;
use std::io;
use std::path::Path;
use std::sync::Arc;

use super::criteria::{Criterion, Faces, Field};
use super::selection::Selection;
use crate::camera::Camera;
use crate::error::{ExpressionError, SelectError};
use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::scratch::Scratch;

/// A criterion made from text.
///
/// | text | selects |
/// |---|---|
/// | `all` | every vertex |
/// | `vertices:1,2,3` | the vertices with these ids; `vertices:` selects nothing |
/// | `vertices:@FILE` | those of a file, separated by blanks, commas or line ends; `#` starts a comment |
/// | `disk:V,R` | what is within R edges of vertex V ([`Disk`](super::Disk)) |
/// | `sphere:x,y,z,radius` | what is at most `radius` away from a point ([`Sphere`](super::Sphere)) |
/// | `dihedral:DEG` | ends and opposite vertices of edges folded by more than DEG degrees ([`Dihedral`](super::Dihedral)) |
/// | `faces:1,2,3` | the faces with these numbers ([`Faces`]); `faces:` selects none |
/// | `faces:@FILE` | those of a file, which is read as that of `vertices` |
/// | `normal-angle:DEG` | faces whose normal is more than DEG degrees from that of a neighbour ([`NormalAngle`](super::NormalAngle)) |
/// | `normal-angle:DEG+neighbors` | the same, and the faces that share an edge with them |
/// | `limit-error:EPS` | vertices farther than EPS from their limit by the Loop scheme, and their neighbours ([`LimitError`](super::LimitError)) |
/// | `curvature:K` | vertices of Gaussian curvature above K or below -K ([`Curvature`](super::Curvature)) |
/// | `curvature-top:P%` | the P percent of the vertices where that is greatest ([`CurvatureTop`](super::CurvatureTop)) |
/// | `mean-curvature:H` | vertices of mean curvature above H or below -H ([`MeanCurvature`](super::MeanCurvature)) |
/// | `normal-cone:DEG` | vertices with a face whose normal is more than DEG degrees from the mean of theirs ([`NormalCone`](super::NormalCone)) |
/// | `flatness:L` | vertices with a neighbour farther than L from their plane ([`Flatness`](super::Flatness)) |
/// | `valence:N` | vertices of more than N neighbours ([`Valence`](super::Valence)) |
/// | `field:NAME>VALUE` | vertices with such a value in a field; also with `>=`, `<` and `<=` ([`Field`]) |
/// | `edge-length:L` | edges longer than L ([`EdgeLength`](super::EdgeLength)) |
/// | `boundary` | edges of one face ([`Boundary`](super::Boundary)) |
/// | `sharp` | sharp edges, those on a boundary too ([`Sharp`](super::Sharp)) |
/// | `silhouette:eye=x,y,z` | edges between faces seen from outside and from inside, as from a point ([`Silhouette`](super::Silhouette)) |
/// | `silhouette:dir=x,y,z` | the same from very far away in a direction |
/// | `pixel-length:N` | edges longer than N pixels in the picture of a camera ([`PixelLength`](super::PixelLength)) |
/// | `area:A` | faces of a greater area than A ([`Area`](super::Area)) |
/// | `frustum` | faces of which a camera may see something ([`Frustum`](super::Frustum)) |
/// | `pixel-area:N` | faces that cover more than N pixels in its picture ([`PixelArea`](super::PixelArea)) |
/// | `!E`, `E & E`, <code>E &#124; E</code>, `(E)` | not, and, or; `!` binds tightest, then `&` |
///
/// A threshold (DEG, EPS, K, P%, H, L, A, N) may be a list of values, one for each level:
/// `normal-angle:10/20/30`. All lists of an expression are of one length. Such an expression selects nothing before a level is chosen; see [`Expression::at_level`].
/// EPS and L are lengths, with `%` behind the number in hundredths of the diagonal of the bounding box. The camera is told once,
/// [when the text is read](Expression::parse_seen), and the values of fields [afterwards](Expression::with_fields).
///
/// Criteria answer with vertices, edges or faces. A chain of `&` or `|` over answers of one kind is of that kind; in any other
/// chain edges become their ends and faces their corners before they are combined, in whatever order they stand.
///
/// Blanks may stand between all of these. Arguments end at `|`, `&`, `)` or the end of the text, so a file name that
/// holds one of them, or that starts or ends with a blank, is put in double quotes: `vertices:@"a|b.txt"`. A name in
/// quotes holds no double quote. Ids count from 0.
///
/// An expression prints in one form that reads back as the same: without blanks and needless parentheses, ids ascending,
/// and with the ids of a file in place of its name. A criterion with lists prints as it was typed.
///
/// ```
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::{Criterion, Expression};
/// use vvmesh::shapes;
///
/// let expression = Expression::parse("disk:5,1 & !(vertices:@ids)", &mut |_| Ok("5 9 # the center".to_owned()))?;
/// assert_eq!(expression.to_string(), "disk:5,1&!vertices:5,9");
/// let selection = expression.select(&shapes::grid(3, 3), &mut Scratch::new())?;
/// assert_eq!(selection.len(), 5);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Expression {
    node: Node,
    /// How long its lists of values are, if it has any.
    level_count: Option<usize>,
    uses_camera: bool,
}

/// One criterion or a combination. `And` and `Or` hold two parts or more and none of their own kind, so a long chain is
/// not deep; what else stands inside each other is bounded when it is read.
#[derive(Clone, Debug)]
enum Node {
    Criterion(Arc<dyn Term>),
    /// A criterion with lists of values, as it prints and as it is at each level.
    PerLevel {
        text: String,
        terms: Vec<Arc<dyn Term>>,
    },
    Faces(Faces),
    Field(Field),
    Not(Box<Node>),
    And(Vec<Node>),
    Or(Vec<Node>),
}

/// A criterion that prints as it is read.
trait Term: Criterion + fmt::Display + fmt::Debug + Send + Sync {}

impl<T: Criterion + fmt::Display + fmt::Debug + Send + Sync> Term for T {}

impl Expression {
    /// How many parentheses and `!` may stand inside each other.
    ///
    /// It bounds the stack, and the selections that are held at once while the expression is evaluated.
    pub const MAX_DEPTH: usize = 64;

    /// How many values a list may have.
    pub const MAX_LEVELS: usize = u8::MAX as usize;

    /// Reads an expression; `read` answers with the text of a file that it names.
    ///
    /// # Errors
    /// With the column, what was expected there and what was found: the text is no expression, there is no such
    /// criterion, a number is not one or out of its range, lists are not of one length, a file could not be read or holds no ids. Whether a vertex
    /// exists is seen only when the expression is applied to a mesh.
    ///
    /// # Complexity
    /// O(text and files), and O(n log n) for lists of n ids.
    pub fn parse(text: &str, read: &mut dyn FnMut(&Path) -> io::Result<String>) -> Result<Self, ExpressionError> {
        parse::parse(text, None, read)
    }

    /// How many values its lists have, one a level; `None` if it has no list, and is the same at every level.
    #[must_use]
    pub fn level_count(&self) -> Option<usize> {
        self.level_count
    }

    /// What it is at a level, counted from 1: with one value in place of each list. `None` for 0, and behind the end of lists.
    ///
    /// ```
    /// use vvmesh::select::Expression;
    ///
    /// let expression = Expression::parse("normal-angle:10/20/30 | !dihedral:1/2/3 & all", &mut |_| Ok(String::new()))?;
    /// assert_eq!(expression.level_count(), Some(3));
    /// let second = expression.at_level(2).expect("there are three");
    /// assert_eq!(second.to_string(), "normal-angle:20|!dihedral:2&all");
    /// assert!(expression.at_level(4).is_none());
    /// # Ok::<(), vvmesh::error::Error>(())
    /// ```
    #[must_use]
    pub fn at_level(&self, level: usize) -> Option<Self> {
        let place = level.checked_sub(1).filter(|&place| self.level_count.is_none_or(|count| place < count))?;
        Some(Self { node: self.node.at(place), level_count: None, ..*self })
    }

    /// The same with the camera through which criteria look.
    ///
    /// # Errors
    /// Those of [`Expression::parse`]; without a camera a criterion that needs one is an error too.
    ///
    /// ```
    /// use vvmesh::select::Expression;
    /// let camera = "eye=0,0,9,at=0,0,0,up=0,1,0,fov=40,size=640x480".parse()?;
    /// let seen = Expression::parse_seen("frustum & pixel-area:50", camera, &mut |_| Ok(String::new()))?;
    /// assert!(seen.uses_camera());
    /// let error = Expression::parse("all & frustum", &mut |_| Ok(String::new())).unwrap_err();
    /// assert_eq!(error.to_string(), "column 7: `frustum` looks through a camera, and there is none");
    /// # Ok::<(), vvmesh::error::Error>(())
    /// ```
    pub fn parse_seen(
        text: &str,
        camera: Camera,
        read: &mut dyn FnMut(&Path) -> io::Result<String>,
    ) -> Result<Self, ExpressionError> {
        parse::parse(text, Some(camera), read)
    }

    /// Whether a criterion looks through a camera.
    #[must_use]
    pub fn uses_camera(&self) -> bool {
        self.uses_camera
    }

    /// The same with the values of its fields, one a vertex, as far as they are told; see [`Field::of_values`]. Each field is
    /// asked for by its name, as often as it is named.
    #[must_use]
    pub fn with_fields(mut self, values: &mut dyn FnMut(&str) -> Option<Vec<f64>>) -> Self {
        self.node.tell_fields(values);
        self
    }

    /// The same with the numbers that faces have in this list; see [`Faces::numbered_by`].
    #[must_use]
    pub fn with_faces_numbered_by(mut self, list: impl Into<Arc<[Triangle]>>) -> Self {
        self.node.number_faces(&list.into());
        self
    }

    /// How the known criteria are written, for messages and help.
    pub fn known_criteria() -> impl Iterator<Item = &'static str> {
        known::KNOWN.iter().flat_map(|known| known.forms).copied()
    }
}

impl Criterion for Expression {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        self.node.select(mesh, scratch)
    }
}

impl Criterion for Node {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        match self {
            Self::Criterion(criterion) => criterion.select(mesh, scratch),
            Self::PerLevel { terms, .. } => Err(SelectError::NoLevel { level_count: terms.len() }),
            Self::Faces(faces) => faces.select(mesh, scratch),
            Self::Field(field) => field.select(mesh, scratch),
            Self::Not(inner) => Ok(inner.select(mesh, scratch)?.complement(mesh)),
            Self::And(parts) => {
                // Parts are evaluated even when nothing is left, so that an unknown vertex is always told. A part of
                // another kind may come last, so vertices are kept beside edges or faces until it does.
                let (first, rest) = parts.split_first().expect("a chain has two parts");
                let first = first.select(mesh, scratch)?;
                let mut alike = (!first.is_of_vertices()).then(|| first.clone());
                let mut vertices = Selection::ascending(first.into_vertices());
                for part in rest {
                    let selection = part.select(mesh, scratch)?;
                    vertices = vertices.intersection(&selection);
                    alike = alike.filter(|alike| alike.is_like(&selection)).map(|alike| alike.intersection(&selection));
                }
                Ok(alike.unwrap_or(vertices))
            }
            Self::Or(parts) => {
                // As many small parts as large ones are merged, so that the sum of all is not paid for each.
                let mut merged: Vec<Selection> = Vec::new();
                for part in parts {
                    let mut selection = part.select(mesh, scratch)?;
                    while merged.last().is_some_and(|before| before.len() <= 2 * selection.len()) {
                        selection = merged.pop().unwrap_or_default().union(&selection);
                    }
                    merged.push(selection);
                }
                Ok(merged.into_iter().rev().reduce(|one, two| one.union(&two)).unwrap_or_default())
            }
        }
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.node.fmt(f)
    }
}

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (sign, parts) = match self {
            Self::Criterion(criterion) => return criterion.fmt(f),
            Self::PerLevel { text, .. } => return f.write_str(text),
            Self::Faces(faces) => return faces.fmt(f),
            Self::Field(field) => return field.fmt(f),
            Self::Not(inner) => {
                f.write_str("!")?;
                return self.write_part(inner, f);
            }
            Self::And(parts) => ("&", parts),
            Self::Or(parts) => ("|", parts),
        };
        for (k, part) in parts.iter().enumerate() {
            f.write_str(if k == 0 { "" } else { sign })?;
            self.write_part(part, f)?;
        }
        Ok(())
    }
}

impl Node {
    /// The same with the value at a place of each list.
    fn at(&self, place: usize) -> Self {
        let parts = |parts: &[Self]| parts.iter().map(|part| part.at(place)).collect();
        match self {
            Self::Criterion(_) | Self::Faces(_) | Self::Field(_) => self.clone(),
            Self::PerLevel { terms, .. } => Self::Criterion(Arc::clone(&terms[place])),
            Self::Not(inner) => Self::Not(Box::new(inner.at(place))),
            Self::And(all) => Self::And(parts(all)),
            Self::Or(all) => Self::Or(parts(all)),
        }
    }

    fn number_faces(&mut self, list: &Arc<[Triangle]>) {
        match self {
            Self::Criterion(_) | Self::PerLevel { .. } | Self::Field(_) => {}
            Self::Faces(faces) => *faces = std::mem::take(faces).numbered_by(Arc::clone(list)),
            Self::Not(inner) => inner.number_faces(list),
            Self::And(parts) | Self::Or(parts) => parts.iter_mut().for_each(|part| part.number_faces(list)),
        }
    }

    fn tell_fields(&mut self, values: &mut dyn FnMut(&str) -> Option<Vec<f64>>) {
        match self {
            Self::Criterion(_) | Self::PerLevel { .. } | Self::Faces(_) => {}
            Self::Field(field) => {
                if let Some(values) = values(field.name()) {
                    *field = field.clone().of_values(values);
                }
            }
            Self::Not(inner) => inner.tell_fields(values),
            Self::And(parts) | Self::Or(parts) => parts.iter_mut().for_each(|part| part.tell_fields(values)),
        }
    }

    /// Writes a part of this node, in parentheses if it binds less tightly.
    fn write_part(&self, part: &Self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if part.binding() < self.binding() { write!(f, "({part})") } else { write!(f, "{part}") }
    }

    fn binding(&self) -> u8 {
        match self {
            Self::Or(_) => 0,
            Self::And(_) => 1,
            Self::Not(_) => 2,
            Self::Criterion(_) | Self::PerLevel { .. } | Self::Faces(_) | Self::Field(_) => 3,
        }
    }
}
