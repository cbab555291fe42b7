//! Slices in parts, and sorting.

use std::cmp::Ordering;
use std::slice::{Chunks, ChunksMut, Windows};

use crate::iter::Sequential;

/// Parts of a slice.
pub trait ParallelSlice<T> {
    /// See [`slice::chunks`].
    fn par_chunks(&self, len: usize) -> Sequential<Chunks<'_, T>>;

    /// See [`slice::windows`].
    fn par_windows(&self, len: usize) -> Sequential<Windows<'_, T>>;
}

impl<T> ParallelSlice<T> for [T] {
    fn par_chunks(&self, len: usize) -> Sequential<Chunks<'_, T>> {
        Sequential(self.chunks(len))
    }

    fn par_windows(&self, len: usize) -> Sequential<Windows<'_, T>> {
        Sequential(self.windows(len))
    }
}

/// Parts of a slice that may change, and its order.
pub trait ParallelSliceMut<T> {
    /// See [`slice::chunks_mut`].
    fn par_chunks_mut(&mut self, len: usize) -> Sequential<ChunksMut<'_, T>>;

    /// See [`slice::sort_by`].
    fn par_sort_by(&mut self, compare: impl Fn(&T, &T) -> Ordering);

    /// See [`slice::sort_unstable`].
    fn par_sort_unstable(&mut self)
    where
        T: Ord;
}

impl<T> ParallelSliceMut<T> for [T] {
    fn par_chunks_mut(&mut self, len: usize) -> Sequential<ChunksMut<'_, T>> {
        Sequential(self.chunks_mut(len))
    }

    fn par_sort_by(&mut self, compare: impl Fn(&T, &T) -> Ordering) {
        self.sort_by(compare);
    }

    fn par_sort_unstable(&mut self)
    where
        T: Ord,
    {
        self.sort_unstable();
    }
}
