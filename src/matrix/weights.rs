//! Rows of weights of input vertices.

use std::mem;
use std::ops::{Add, Mul, Range};

use sprs::CsMatI;

use crate::id::VertexId;
use crate::parallel;
use crate::scheme::Mask;

/// A matrix with a row for each point that is made and a column for each input vertex: what a vertex weighs in a point.
///
/// Rows are sorted by column. Nothing is pruned: a weight that comes out as zero is stored, so which entries there are
/// follows from the topology alone.
#[derive(Clone, PartialEq, Debug)]
pub struct WeightMatrix {
    csr: CsMatI<f64, u32, usize>,
}

impl WeightMatrix {
    fn new(column_count: usize, starts: Vec<usize>, entries: Entries) -> Self {
        let shape = (starts.len() - 1, column_count);
        Self { csr: CsMatI::new(shape, starts, entries.columns, entries.weights) }
    }

    /// How many points it makes.
    #[must_use]
    pub fn row_count(&self) -> usize {
        self.csr.rows()
    }

    /// Of how many input vertices.
    #[must_use]
    pub fn column_count(&self) -> usize {
        self.csr.cols()
    }

    /// How many weights are stored.
    #[must_use]
    pub fn nonzero_count(&self) -> usize {
        self.csr.nnz()
    }

    /// The columns of a row, ascending, with their weights.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, row: usize) -> impl ExactSizeIterator<Item = (usize, f64)> {
        let starts = self.csr.indptr();
        let starts = starts.raw_storage();
        let place = starts[row]..starts[row + 1];
        let columns = self.csr.indices()[place.clone()].iter().map(|&column| column as usize);
        columns.zip(self.csr.data()[place].iter().copied())
    }

    /// The compressed rows, to be handed on to other crates.
    #[must_use]
    pub fn csr(&self) -> &CsMatI<f64, u32, usize> {
        &self.csr
    }

    /// The compressed rows, as [`WeightMatrix::csr`] shows them.
    #[must_use]
    pub fn into_csr(self) -> CsMatI<f64, u32, usize> {
        self.csr
    }

    /// The points that the matrix makes of values of the input vertices, which may be positions or anything else that can
    /// be weighed and added. One product: O(nonzeros).
    ///
    /// # Panics
    /// If there are not as many values as columns.
    #[must_use]
    pub fn apply<T>(&self, values: &[T]) -> Vec<T>
    where
        T: Copy + Default + Add<Output = T> + Send + Sync,
        f64: Mul<T, Output = T>,
    {
        assert_eq!(values.len(), self.column_count(), "there is one value for each input vertex");
        let mut points = Vec::with_capacity(self.row_count());
        parallel::append(&mut points, 0..self.row_count(), |row| {
            self.row(row).fold(T::default(), |sum, (column, weight)| sum + weight * values[column])
        });
        points
    }

    /// Bytes held.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.nonzero_count() * (size_of::<u32>() + size_of::<f64>()) + (self.row_count() + 1) * size_of::<usize>()
    }
}

/// Where a row lies among entries.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Row {
    start: usize,
    len: u32,
}

impl Row {
    pub(super) fn len(self) -> usize {
        self.len as usize
    }

    fn places(self) -> Range<usize> {
        self.start..self.start + self.len()
    }
}

/// Rows, one behind the other: the column of each weight, ascending in a row, and the weights.
#[derive(Clone, Default, Debug)]
pub(super) struct Entries {
    columns: Vec<u32>,
    weights: Vec<f64>,
}

impl Entries {
    /// The rows in which every vertex is itself.
    pub(super) fn identity(vertices: usize) -> (Self, Vec<Row>) {
        let entries = Self { columns: (0..vertices as u32).collect(), weights: vec![1.0; vertices] };
        (entries, (0..vertices).map(|start| Row { start, len: 1 }).collect())
    }

    pub(super) fn len(&self) -> usize {
        self.columns.len()
    }

    pub(super) fn row(&self, row: Row) -> (&[u32], &[f64]) {
        (&self.columns[row.places()], &self.weights[row.places()])
    }

    /// Appends a row of other entries.
    pub(super) fn copy(&mut self, others: &Self, row: Row) -> Row {
        let (columns, weights) = others.row(row);
        let start = self.len();
        self.columns.extend_from_slice(columns);
        self.weights.extend_from_slice(weights);
        Row { start, ..row }
    }
}

/// A row in the making, with a place for each column. It is empty between two rows.
#[derive(Clone, Debug)]
pub(super) struct RowSum {
    /// For each column its weight.
    sums: Vec<f64>,
    /// The columns that there are: a weight of 0 is one, too.
    seen: Vec<bool>,
    columns: Vec<u32>,
}

impl RowSum {
    pub(super) fn new(column_count: usize) -> Self {
        Self { sums: vec![0.0; column_count], seen: vec![false; column_count], columns: Vec::new() }
    }

    pub(super) fn column_count(&self) -> usize {
        self.sums.len()
    }

    /// Adds the rows that a mask names.
    pub(super) fn add<V: Copy + PartialEq>(&mut self, mask: &Mask<V>, entries: &Entries, row_of: impl Fn(V) -> Row) {
        for (weight, names) in mask.groups() {
            for &name in names {
                let (columns, parts) = entries.row(row_of(name));
                for (&column, part) in columns.iter().zip(parts) {
                    if !mem::replace(&mut self.seen[column as usize], true) {
                        self.columns.push(column);
                    }
                    self.sums[column as usize] += weight * part;
                }
            }
        }
    }

    /// Appends the row to entries. O(k log k) for its k weights.
    pub(super) fn append_to(&mut self, entries: &mut Entries) -> Row {
        let row = Row { start: entries.len(), len: self.columns.len() as u32 };
        self.columns.sort_unstable();
        for &column in &self.columns {
            entries.weights.push(mem::take(&mut self.sums[column as usize]));
            self.seen[column as usize] = false;
        }
        entries.columns.append(&mut self.columns);
        row
    }
}

/// A matrix in the making, row by row.
pub(super) struct Rows {
    sum: RowSum,
    starts: Vec<usize>,
    entries: Entries,
}

impl Rows {
    pub(super) fn new(column_count: usize) -> Self {
        Self { sum: RowSum::new(column_count), starts: vec![0], entries: Entries::default() }
    }

    /// Appends the sum of other rows that a mask says.
    pub(super) fn push(&mut self, mask: &Mask, entries: &Entries, row_of: impl Fn(VertexId) -> Row) {
        self.sum.add(mask, entries, row_of);
        self.sum.append_to(&mut self.entries);
        self.starts.push(self.entries.len());
    }

    /// Copies rows. O(nonzeros).
    pub(super) fn gathered(column_count: usize, entries: &Entries, rows: &[Row]) -> WeightMatrix {
        let nonzeros = rows.iter().map(|row| row.len()).sum();
        let mut gathered = Entries { columns: Vec::with_capacity(nonzeros), weights: Vec::with_capacity(nonzeros) };
        let mut starts = Vec::with_capacity(rows.len() + 1);
        starts.push(0);
        for &row in rows {
            gathered.copy(entries, row);
            starts.push(gathered.len());
        }
        WeightMatrix::new(column_count, starts, gathered)
    }

    pub(super) fn finish(self) -> WeightMatrix {
        let Self { sum, starts, mut entries } = self;
        entries.columns.shrink_to_fit();
        entries.weights.shrink_to_fit();
        WeightMatrix::new(sum.column_count(), starts, entries)
    }
}
