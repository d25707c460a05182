//! Lists made part by part, on one thread or on many.
//!
//! An element is a function of its place, so the result is the same, bit for bit, however the work is shared. This is the
//! one place that knows of threads: without the feature `parallel` everything runs on the caller's.
//!
//! **Deliberately not here**: what the elements are.

use std::ops::Range;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// Appends `make(k)` for every `k` of a range, in order.
#[inline]
pub(crate) fn append<T: Send>(list: &mut Vec<T>, range: Range<usize>, make: impl Fn(usize) -> T + Sync + Send) {
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        return list.par_extend(range.into_par_iter().with_min_len(SHARE).map(make));
    }
    list.extend(range.map(make));
}

/// Appends parts of given lengths; `fill(list, k, part)` writes part `k`, reading the list as it was before.
///
/// Parts should be small, as each is blank first.
#[inline]
pub(crate) fn append_parts<T: Send + Sync>(
    list: &mut Vec<T>,
    lengths: impl ExactSizeIterator<Item = usize>,
    blank: impl Fn() -> T + Sync,
    fill: impl Fn(&[T], usize, &mut [T]) + Sync,
) {
    let old = list.len();
    for (k, length) in lengths.enumerate() {
        let start = list.len();
        list.resize_with(start + length, &blank);
        let (done, part) = list.split_at_mut(start);
        fill(&done[..old], k, part);
    }
}

/// Below this many elements other threads are not worth waking, and none gets fewer.
#[cfg(feature = "parallel")]
const SHARE: usize = 1 << 12;

#[cfg(feature = "parallel")]
fn many(elements: usize) -> bool {
    elements >= 2 * SHARE && rayon::current_num_threads() > 1
}
