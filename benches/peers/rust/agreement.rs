//! Whether two libraries computed the same points, whatever numbers they gave them.

/// Directions along which the points are compared: the axes, and one in which the axes do not hide behind each other.
const DIRECTIONS: [[f64; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.29, 0.44, 0.85]];

/// A set of points, sorted along every direction.
pub(crate) struct Points {
    along: Vec<Vec<f64>>,
    greatest: f64,
}

impl Points {
    /// So many numbers make a point; single ones are compared as they are.
    pub(crate) fn new(numbers: &[f64], width: usize) -> Self {
        let directions = if width == 1 { &DIRECTIONS[..1] } else { &DIRECTIONS[..] };
        let along = directions.iter().map(|direction| {
            let along = |point: &[f64]| point.iter().zip(direction).map(|(x, weight)| x * weight).sum();
            let mut sorted: Vec<f64> = numbers.chunks_exact(width).map(along).collect();
            sorted.sort_unstable_by(f64::total_cmp);
            sorted
        });
        let greatest = numbers.iter().fold(f64::MIN_POSITIVE, |greatest, x| greatest.max(x.abs()));
        Self { along: along.collect(), greatest }
    }

    pub(crate) fn count(&self) -> usize {
        self.along[0].len()
    }

    /// How far another set of as many points is from this one, relative to the greatest coordinate.
    ///
    /// The sorted points are compared one by one. If every point of one set lies within some distance of its partner in the
    /// other, so do the sorted ones; points that are not each other's partners would have to look alike along all
    /// directions.
    pub(crate) fn difference(&self, other: &Self) -> f64 {
        let pairs = self.along.iter().zip(&other.along).flat_map(|(ours, theirs)| ours.iter().zip(theirs));
        pairs.fold(0.0, |apart, (a, b)| f64::max(apart, (a - b).abs())) / self.greatest
    }
}
