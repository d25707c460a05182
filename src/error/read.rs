//! A file could not be read.

use std::fmt;
use std::path::PathBuf;

use crate::id::VertexId;

/// Why a file could not be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// The file system said no.
    Io(std::io::Error),
    /// Neither the ending of the name nor the content tells the format.
    UnknownFormat,
    /// The format is known and not read: its name.
    Unsupported(&'static str),
    /// Nothing stands in the file, or nothing but comments and blanks.
    Empty,
    /// There is no vertex in it.
    NoVertex,
    /// The file ends in the middle: what should have come next.
    UnexpectedEnd(String),
    /// Values stand after what the header announced: the first of them.
    Trailing(String),
    /// A number was expected: what stands there.
    NotANumber(String),
    /// A whole number was expected: what stands there.
    NotAnInteger(String),
    /// The header of a PLY file is not as it should be: in which way.
    Header(String),
    /// A value of a PLY file does not fit the type that the header gives its property.
    NotOfType {
        /// The property, with its type.
        property: String,
        /// What stands there.
        found: String,
    },
    /// Bytes stand after what the header announced: how many.
    TrailingBytes(usize),
    /// Another word was expected.
    Word {
        /// The word, or what it stands for.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A statement has too few or too many numbers.
    NumberCount {
        /// What the numbers are.
        of: &'static str,
        /// How many there should be.
        expected: &'static str,
        /// How many there are.
        found: usize,
    },
    /// An index is 0 where they count from 1.
    IndexZero {
        /// What it points to.
        of: &'static str,
    },
    /// An index points to nothing.
    IndexOutOfRange {
        /// What it points to.
        of: &'static str,
        /// The index as it stands in the file.
        index: i64,
        /// How many there are to point to.
        count: usize,
    },
    /// A tag line is not of the form that its name asks for.
    Tag {
        /// The form.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A tag names an edge between two vertices that have none.
    NoEdge([VertexId; 2]),
    /// A face has fewer than three corners.
    TooFewCorners(usize),
    /// More of this than 32-bit ids can name.
    TooMany(&'static str),
}

/// A file could not be read: which one, and the line or byte at which that was found.
#[derive(Debug)]
pub struct ReadError {
    /// The file, if the bytes came from one.
    pub path: Option<PathBuf>,
    /// The line, from 1, if one is to blame.
    pub line: Option<usize>,
    /// How many bytes were read before, in a binary part.
    pub byte: Option<usize>,
    /// What is wrong with it.
    pub kind: ReadErrorKind,
}

impl ReadError {
    /// An error of a whole file.
    pub(crate) fn whole(kind: ReadErrorKind) -> Self {
        Self { path: None, line: None, byte: None, kind }
    }

    /// An error at a line.
    pub(crate) fn at(line: usize, kind: ReadErrorKind) -> Self {
        Self { path: None, line: Some(line), byte: None, kind }
    }

    /// An error behind so many bytes.
    pub(crate) fn behind(byte: usize, kind: ReadErrorKind) -> Self {
        Self { path: None, line: None, byte: Some(byte), kind }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(path) = &self.path {
            write!(f, "{}: ", path.display())?;
        }
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        if let Some(byte) = self.byte {
            write!(f, "byte {byte}: ")?;
        }
        write!(f, "{}", self.kind)
    }
}

impl fmt::Display for ReadErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::UnknownFormat => {
                write!(
                    f,
                    "neither the ending nor the content tells the format; OBJ (.obj), OFF (.off), PLY (.ply) and STL (.stl) \
                     are read"
                )
            }
            Self::Unsupported(format) => {
                write!(f, "this is {format}, which is not read; convert it to plain-text OBJ or OFF")
            }
            Self::Empty => write!(f, "the file is empty; expected a mesh in OBJ, OFF, PLY or STL"),
            Self::NoVertex => write!(f, "there is no vertex in the file; expected lines 'v x y z'"),
            Self::UnexpectedEnd(expected) => write!(f, "unexpected end of the file, expected {expected}"),
            Self::Trailing(found) => {
                write!(f, "'{found}' stands after the last face; the counts in the header do not fit the file")
            }
            Self::NotANumber(found) => write!(f, "expected a number, found '{found}'"),
            Self::NotAnInteger(found) => write!(f, "expected a whole number, found '{found}'"),
            Self::Header(what) => write!(f, "the header is wrong: {what}"),
            Self::NotOfType { property, found } => write!(f, "'{found}' does not fit the property {property}"),
            Self::TrailingBytes(found) => {
                write!(f, "{found} bytes stand after the last value; the counts in the header do not fit the file")
            }
            Self::Word { expected, found } => write!(f, "expected {expected}, found '{found}'"),
            Self::NumberCount { of, expected, found } => write!(f, "{of} has {expected} numbers, found {found}"),
            Self::IndexZero { of } => write!(f, "index out of range: {of} 0, indices count from 1"),
            Self::IndexOutOfRange { of, index, count } => {
                write!(f, "index out of range: {of} {index}, there are {count}")
            }
            Self::Tag { expected, found } => write!(f, "expected {expected}, found '{found}'"),
            Self::NoEdge([a, b]) => {
                write!(f, "there is no edge between the vertices {} and {}, counted from 0", a.index(), b.index())
            }
            Self::TooFewCorners(found) => write!(f, "a face has at least 3 corners, found {found}"),
            Self::TooMany(what) => write!(f, "more {what} than 32-bit ids can name; split the file"),
        }
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.kind {
            ReadErrorKind::Io(error) => Some(error),
            _ => None,
        }
    }
}
