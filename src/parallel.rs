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

/// The numbers of a range that pass a test, in order.
#[inline]
pub(crate) fn filter(range: Range<usize>, test: impl Fn(usize) -> bool + Sync + Send) -> Vec<usize> {
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        return range.into_par_iter().with_min_len(SHARE).filter(|&k| test(k)).collect();
    }
    range.filter(|&k| test(k)).collect()
}

/// The first number of a range that passes a test.
#[inline]
pub(crate) fn find(range: Range<usize>, test: impl Fn(usize) -> bool + Sync + Send) -> Option<usize> {
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        return range.into_par_iter().with_min_len(SHARE).find_first(|&k| test(k));
    }
    range.into_iter().find(|&k| test(k))
}

/// Appends parts of given lengths; `fill(list, k, part)` writes part `k`, reading the list as it was before.
///
/// Every part is blank first. On one thread that is done part by part, so a short one is still in the nearest cache when it
/// is filled.
#[inline]
pub(crate) fn append_parts<T: Send + Sync>(
    list: &mut Vec<T>,
    lengths: impl Iterator<Item = usize>,
    blank: impl Fn() -> T + Sync,
    fill: impl Fn(&[T], usize, &mut [T]) + Sync,
) {
    let lengths: Vec<usize> = lengths.collect();
    #[cfg(feature = "parallel")]
    if many(lengths.iter().sum()) {
        return share_parts(list, &lengths, blank, fill);
    }
    let old = list.len();
    for (k, &length) in lengths.iter().enumerate() {
        let start = list.len();
        list.resize_with(start + length, &blank);
        let (done, part) = list.split_at_mut(start);
        fill(&done[..old], k, part);
    }
}

#[cfg(feature = "parallel")]
fn share_parts<T: Send + Sync>(
    list: &mut Vec<T>,
    lengths: &[usize],
    blank: impl Fn() -> T + Sync,
    fill: impl Fn(&[T], usize, &mut [T]) + Sync,
) {
    let old = list.len();
    let total: usize = lengths.iter().sum();
    list.par_extend((0..total).into_par_iter().with_min_len(SHARE).map(|_| blank()));
    let (done, mut rest) = list.split_at_mut(old);
    let mut parts = Vec::with_capacity(lengths.len());
    for &length in lengths {
        let (part, others) = rest.split_at_mut(length);
        parts.push(part);
        rest = others;
    }
    parts.into_par_iter().enumerate().for_each(|(k, part)| fill(done, k, part));
}

/// Below this many elements other threads are not worth waking, and none gets fewer.
#[cfg(feature = "parallel")]
const SHARE: usize = 1 << 12;

#[cfg(feature = "parallel")]
fn many(elements: usize) -> bool {
    elements >= 2 * SHARE && rayon::current_num_threads() > 1
}
