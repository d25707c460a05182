//! What stands after the name of a criterion: fields separated by commas, or a file.

use std::cell::Cell;
use std::io;
use std::path::{Path, PathBuf};

use super::Expression;
use crate::error::{ConfigError, ExpressionError, ExpressionErrorKind};
use crate::id::VertexId;
use crate::length::Length;
use crate::select::criteria::Comparison;

/// Who answers with the text of a file.
pub(super) type ReadFile<'r> = &'r mut dyn FnMut(&Path) -> io::Result<String>;

/// The whole text, which knows the column of a place in it.
#[derive(Clone, Copy)]
pub(super) struct Text<'t>(pub(super) &'t str);

impl Text<'_> {
    /// The column of a byte: characters from 1.
    pub(super) fn column(self, at: usize) -> usize {
        self.0[..at].chars().count() + 1
    }

    /// The first byte from this one on that is no blank.
    pub(super) fn after_blanks(self, at: usize) -> usize {
        self.0.len() - self.0[at..].trim_start().len()
    }

    /// An error at a byte.
    pub(super) fn error(self, at: usize, kind: ExpressionErrorKind) -> ExpressionError {
        ExpressionError { column: self.column(at), kind }
    }

    /// The error that something else should stand at a byte, or behind the blanks there.
    pub(super) fn expected(self, at: usize, expected: impl Into<String>) -> ExpressionError {
        let at = self.after_blanks(at);
        self.error(at, ExpressionErrorKind::Expected { expected: expected.into(), found: self.found(at) })
    }

    /// What stands at a byte, for a message: one sign, or a word up to the next sign or blank.
    fn found(self, at: usize) -> String {
        let rest = &self.0[at..];
        let Some(first) = rest.chars().next() else { return "the end".to_owned() };
        let ends = |c: char| is_sign(c) || c.is_whitespace();
        let word = if ends(first) { &rest[..first.len_utf8()] } else { rest.split(ends).next().unwrap_or(rest) };
        format!("`{}`", excerpt(word))
    }
}

/// Whether a character has a meaning of its own outside of file names.
pub(super) fn is_sign(c: char) -> bool {
    matches!(c, '|' | '&' | '!' | '(' | ')' | ':' | ',')
}

/// The start of a text, fit to be printed.
pub(super) fn excerpt(text: &str) -> String {
    const LENGTH: usize = 40;
    let mut start: String =
        text.chars().take(LENGTH).map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect();
    if text.chars().nth(LENGTH).is_some() {
        start.push_str("...");
    }
    start
}

/// The lists of values, one a level, that stand in place of single ones.
#[derive(Debug, Default)]
pub(super) struct Lists {
    /// The level that is read, from 0.
    pub(super) level: Cell<usize>,
    /// Whether the criterion that is read has a list.
    pub(super) found: Cell<bool>,
    /// How long the first list is, and where it stands; all others are as long.
    pub(super) first: Cell<Option<(usize, usize)>>,
}

/// What stands between the `:` of a criterion and the end of its arguments.
pub(super) struct Argument<'t, 'l> {
    pub(super) lists: &'l Lists,
    pub(super) whole: Text<'t>,
    /// Where `text` stands in the whole.
    pub(super) at: usize,
    /// The fields, or the name of the file; without blanks around it.
    pub(super) text: &'t str,
    /// Whether it is the name of a file.
    pub(super) is_file: bool,
    /// How the criterion is written.
    pub(super) form: &'static str,
}

impl<'t, 'l> Argument<'t, 'l> {
    /// Whether nothing stands there.
    pub(super) fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// The fields, at least one.
    pub(super) fn fields(&self) -> impl Iterator<Item = Field<'t, 'l>> {
        let (lists, whole, form) = (self.lists, self.whole, self.form);
        let mut next = self.at;
        self.text.split(',').map(move |text| {
            let at = next + (text.len() - text.trim_start().len());
            next += text.len() + 1;
            Field { lists, whole, at, text: text.trim(), form }
        })
    }

