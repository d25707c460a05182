//! Lists made part by part, on one thread or on many.
//!
//! An element is a function of its place, so the result is the same, bit for bit, however the work is shared. This is the
//! one place that knows of threads: without the feature `parallel` everything runs on the caller's.
//!
//! **Deliberately not here**: what the elements are.

use std::ops::Range;

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// `make(k)` for every `k` below a count, in order.
#[inline]
pub(crate) fn list<T: Default + Send + Sync>(count: usize, make: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    let mut list = Vec::with_capacity(count);
    append(&mut list, 0..count, make);
    list
}

/// Appends `make(k)` for every `k` of a range, in order.
#[inline]
pub(crate) fn append<T: Default + Send + Sync>(
    list: &mut Vec<T>,
    range: Range<usize>,
    make: impl Fn(usize) -> T + Sync + Send,
) {
    /// So many elements are blank at a time on one thread.
    const PART: usize = 1 << 8;
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        list.par_extend(range.into_par_iter().with_min_len(SHARE).map(make));
        return;
    }
    let lengths = range.clone().step_by(PART).map(|start| PART.min(range.end - start));
    append_parts(list, lengths, T::default, |_, part, elements| {
        for (element, k) in elements.iter_mut().zip(range.start + part * PART..) {
            *element = make(k);
        }
    });
}

/// All that is made of the numbers of a range, in order; each makes any number of elements.
#[inline]
pub(crate) fn gather<T: Send, I: IntoIterator<Item = T>>(
    range: Range<usize>,
    make: impl Fn(usize) -> I + Sync + Send,
) -> Vec<T> {
    let gather = |range: Range<usize>| {
        let mut list = Vec::new();
        range.for_each(|k| list.extend(make(k)));
        list
    };
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        // Each thread gets several, as one list may take longer than another; few, as each grows by itself and is joined.
        let length = SHARE.max(range.len() / (8 * rayon::current_num_threads()));
        let lists: Vec<Vec<T>> = pieces(range, length).map(gather).collect();
        let mut all = Vec::with_capacity(lists.iter().map(Vec::len).sum());
        lists.into_iter().for_each(|list| all.extend(list));
        return all;
    }
    gather(range)
}

/// The sums of what is counted at each number of a range.
#[inline]
pub(crate) fn sums<const N: usize>(
    range: Range<usize>,
    count: impl Fn(usize) -> [usize; N] + Sync + Send,
) -> [usize; N] {
    let add = |sums: [usize; N], counts: [usize; N]| std::array::from_fn(|k| sums[k] + counts[k]);
    let sum = |range: Range<usize>| range.map(&count).fold([0; N], add);
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        return pieces(range, SHARE).map(sum).reduce(|| [0; N], add);
    }
    sum(range)
}

/// What is made of each of as many equal shares of a range as there are threads, in order; the last may be smaller.
///
/// For what can be had of any part of a range, but not of each number: the result must not tell how many shares there were.
#[inline]
pub(crate) fn shares<T: Send>(range: Range<usize>, make: impl Fn(Range<usize>) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        let length = range.len().div_ceil(rayon::current_num_threads()).max(SHARE);
        return pieces(range, length).map(make).collect();
    }
    vec![make(range)]
}

/// The first number of a range that passes a test.
#[inline]
pub(crate) fn find(range: Range<usize>, test: impl Fn(usize) -> bool + Sync + Send) -> Option<usize> {
    let first = |mut range: Range<usize>| range.find(|&k| test(k));
    #[cfg(feature = "parallel")]
    if many(range.len()) {
        return pieces(range, SHARE).find_map_first(first);
    }
    first(range)
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

/// A range in pieces of some length to be shared, the last of which may be shorter. The loop over a piece is the one that a
/// single thread runs over all.
#[cfg(feature = "parallel")]
fn pieces(range: Range<usize>, length: usize) -> impl IndexedParallelIterator<Item = Range<usize>> {
    let Range { start, end } = range;
    (start..end).into_par_iter().step_by(length).map(move |start| start..end.min(start + length))
}

#[cfg(feature = "parallel")]
fn many(elements: usize) -> bool {
    elements >= 2 * SHARE && rayon::current_num_threads() > 1
}

#[cfg(feature = "parallel")]
#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::sync::{Condvar, Mutex};
    use std::thread::{self, ThreadId};
    use std::time::Duration;

    use super::*;

    /// Waits until two threads have met here.
    #[derive(Default)]
    struct Meeting {
        threads: Mutex<HashSet<ThreadId>>,
        arrived: Condvar,
    }

    impl Meeting {
        fn attend(&self) {
            let mut threads = self.threads.lock().expect("no thread panics here");
            threads.insert(thread::current().id());
            self.arrived.notify_all();
            let alone = |threads: &mut HashSet<ThreadId>| threads.len() < 2;
            let waited = self.arrived.wait_timeout_while(threads, Duration::from_secs(60), alone);
            let (_threads, waited) = waited.expect("no thread panics here");
            assert!(!waited.timed_out(), "only one thread works");
        }
    }

    /// Runs `work` on two threads and on one, where nobody can be met.
    fn is_shared<T: PartialEq + std::fmt::Debug + Send>(work: impl Fn(&(dyn Fn() + Sync)) -> T + Sync) {
        let on = |threads: usize, meet: &(dyn Fn() + Sync)| {
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start").install(|| work(meet))
        };
        let meeting = Meeting::default();
        assert_eq!(on(2, &|| meeting.attend()), on(1, &|| {}));
    }

    #[test]
    fn pieces_follow_each_other_without_a_gap() {
        for range in [0, 1, 6, 7, 8, 13, 14, 15].map(|count| 3..3 + count) {
            let pieces: Vec<Range<usize>> = pieces(range.clone(), 7).collect();
            assert!(pieces.iter().all(|piece| (1..=7).contains(&piece.len())), "{pieces:?}");
            assert!(pieces.into_iter().flatten().eq(range));
        }
    }

    #[test]
    fn two_threads_work_from_8192_elements_on() {
        const COUNT: usize = 8192;
        is_shared(|meet| {
            let mut list = vec![7];
            append(&mut list, 0..COUNT, |k| {
                meet();
                3 * k
            });
            list
        });
        is_shared(|meet| {
            gather(5..COUNT + 5, |k| {
                meet();
                (0..k % 3).map(move |j| (k, j))
            })
        });
        is_shared(|meet| {
            sums(0..COUNT, |k| {
                meet();
                [k, 1]
            })
        });
        is_shared(|meet| {
            find(0..COUNT, |k| {
                meet();
                k > COUNT - 3
            })
        });
        is_shared(|meet| {
            shares(3..COUNT + 3, |share| {
                meet();
                share.collect::<Vec<_>>()
            })
            .concat()
        });
        is_shared(|meet| {
            let mut list = vec![1];
            append_parts(
                &mut list,
                (0..128).map(|k| k + 1),
                || 0,
                |old, k, part| {
                    meet();
                    part.fill(old[0] + k);
                },
            );
            list
        });
    }
}
