//! Lines of numbers, and bytes, written fast and so that reading gives the same bits.

use std::io::{self, Write};

use glam::DVec3;

use crate::mesh::Mesh;
use crate::soup::FaceList;

/// What can be written to a file of faces: a [`Mesh`] or a [`FaceList`].
pub trait Surface {
    /// The positions of all vertices, used or not.
    fn positions(&self) -> &[DVec3];

    /// How many faces there are.
    fn face_count(&self) -> usize;

    /// Calls `each` with the corners of every face, in the order of the faces, until it fails.
    ///
    /// # Errors
    /// The first of `each`.
    fn try_for_each_face<E>(&self, each: impl FnMut(&[u32]) -> Result<(), E>) -> Result<(), E>;
}

impl Surface for Mesh {
    fn positions(&self) -> &[DVec3] {
        self.positions()
    }

    fn face_count(&self) -> usize {
        self.face_count()
    }

    fn try_for_each_face<E>(&self, mut each: impl FnMut(&[u32]) -> Result<(), E>) -> Result<(), E> {
        self.triangles().try_for_each(|triangle| each(&triangle.corners().map(|v| v.index() as u32)))
    }
}

impl Surface for FaceList {
    fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    fn face_count(&self) -> usize {
        self.face_count()
    }

    fn try_for_each_face<E>(&self, each: impl FnMut(&[u32]) -> Result<(), E>) -> Result<(), E> {
        self.faces().try_for_each(each)
    }
}

/// Bytes gathered before they go to the writer.
const GATHERED: usize = 1 << 16;

/// Lines, or bytes, on their way to a writer.
pub(super) struct Lines<'a, W: Write> {
    out: &'a mut W,
    buffer: Vec<u8>,
}

impl<'a, W: Write> Lines<'a, W> {
    pub(super) fn new(out: &'a mut W) -> Self {
        Self { out, buffer: Vec::with_capacity(GATHERED + 256) }
    }

    pub(super) fn text(&mut self, text: &str) -> io::Result<()> {
        self.bytes(text.as_bytes())
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.buffer.extend_from_slice(bytes);
        self.pass_on()
    }

    /// A whole number, without a blank.
    pub(super) fn integer(&mut self, value: usize) {
        push_integer(&mut self.buffer, value as u64);
    }

    /// A number, without a blank.
    #[cfg(feature = "matrix")]
    pub(super) fn float(&mut self, value: f64) {
        push_float(&mut self.buffer, value);
    }

    /// Numbers with blanks between, and the end of the line.
    pub(super) fn numbers(&mut self, values: &[f64]) -> io::Result<()> {
        for (k, &value) in values.iter().enumerate() {
            if k > 0 {
                self.buffer.push(b' ');
            }
            push_float(&mut self.buffer, value);
        }
        self.buffer.push(b'\n');
        self.pass_on()
    }

    /// A blank and a corner of OBJ: `v`, `v/vt`, `v//vn` or `v/vt/vn`, of indices from 0.
    pub(super) fn corner(&mut self, v: u32, texture: Option<usize>, normal: Option<usize>) -> io::Result<()> {
        self.buffer.push(b' ');
        push_integer(&mut self.buffer, u64::from(v) + 1);
        if texture.is_some() || normal.is_some() {
            self.buffer.push(b'/');
        }
        if let Some(index) = texture {
            push_integer(&mut self.buffer, index as u64 + 1);
        }
        if let Some(index) = normal {
            self.buffer.push(b'/');
            push_integer(&mut self.buffer, index as u64 + 1);
        }
        self.pass_on()
    }

    /// A blank and an index for each corner, and the end of the line.
    pub(super) fn corners(&mut self, corners: &[u32], counted_from: u64) -> io::Result<()> {
        for &corner in corners {
            self.buffer.push(b' ');
            push_integer(&mut self.buffer, u64::from(corner) + counted_from);
            self.pass_on()?;
        }
        self.buffer.push(b'\n');
        Ok(())
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.out.write_all(&self.buffer)?;
        self.buffer.clear();
        self.out.flush()
    }

    fn pass_on(&mut self) -> io::Result<()> {
        if self.buffer.len() >= GATHERED {
            self.out.write_all(&self.buffer)?;
            self.buffer.clear();
        }
        Ok(())
    }
}

/// The shortest decimal that is read back as the same number, with an exponent where plain digits would be long.
pub(super) fn push_float(buffer: &mut Vec<u8>, value: f64) {
    let mut digits = zmij::Buffer::new();
    let text = digits.format(value);
    buffer.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
}

pub(super) fn push_integer(buffer: &mut Vec<u8>, value: u64) {
    buffer.extend_from_slice(itoa::Buffer::new().format(value).as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_keep_their_bits_and_stay_short() {
        for (value, text) in [
            (0.1, "0.1"),
            (-0.0, "-0"),
            (3.0, "3"),
            (1e300, "1e+300"),
            (f64::MIN_POSITIVE, "2.2250738585072014e-308"),
            (5e-324, "5e-324"),
            (1e-5, "0.00001"),
            (f64::NEG_INFINITY, "-inf"),
        ] {
            let mut buffer = Vec::new();
            push_float(&mut buffer, value);
            assert_eq!(std::str::from_utf8(&buffer), Ok(text));
            assert_eq!(text.parse().map(f64::to_bits), Ok(value.to_bits()));
        }
    }

    #[test]
    fn integers_have_all_their_digits() {
        for value in [0, 9, 10, u64::MAX] {
            let mut buffer = Vec::new();
            push_integer(&mut buffer, value);
            assert_eq!(String::from_utf8(buffer), Ok(value.to_string()));
        }
    }
}
