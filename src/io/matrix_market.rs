//! Writing a sparse matrix as Matrix Market, the exchange format that numerical programs read.

use std::io::{self, Write};

use sprs::CsMatI;

use super::write::Lines;

/// So many bytes of a comment stand in a line; the format allows 1024 in all.
const COMMENT: usize = 1000;

/// Writes a matrix as Matrix Market: `coordinate real general`, row by row, counted from 1; numbers are read back with the
/// same bits.
///
/// Each line of `comment` becomes one behind the header; a long one becomes several, as some readers know only short lines.
///
/// # Errors
/// Those of the writer.
///
/// ```
/// use vvmesh::{io, sprs::CsMatI};
/// let matrix = CsMatI::new((2, 3), vec![0, 1, 3], vec![2_u32, 0, 1], vec![1.0, 0.5, 0.5]);
/// let mut text = Vec::new();
/// io::write_matrix_market(&mut text, &matrix, "midpoint")?;
/// let expected = "%%MatrixMarket matrix coordinate real general\n% midpoint\n2 3 3\n1 3 1\n2 1 0.5\n2 2 0.5\n";
/// assert_eq!(String::from_utf8_lossy(&text), expected);
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn write_matrix_market(out: &mut impl Write, matrix: &CsMatI<f64, u32, usize>, comment: &str) -> io::Result<()> {
    let mut lines = Lines::new(out);
    lines.text("%%MatrixMarket matrix coordinate real general\n")?;
    for part in comment.lines().flat_map(parts) {
        lines.text("% ")?;
        lines.text(part)?;
        lines.text("\n")?;
    }
    for (count, end) in [(matrix.rows(), " "), (matrix.cols(), " "), (matrix.nnz(), "\n")] {
        lines.integer(count);
        lines.text(end)?;
    }
    for (k, row) in matrix.outer_iterator().enumerate() {
        for (column, &weight) in row.iter() {
            lines.integer(k + 1);
            lines.text(" ")?;
            lines.integer(column + 1);
            lines.text(" ")?;
            lines.float(weight);
            lines.text("\n")?;
        }
    }
    lines.finish()
}

/// A line in parts that are not too long.
fn parts(mut line: &str) -> impl Iterator<Item = &str> {
    std::iter::from_fn(move || {
        let ends = line.char_indices().map(|(start, letter)| start + letter.len_utf8());
        let (part, rest) = line.split_at(ends.take_while(|&end| end <= COMMENT).last()?);
        line = rest;
        Some(part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_comments_are_broken_between_letters() {
        let comment = format!("{}\n\n{}", "short", "\u{e4}".repeat(800));
        let mut text = Vec::new();
        write_matrix_market(&mut text, &CsMatI::zero((0, 0)), &comment).unwrap();
        let text = String::from_utf8(text).unwrap();
        let lengths: Vec<usize> = text.lines().map(str::len).collect();
        assert_eq!(lengths, [45, 2 + 5, 2 + 1000, 2 + 600, 5]);
        assert!(text.lines().take(4).all(|line| line.starts_with('%')));
    }
}
