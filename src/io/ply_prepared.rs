//! A PLY file before serde-ply: where its lines and values are, and what its header says that serde-ply passes over.
//!
//! Here is mended what serde-ply does not take: headers whose comments are not UTF-8, lines that end with a lone `\r`, a last
//! line without an end.
//!
//! **Deliberately not here**: the elements and their values; those serde-ply reads.

use std::borrow::Cow;

use super::notes::{self, Note, NoteKind};
use super::text::{Words, normalize, shown};
use crate::error::{ReadError, ReadErrorKind};

/// A file as serde-ply may see it.
pub(super) struct Prepared<'a> {
    pub(super) data: Cow<'a, [u8]>,
    /// Where the header ends.
    pub(super) body: usize,
    is_text: bool,
    /// The bytes of the file.
    length: usize,
}

impl<'a> Prepared<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, ReadError> {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(ReadError::whole(ReadErrorKind::Empty));
        }
        let length = bytes.len();
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let (head, body) = bytes.split_at(header_length(bytes)?);
        let is_text = lines(head).any(|line| Words::new(line).take(2).eq([&b"format"[..], b"ascii"]));
        let has_lines = head.ends_with(b"\n");
        let is_whole = !is_text || bytes.ends_with(b"\n");
        if has_lines && is_whole && std::str::from_utf8(head).is_ok() {
            return Ok(Self { data: Cow::Borrowed(bytes), body: head.len(), is_text, length });
        }
        let mut head = String::from_utf8_lossy(head).into_owned();
        if !has_lines {
            head = head.replace('\r', "\n") + if head.ends_with('\r') { "" } else { "\n" };
        }
        let head_length = head.len();
        let mut data = head.into_bytes();
        if is_text {
            data.extend_from_slice(&normalize(body)?);
            data.push(b'\n');
        } else {
            data.extend_from_slice(body);
        }
        Ok(Self { data: Cow::Owned(data), body: head_length, is_text, length })
    }

    /// The line of the header at which the element `k` starts.
    pub(super) fn line_of_element(&self, k: usize) -> usize {
        let is_element = |line: &[u8]| Words::new(line).next() == Some(b"element");
        let starts = lines(&self.data[..self.body]).enumerate().filter(|(_, line)| is_element(line));
        starts.map(|(line, _)| line + 1).nth(k).unwrap_or(1)
    }

    /// What the header says beside elements and comments is told.
    pub(super) fn tell_of_header(&self, notes: &mut Vec<Note>) {
        for (line, text) in lines(&self.data[..self.body]).enumerate() {
            let mut words = Words::new(text);
            match words.next() {
                None | Some(b"ply" | b"format" | b"element" | b"property" | b"obj_info" | b"end_header") => {}
                Some(b"comment") if words.next() != Some(b"TextureFile") => {}
                Some(b"comment") => notes::count(notes, NoteKind::Rendering, line + 1),
                Some(word) => notes::count(notes, NoteKind::Unknown(shown(word)), line + 1),
            }
        }
    }

    /// An error that was found when so many bytes were read.
    pub(super) fn at(&self, read: usize, kind: ReadErrorKind) -> ReadError {
        if !self.is_text && read > self.body {
            // Only the header may have become longer or shorter.
            return ReadError::behind(self.length - (self.data.len() - read), kind);
        }
        // Of the blank behind a word at the end of a line the next line would begin.
        let line = 1 + self.data[..read.saturating_sub(1)].iter().filter(|&&byte| byte == b'\n').count();
        ReadError::at(line, kind)
    }

    /// The last word of what was read; of a binary file, none.
    pub(super) fn last_word(&self, read: usize) -> &[u8] {
        if !self.is_text {
            return b"";
        }
        let text = self.data[..read].trim_ascii_end();
        text.rsplit(u8::is_ascii_whitespace).next().unwrap_or_default()
    }

    /// Refuses what stands behind the last value.
    pub(super) fn nothing_follows(&self, read: usize) -> Result<(), ReadErrorKind> {
        let rest = &self.data[read..];
        if !self.is_text {
            return if rest.is_empty() { Ok(()) } else { Err(ReadErrorKind::TrailingBytes(rest.len())) };
        }
        match rest.split(u8::is_ascii_whitespace).find(|word| !word.is_empty()) {
            Some(word) => Err(ReadErrorKind::Trailing(shown(word))),
            None => Ok(()),
        }
    }
}

/// The lines of a header.
fn lines(head: &[u8]) -> impl Iterator<Item = &[u8]> {
    head.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii)
}

/// How long the header is, with the end of its last line.
fn header_length(bytes: &[u8]) -> Result<usize, ReadError> {
    const LAST: &[u8] = b"end_header";
    let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
    // A binary file may hold anything behind, so the first line that is it ends the header.
    let mut start = 0;
    let mut line = 1;
    while start < bytes.len() {
        let length = bytes[start..].iter().position(is_end).unwrap_or(bytes.len() - start);
        let end = match &bytes[start + length..] {
            [b'\r', b'\n', ..] => start + length + 2,
            [] => start + length,
            [..] => start + length + 1,
        };
        if bytes[start..start + length].trim_ascii() == LAST {
            // Where lone `\r` end lines a `\n` behind the last belongs to the values.
            let is_mac = !bytes[..start].contains(&b'\n');
            return Ok(if is_mac { (start + length + 1).min(bytes.len()) } else { end });
        }
        (start, line) = (end, line + 1);
    }
    Err(ReadError::at(line - 1, ReadErrorKind::UnexpectedEnd("the line 'end_header'".to_owned())))
}
