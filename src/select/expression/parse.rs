//! From text to a tree, by recursive descent:
//!
//! ```text
//! either = both { "|" both }
//! both   = single { "&" single }
//! single = "!" single | "(" either ")" | name [ ":" argument ]
//! ```

use super::argument::{Argument, Lists, ReadFile, Text, excerpt, is_sign};
use super::known::{Known, Made, Make};
use super::{Expression, Node};
use crate::camera::Camera;
use crate::error::{ExpressionError, ExpressionErrorKind};

/// Reads a whole text.
pub(super) fn parse(text: &str, camera: Option<Camera>, read: ReadFile<'_>) -> Result<Expression, ExpressionError> {
    let lists = Lists::default();
    let mut parser = Parser { whole: Text(text), at: 0, depth: 0, lists: &lists, camera, uses_camera: false, read };
    let node = parser.either()?;
    match parser.rest() {
        "" => {
            let level_count = lists.first.get().map(|(length, _)| length);
            Ok(Expression { node, level_count, uses_camera: parser.uses_camera })
        }
        _ => Err(parser.expected("`|`, `&` or the end")),
    }
}

struct Parser<'t, 'r> {
    whole: Text<'t>,
    /// The byte that is read next; blanks before it are skipped.
    at: usize,
    /// How many parentheses and `!` stand around it.
    depth: usize,
    lists: &'r Lists,
    camera: Option<Camera>,
    /// Whether a criterion asked for it.
    uses_camera: bool,
    read: ReadFile<'r>,
}

impl<'t, 'r> Parser<'t, 'r> {
    fn either(&mut self) -> Result<Node, ExpressionError> {
        let mut parts = Vec::new();
        loop {
            match self.both()? {
                Node::Or(inner) => parts.extend(inner),
                other => parts.push(other),
            }
            if !self.take("|") {
                return Ok(alone_or(parts, Node::Or));
            }
        }
    }

    fn both(&mut self) -> Result<Node, ExpressionError> {
        let mut parts = Vec::new();
        loop {
            match self.single()? {
                Node::And(inner) => parts.extend(inner),
                other => parts.push(other),
            }
            if !self.take("&") {
                return Ok(alone_or(parts, Node::And));
            }
        }
    }

    fn single(&mut self) -> Result<Node, ExpressionError> {
        self.skip_blanks();
        let start = self.at;
        if self.take("!") {
            let inner = self.nested(start, Self::single)?;
            return Ok(Node::Not(Box::new(inner)));
        }
        if self.take("(") {
            let inner = self.nested(start, Self::either)?;
            if !self.take(")") {
                let column = self.whole.column(start);
                return Err(self.expected(&format!("`|`, `&` or the `)` to the `(` in column {column}")));
            }
            return Ok(inner);
        }
        self.criterion()
    }

    /// Reads something inside of a parenthesis or a `!` that stands at a byte.
    fn nested(
        &mut self,
        start: usize,
        read: fn(&mut Self) -> Result<Node, ExpressionError>,
    ) -> Result<Node, ExpressionError> {
        if self.depth == Expression::MAX_DEPTH {
            return Err(self.whole.error(start, ExpressionErrorKind::TooDeep { allowed: Expression::MAX_DEPTH }));
        }
        self.depth += 1;
        let node = read(self)?;
        self.depth -= 1;
        Ok(node)
    }