    /// The fields, if there are so many.
    pub(super) fn exactly<const N: usize>(&self) -> Result<[Field<'t, 'l>; N], ExpressionError> {
        if self.is_file {
            return Err(self.wrong_count(N, "a file".to_owned()));
        }
        if self.is_empty() {
            return Err(self.wrong_count(N, "none".to_owned()));
        }
        // One more than wanted is enough to refuse.
        let fields: Vec<Field<'t, 'l>> = self.fields().take(N + 1).collect();
        fields.try_into().map_err(|_| self.wrong_count(N, self.fields().count().to_string()))
    }

    /// The only field, as it is at the level that is read: it may be a list of values.
    pub(super) fn threshold(&self) -> Result<Field<'t, 'l>, ExpressionError> {
        let [threshold] = self.exactly()?;
        threshold.at_level()
    }

    fn wrong_count(&self, wanted: usize, found: String) -> ExpressionError {
        let plural = if wanted == 1 { "" } else { "s" };
        let expected = format!("{wanted} argument{plural} as in `{}`", self.form);
        self.whole.error(self.at, ExpressionErrorKind::Expected { expected, found })
    }

    /// All ids of a list, or of the file that holds it; there may be none.
    pub(super) fn ids<T: Id>(&self, read: ReadFile<'_>) -> Result<Vec<T>, ExpressionError> {
        if !self.is_file {
            let listed = self.fields().filter(|_| !self.is_empty());
            return listed.map(|field| field.id()).collect();
        }
        let path = PathBuf::from(self.text);
        let text = match read(&path) {
            Ok(text) => text,
            Err(cause) => return Err(self.whole.error(self.at, ExpressionErrorKind::File { path, cause })),
        };
        let mut ids = Vec::new();
        // Some editors start a file with a byte order mark.
        for (k, line) in text.strip_prefix('\u{feff}').unwrap_or(&text).lines().enumerate() {
            let listed = line.split('#').next().unwrap_or_default();
            for id in listed.split(|c: char| c == ',' || c.is_whitespace()).filter(|id| !id.is_empty()) {
                match T::read(id, T::NAME) {
                    Ok(id) => ids.push(id),
                    Err(error) => {
                        let kind = ExpressionErrorKind::FileLine { path, line: k + 1, error };
                        return Err(self.whole.error(self.at, kind));
                    }
                }
            }
        }
        Ok(ids)
    }
}

/// One of several arguments.
pub(super) struct Field<'t, 'l> {
    lists: &'l Lists,
    whole: Text<'t>,
    at: usize,
    text: &'t str,
    form: &'static str,
}

