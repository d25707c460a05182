//! Rows of weights of input vertices.

use std::ops::{Add, Mul, Range};

use sprs::CsMatI;

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
    /// The matrix in which every vertex is itself.
    pub(super) fn identity(vertices: usize) -> Self {
        Self { csr: CsMatI::eye(vertices) }
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
        let place = self.places(row..row + 1);
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

    /// Where the weights of some rows are stored.
    fn places(&self, rows: Range<usize>) -> Range<usize> {
        let starts = self.csr.indptr();
        let starts = starts.raw_storage();
        starts[rows.start]..starts[rows.end]
    }
}

/// The rows of a matrix in the making: masks of the rows of another one.
pub(super) struct Rows<'a> {
    old: &'a WeightMatrix,
    starts: Vec<usize>,
    columns: Vec<u32>,
    weights: Vec<f64>,
    /// For each column the weight in the row at hand, 0 between rows.
    sums: Vec<f64>,
    /// The columns of the row at hand: a weight of 0 is one, too.
    seen: Vec<bool>,
}

impl<'a> Rows<'a> {
    pub(super) fn of(old: &'a WeightMatrix) -> Self {
        let columns = old.column_count();
        let (sums, seen) = (vec![0.0; columns], vec![false; columns]);
        Self { old, starts: vec![0], columns: Vec::new(), weights: Vec::new(), sums, seen }
    }

    /// How many rows there are.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Appends rows of the old matrix as they are.
    pub(super) fn copy(&mut self, rows: Range<usize>) {
        for row in rows {
            let place = self.old.places(row..row + 1);
            self.columns.extend_from_slice(&self.old.csr.indices()[place.clone()]);
            self.weights.extend_from_slice(&self.old.csr.data()[place]);
            self.starts.push(self.columns.len());
        }
    }

    /// Appends the sum of old rows that a mask says. O(k log k) for their k nonzeros.
    pub(super) fn push(&mut self, mask: &Mask) {
        let start = self.columns.len();
        for (weight, vertices) in mask.groups() {
            for v in vertices {
                for (column, part) in self.old.row(v.index()) {
                    if !std::mem::replace(&mut self.seen[column], true) {
                        self.columns.push(column as u32);
                    }
                    self.sums[column] += weight * part;
                }
            }
        }
        self.columns[start..].sort_unstable();
        for &column in &self.columns[start..] {
            self.weights.push(std::mem::take(&mut self.sums[column as usize]));
            self.seen[column as usize] = false;
        }
        self.starts.push(self.columns.len());
    }

    pub(super) fn finish(self) -> WeightMatrix {
        let shape = (self.len(), self.old.column_count());
        let Self { starts, mut columns, mut weights, .. } = self;
        columns.shrink_to_fit();
        weights.shrink_to_fit();
        WeightMatrix { csr: CsMatI::new(shape, starts, columns, weights) }
    }
}
