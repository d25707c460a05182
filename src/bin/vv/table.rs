//! Tables of plain text with aligned columns.

use std::fmt;

/// A table: the first column is aligned left, all others right, as they hold numbers.
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with a line of headers.
    pub(crate) fn new(headers: &[&str]) -> Self {
        let mut table = Self::without_headers();
        table.row(headers);
        table
    }

    /// A table without a line of headers.
    pub(crate) fn without_headers() -> Self {
        Self { rows: Vec::new() }
    }

    /// Adds a line.
    pub(crate) fn row(&mut self, cells: &[impl ToString]) {
        self.rows.push(cells.iter().map(ToString::to_string).collect());
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in &self.rows {
            for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                if column == 0 { write!(f, "{cell:<width$}") } else { write!(f, "  {cell:>width$}") }?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

/// Seconds in a form that is short and shows three digits.
pub(crate) fn seconds(seconds: f64) -> String {
    match seconds {
        _ if seconds < 1e-3 => format!("{:.0} us", seconds * 1e6),
        _ if seconds < 1.0 => format!("{:.1} ms", seconds * 1e3),
        _ => format!("{seconds:.2} s"),
    }
}

/// A count with its word, in the singular for one.
pub(crate) fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}
