//! Bytes as lines, words and numbers: what the readers share.

use std::borrow::Cow;

use crate::error::{ReadError, ReadErrorKind};

/// The blanks at which tobj splits a line too, as far as they are ASCII.
#[inline]
pub(super) fn is_blank(byte: u8) -> bool {
    matches!(byte, 9..=13 | b' ')
}

/// The text without its byte order mark, with `\n` at the ends of lines even if it had a lone `\r` there.
pub(super) fn normalize(bytes: &[u8]) -> Result<Cow<'_, [u8]>, ReadError> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(ReadError::whole(ReadErrorKind::Unsupported("text in UTF-16")));
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if text.contains(&b'\n') || !text.contains(&b'\r') {
        return Ok(Cow::Borrowed(text));
    }
    Ok(Cow::Owned(text.iter().map(|&byte| if byte == b'\r' { b'\n' } else { byte }).collect()))
}

/// The words of one line, up to a word that starts with `#`.
///
/// A `#` inside a word opens no comment: `1.#QNAN` must not be read as `1.`.
#[derive(Clone)]
pub(super) struct Words<'a> {
    line: &'a [u8],
    at: usize,
}

impl<'a> Words<'a> {
    pub(super) fn new(line: &'a [u8]) -> Self {
        Self { line, at: 0 }
    }

    /// Where the last word ended.
    pub(super) fn end(&self) -> usize {
        self.at
    }

    /// Whether nothing follows the last word, not even a comment.
    pub(super) fn next_is_end(&self) -> bool {
        self.line[self.at..].iter().all(|&byte| is_blank(byte))
    }

    /// What follows the last word, blanks at both ends and a trailing comment cut off.
    pub(super) fn rest(&self) -> Cow<'a, str> {
        let mut rest = self.line[self.at..].trim_ascii();
        let comment = (0..rest.len()).find(|&k| rest[k] == b'#' && (k == 0 || is_blank(rest[k - 1])));
        if let Some(start) = comment {
            rest = rest[..start].trim_ascii_end();
        }
        String::from_utf8_lossy(rest)
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let mut start = self.at;
        while start < self.line.len() && is_blank(self.line[start]) {
            start += 1;
        }
        if start == self.line.len() || self.line[start] == b'#' {
            return None;
        }
        let mut end = start + 1;
        while end < self.line.len() && !is_blank(self.line[end]) {
            end += 1;
        }
        self.at = end;
        Some(&self.line[start..end])
    }
}

/// The words of a text, which knows the line it is in.
pub(super) struct Stream<'a> {
    /// What follows the current line.
    rest: &'a [u8],
    words: Words<'a>,
    /// The number of the current line, from 1.
    pub(super) line: usize,
}

impl<'a> Stream<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, words: Words::new(b""), line: 0 }
    }

    #[inline]
    pub(super) fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.words.next() {
                return Some(word);
            }
            self.next_line()?;
        }
    }

    fn next_line(&mut self) -> Option<()> {
        if self.rest.is_empty() {
            return None;
        }
        let length = self.rest.iter().position(|&byte| byte == b'\n').unwrap_or(self.rest.len());
        self.words = Words::new(&self.rest[..length]);
        self.rest = &self.rest[(length + 1).min(self.rest.len())..];
        self.line += 1;
        Some(())
    }

    pub(super) fn peek(&self) -> Option<&'a [u8]> {
        Stream { words: self.words.clone(), ..*self }.next()
    }

    /// Whether more words follow in the current line.
    pub(super) fn is_in_line(&self) -> bool {
        self.words.clone().next().is_some()
    }

    /// How many words follow in the current line, counted up to `enough`.
    pub(super) fn left_in_line(&self, enough: usize) -> usize {
        self.words.clone().take(enough).count()
    }

    /// Passes over what follows in the current line.
    pub(super) fn skip_line(&mut self) {
        self.words = Words::new(b"");
    }

    /// How many words the next line with words has. To be asked at the end of a line.
    pub(super) fn words_in_next_line(&self) -> usize {
        let mut ahead = Stream { words: self.words.clone(), ..*self };
        if ahead.next().is_some() { 1 + ahead.words.count() } else { 0 }
    }

    /// An error in the current line.
    pub(super) fn error(&self, kind: ReadErrorKind) -> ReadError {
        ReadError::at(self.line.max(1), kind)
    }
}

/// A number as Rust reads it: also `nan`, `inf`, `+1.` and `1e400`, which is infinite.
#[inline]
pub(super) fn float(word: &[u8]) -> Result<f64, ReadErrorKind> {
    let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
    number.ok_or_else(|| ReadErrorKind::NotANumber(shown(word)))
}

/// A whole number; one that is too great for 64 bits is the greatest or smallest there is.
#[inline]
pub(super) fn integer(word: &[u8]) -> Result<i64, ReadErrorKind> {
    let (negative, digits) = match word {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(ReadErrorKind::NotAnInteger(shown(word)));
    }
    let size =
        digits.iter().fold(0_i64, |size, &digit| size.saturating_mul(10).saturating_add(i64::from(digit - b'0')));
    Ok(if negative { -size } else { size })
}

/// A word as it stands in a message: readable, and not longer than a message bears.
pub(super) fn shown(word: &[u8]) -> String {
    const SHOWN: usize = 40;
    let text: String = String::from_utf8_lossy(&word[..word.len().min(4 * SHOWN)])
        .chars()
        .take(SHOWN)
        .map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c })
        .collect();
    if text.len() < word.len() && text.chars().count() == SHOWN { text + "..." } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_end_at_a_comment_but_not_inside_a_word() {
        let words = |line| Words::new(line).map(|word| String::from_utf8_lossy(word).into_owned()).collect::<Vec<_>>();
        assert_eq!(words(b" \tv 1\x0b2\r"), ["v", "1", "2"]);
        assert_eq!(words(b"f 1 2 # 3"), ["f", "1", "2"]);
        assert_eq!(words(b"v 1.#QNAN"), ["v", "1.#QNAN"]);
        assert!(float(b"1.#QNAN").is_err());
    }

    #[test]
    fn integers_saturate_and_refuse_all_else() {
        assert_eq!(integer(b"+7").ok(), Some(7));
        assert_eq!(integer(b"-99999999999999999999").ok(), Some(-i64::MAX));
        for word in ["", "-", "1.0", "1e3", "0x1", "--1", "1 "] {
            assert!(integer(word.as_bytes()).is_err(), "{word}");
        }
    }

    #[test]
    fn a_long_word_is_cut_in_messages() {
        assert_eq!(shown(b"abc\0"), "abc\u{fffd}");
        assert_eq!(shown(&[b'x'; 1000]).len(), 43);
    }
}
