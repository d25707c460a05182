//! Criteria as text: what it means and how it is written. How it is read is in `parse`, the arguments of each criterion
//! in `known`.

mod argument;
mod known;
mod parse;

use std::fmt;
use std::io;
use std::path::Path;
use std::sync::Arc;

use super::criteria::Criterion;
use super::selection::Selection;
use crate::error::{ExpressionError, SelectError};
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
/// | `!E`, `E & E`, <code>E &#124; E</code>, `(E)` | not, and, or; `!` binds tightest, then `&` |
///
/// Blanks may stand between all of these. Arguments end at `|`, `&`, `)` or the end of the text, so a file name that
/// holds one of them, or that starts or ends with a blank, is put in double quotes: `vertices:@"a|b.txt"`. A name in
/// quotes holds no double quote. Ids count from 0.
///
/// An expression prints in one form that reads back as the same: without blanks and needless parentheses, ids ascending,
/// and with the ids of a file in place of its name.
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
pub struct Expression(Node);

/// One criterion or a combination. `And` and `Or` hold two parts or more and none of their own kind, so a long chain is
/// not deep; what else stands inside each other is bounded when it is read.
#[derive(Clone, Debug)]
enum Node {
    Criterion(Arc<dyn Term>),
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

    /// Reads an expression; `read` answers with the text of a file that it names.
    ///
    /// # Errors
    /// With the column, what was expected there and what was found: the text is no expression, there is no such
    /// criterion, a number is not one or out of its range, a file could not be read or holds no ids. Whether a vertex
    /// exists is seen only when the expression is applied to a mesh.
    ///
    /// # Complexity
    /// O(text and files), and O(n log n) for lists of n ids.
    pub fn parse(text: &str, read: &mut dyn FnMut(&Path) -> io::Result<String>) -> Result<Self, ExpressionError> {
        parse::parse(text, read).map(Self)
    }

    /// How the known criteria are written, for messages and help.
    pub fn known_criteria() -> impl Iterator<Item = &'static str> {
        known::KNOWN.iter().flat_map(|known| known.forms).copied()
    }
}

impl Criterion for Expression {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        self.0.select(mesh, scratch)
    }
}

impl Criterion for Node {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        match self {
            Self::Criterion(criterion) => criterion.select(mesh, scratch),
            Self::Not(inner) => Ok(inner.select(mesh, scratch)?.complement(mesh.vertex_count())),
            Self::And(parts) => {
                // Parts are evaluated even when nothing is left, so that an unknown vertex is always told.
                let mut common: Option<Selection> = None;
                for part in parts {
                    let selection = part.select(mesh, scratch)?;
                    common = Some(match common {
                        Some(common) => common.intersection(&selection),
                        None => selection,
                    });
                }
                Ok(common.unwrap_or_default())
            }
            Self::Or(parts) => {
                // Many small parts are gathered before they are merged, so that the sum of them is not paid for each.
                let (mut merged, mut gathered) = (Selection::empty(), Vec::new());
                for part in parts {
                    gathered.extend_from_slice(part.select(mesh, scratch)?.vertices());
                    if gathered.len() > merged.len() {
                        merged = merged.union(&gathered.drain(..).collect());
                    }
                }
                Ok(merged.union(&gathered.into_iter().collect()))
            }
        }
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Display for Node {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (sign, parts) = match self {
            Self::Criterion(criterion) => return criterion.fmt(f),
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
    /// Writes a part of this node, in parentheses if it binds less tightly.
    fn write_part(&self, part: &Self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if part.binding() < self.binding() { write!(f, "({part})") } else { write!(f, "{part}") }
    }

    fn binding(&self) -> u8 {
        match self {
            Self::Or(_) => 0,
            Self::And(_) => 1,
            Self::Not(_) => 2,
            Self::Criterion(_) => 3,
        }
    }
}