    fn criterion(&mut self) -> Result<Node, ExpressionError> {
        let rest = self.rest();
        let name = rest.split(|c: char| is_sign(c) || c.is_whitespace()).next().unwrap_or(rest);
        if name.is_empty() {
            return Err(self.expected("a criterion, `!` or `(`"));
        }
        let Some(known) = Known::find(name) else {
            let known = Expression::known_criteria().collect();
            let kind = ExpressionErrorKind::UnknownCriterion { name: excerpt(name), known };
            return Err(self.whole.error(self.at, kind));
        };
        let start = self.at;
        self.at += name.len();
        match known.make {
            Make::Alone(make) => Ok(Node::Criterion(make())),
            Make::From(make) => {
                let argument = self.argument(known)?;
                self.per_level(known, &argument, |read| make(&argument, read))
            }
            Make::Faces(make) => make(&self.argument(known)?, self.read).map(Node::Faces),
            Make::Field(make) => make(&self.argument(known)?).map(Node::Field),
            Make::Seen(make) => Ok(Node::Criterion(make(self.camera(start, known)?))),
            Make::SeenFrom(make) => {
                let camera = self.camera(start, known)?;
                let argument = self.argument(known)?;
                self.per_level(known, &argument, |_| make(camera, &argument))
            }
        }
    }

    /// Makes a criterion once, or for each value of its lists if it has any.
    fn per_level(
        &mut self,
        known: &Known,
        argument: &Argument<'_, '_>,
        mut make: impl FnMut(ReadFile<'_>) -> Made,
    ) -> Result<Node, ExpressionError> {
        let Lists { level, found, first } = self.lists;
        level.set(0);
        found.set(false);
        let mut terms = vec![make(self.read)?];
        while found.get() && first.get().is_some_and(|(length, _)| terms.len() < length) {
            level.set(terms.len());
            terms.push(make(self.read)?);
        }
        Ok(match found.get() {
            true => Node::PerLevel { text: written(known.name, argument.text), terms },
            false => Node::Criterion(terms.remove(0)),
        })
    }

    /// The camera, for a criterion whose name stands at a byte.
    fn camera(&mut self, start: usize, known: &Known) -> Result<Camera, ExpressionError> {
        self.uses_camera = true;
        self.camera.ok_or_else(|| self.whole.error(start, ExpressionErrorKind::NoCamera { criterion: known.name }))
    }

    /// Reads what stands behind the name of a criterion.
    fn argument(&mut self, known: &Known) -> Result<Argument<'t, 'r>, ExpressionError> {
        let form = known.forms[0];
        if !self.take(":") {
            return Err(self.expected(&format!("`:` and arguments as in `{form}`")));
        }
        let is_file = self.take("@");
        self.skip_blanks();
        let (whole, at) = (self.whole, self.at);
        let text = if is_file && self.take("\"") {
            // Blanks in quotes belong to the name.
            let rest = &whole.0[self.at..];
            let Some(length) = rest.find('"') else {
                let column = whole.column(at);
                self.at = whole.0.len();
                return Err(self.expected(&format!("the `\"` to the one in column {column}")));
            };
            self.at += length + 1;
            &rest[..length]
        } else {
            let rest = self.rest();
            let text = &rest[..rest.find(['|', '&', ')']).unwrap_or(rest.len())];
            self.at += text.len();
            text.trim_end()
        };
        if is_file && text.is_empty() {
            return Err(whole.expected(at, "the name of a file"));
        }
        Ok(Argument { lists: self.lists, whole, at, text, is_file, form })
    }

    /// Skips blanks and the sign behind them, if it stands there.
    fn take(&mut self, sign: &str) -> bool {
        let found = self.rest().starts_with(sign);
        if found {
            self.at += sign.len();
        }
        found
    }

    /// What is left to be read, without blanks before it.
    fn rest(&mut self) -> &'t str {
        self.skip_blanks();
        &self.whole.0[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at = self.whole.after_blanks(self.at);
    }

    /// The error that something else should stand here.
    fn expected(&self, expected: &str) -> ExpressionError {
        self.whole.expected(self.at, expected)
    }
}

/// A criterion with lists, without blanks.
fn written(name: &str, argument: &str) -> String {
    let mut text = format!("{name}:{argument}");
    text.retain(|c| !c.is_whitespace());
    text
}

/// A part that stands alone as it is, several as a chain.
fn alone_or(mut parts: Vec<Node>, chain: fn(Vec<Node>) -> Node) -> Node {
    if parts.len() == 1 { parts.remove(0) } else { chain(parts) }
}