impl<'t> Field<'t, '_> {
    /// The value of the level that is read, of a threshold that may be a list of values: `a/b/c`.
    pub(super) fn at_level(mut self) -> Result<Self, ExpressionError> {
        let Lists { level, found, first } = self.lists;
        let length = self.text.split('/').count();
        if length == 1 {
            return Ok(self);
        }
        let expected = match first.get() {
            Some((longest, at)) if longest != length => {
                format!("{longest} values as in column {}", self.whole.column(at))
            }
            None if length > Expression::MAX_LEVELS => format!("at most {} values", Expression::MAX_LEVELS),
            _ => {
                found.set(true);
                first.set(first.get().or(Some((length, self.at))));
                let before: usize = self.text.split('/').take(level.get()).map(|value| value.len() + 1).sum();
                let value = self.text[before..].split('/').next().unwrap_or_default();
                self.at = self.whole.after_blanks(self.at + before);
                self.text = value.trim();
                return Ok(self);
            }
        };
        let found = format!("{length}");
        Err(self.whole.error(self.at, ExpressionErrorKind::Expected { expected, found }))
    }

    /// The id of a vertex.
    pub(super) fn vertex(&self, name: &'static str) -> Result<VertexId, ExpressionError> {
        self.read(name, |text| VertexId::read(text, name))
    }

    /// One id of a list.
    fn id<T: Id>(&self) -> Result<T, ExpressionError> {
        self.read(T::NAME, |text| T::read(text, T::NAME))
    }

    /// A number of things.
    pub(super) fn count(&self, name: &'static str) -> Result<usize, ExpressionError> {
        self.read(name, |text| {
            count(text)
                .ok_or_else(|| value_error(text, name, format!("expected a whole number from 0 to {}", usize::MAX)))
        })
    }

    /// A finite number.
    pub(super) fn number(&self, name: &'static str) -> Result<f64, ExpressionError> {
        self.read(name, |text| match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(value_error(text, name, "expected a finite number".to_owned())),
        })
    }

    /// A length, with `%` behind it relative to the size of the mesh.
    pub(super) fn length(self, name: &'static str) -> Result<Length, ExpressionError> {
        let mut number = self;
        let make = if number.take_suffix("%") { Length::percent } else { Length::absolute };
        make(number.number(name)?).map_err(|error| number.refused(error))
    }

    /// What stands before the first sign that compares, the sign, and what stands behind it.
    pub(super) fn comparison(self) -> Result<(&'t str, Comparison, Self), ExpressionError> {
        let found = self.text.find(['<', '>']).and_then(|at| {
            let (name, rest) = self.text.split_at(at);
            let comparison = Comparison::ALL.into_iter().find(|comparison| rest.starts_with(comparison.sign()))?;
            Some((name.trim_end(), comparison, at + comparison.sign().len()))
        });
        let Some((name, comparison, length)) = found else {
            return Err(self.is_not("field", "expected `>`, `>=`, `<` or `<=` in it"));
        };
        if name.is_empty() {
            return Err(self.is_not("field", "expected its name before the sign"));
        }
        Ok((name, comparison, self.behind(length)))
    }

    /// Cuts off `key` and the `=` behind it at the start, if they stand there.
    pub(super) fn take_key(&mut self, key: &str) -> bool {
        let rest = self.text.strip_prefix(key).and_then(|rest| rest.trim_start().strip_prefix('='));
        if let Some(rest) = rest {
            *self = self.behind(self.text.len() - rest.len());
        }
        rest.is_some()
    }

    /// What stands behind so many bytes.
    fn behind(&self, length: usize) -> Self {
        let text = self.text[length..].trim_start();
        Self { at: self.at + (self.text.len() - text.len()), text, ..*self }
    }

    /// The error that this is no such value.
    pub(super) fn is_not(&self, name: &'static str, expected: &str) -> ExpressionError {
        self.refused(value_error(self.text, name, expected.to_owned()))
    }

    /// Cuts off what stands at the end, if it does.
    pub(super) fn take_suffix(&mut self, suffix: &str) -> bool {
        let rest = self.text.strip_suffix(suffix);
        if let Some(rest) = rest {
            self.text = rest.trim_end();
        }
        rest.is_some()
    }

    /// The error that the criterion refused this value.
    pub(super) fn refused(&self, error: ConfigError) -> ExpressionError {
        self.whole.error(self.at, ExpressionErrorKind::Value(error))
    }

    fn read<T>(&self, name: &str, parse: impl FnOnce(&str) -> Result<T, ConfigError>) -> Result<T, ExpressionError> {
        if self.text.is_empty() {
            return Err(self.whole.expected(self.at, format!("{name} as in `{}`", self.form)));
        }
        parse(self.text).map_err(|error| self.refused(error))
    }
}

/// What lists can name by numbers.
pub(super) trait Id: Sized {
    /// What it is.
    const NAME: &'static str;

    /// Reads an argument of this name.
    fn read(text: &str, name: &'static str) -> Result<Self, ConfigError>;
}

impl Id for VertexId {
    const NAME: &'static str = "vertex";

    fn read(text: &str, name: &'static str) -> Result<Self, ConfigError> {
        count(text).and_then(Self::try_new).ok_or_else(|| {
            let expected = format!("expected the id of a vertex, a whole number from 0 to {}", Self::MAX_INDEX);
            value_error(text, name, expected)
        })
    }
}

/// The number of a face.
impl Id for usize {
    const NAME: &'static str = "face";

    fn read(text: &str, name: &'static str) -> Result<Self, ConfigError> {
        let expected = || "expected the number of a face, a whole number from 0".to_owned();
        count(text).ok_or_else(|| value_error(text, name, expected()))
    }
}

/// A number of digits alone; the standard parser takes a sign too.
fn count(text: &str) -> Option<usize> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

fn value_error(text: &str, name: &'static str, expected: String) -> ConfigError {
    ConfigError { name, value: excerpt(text), expected }
}
