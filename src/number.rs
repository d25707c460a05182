//! Numbers as text.
//!
//! **Deliberately not here**: the many numbers of files, which are written faster ([`crate::io`]).

/// The shortest number that reads back as the same; with an exponent where it would be hundreds of digits long.
pub(crate) fn shortest(number: f64) -> String {
    let mut text = format!("{number:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    text
}
