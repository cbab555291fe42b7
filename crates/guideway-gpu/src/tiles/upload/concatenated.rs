//! Memory of long lists: keeps those of tasks apart or joins them by all threads, and keeps what is
//! freed.

use std::ops::Range;

use bytemuck::allocation::zeroed_vec;
use bytemuck::{NoUninit, Zeroable};
use rayon::prelude::*;

/// The elements of all lists, in order, in memory with room for `spare` more. Fresh memory costs
/// more than the copy, so that the threads share both.
pub(super) fn concatenated<T: Copy + Send + Sync + Zeroable>(
    lists: &[&[T]],
    spare: usize,
) -> Vec<T> {
    let len = lists.iter().map(|list| list.len()).sum();
    let mut all = zeroed_vec(len + spare);
    all.truncate(len);
    let mut rest = &mut all[..];
    let mut places = Vec::with_capacity(lists.len());
    for list in lists {
        let (place, behind) = rest.split_at_mut(list.len());
        places.push(place);
        rest = behind;
    }
    let copies = places.into_par_iter().zip(lists);
    copies.for_each(|(place, list)| place.copy_from_slice(list));
    all
}

/// A long list in pieces, as tasks made them. Fresh memory for all of it costs more than the device
/// needs to take it piece by piece.
#[derive(Default)]
pub(crate) struct Pieces<T>(Vec<Vec<T>>);

impl<T: Copy + NoUninit + Send + Sync + Zeroable> Pieces<T> {
    /// The pieces in order.
    pub(super) fn new(pieces: impl Iterator<Item = Vec<T>>) -> Self {
        Self(pieces.filter(|piece| !piece.is_empty()).collect())
    }

    /// Number of elements.
    pub(super) fn len(&self) -> usize {
        self.0.iter().map(Vec::len).sum()
    }

    /// Returns `true` if there are no elements.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The pieces.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[T]> {
        self.0.iter().map(Vec::as_slice)
    }

    /// The bytes of some elements.
    pub(super) fn bytes_of(&self, range: Range<usize>) -> Vec<&[u8]> {
        let mut first = 0;
        let parts = self.iter().map(|piece| {
            let within = |at: usize| at.clamp(first, first + piece.len()) - first;
            let part = &piece[within(range.start)..within(range.end)];
            first += piece.len();
            bytemuck::cast_slice(part)
        });
        parts.filter(|part: &&[u8]| !part.is_empty()).collect()
    }

    /// All elements in one list, with room for `spare` more.
    pub(super) fn joined(&self, spare: usize) -> Vec<T> {
        concatenated(&self.iter().collect::<Vec<_>>(), spare)
    }
}

/// Lets the allocator keep freed memory of up to 32 MB: fresh pages cost more than what edits write
/// to them. The allocator of glibc does so once a block of that size was freed (mallopt(3),
/// `M_MMAP_THRESHOLD`); others do as before.
pub(super) fn keep_freed_memory() {
    const BLOCK_BYTES: usize = (32 << 20) - (64 << 10);
    drop(std::hint::black_box(Vec::<u8>::with_capacity(BLOCK_BYTES)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_keep_their_order() {
        let lists: Vec<Vec<u32>> = (0..100)
            .map(|n| (0..n % 7).map(|i| n + i).collect())
            .collect();
        let slices: Vec<&[u32]> = lists.iter().map(Vec::as_slice).collect();
        assert_eq!(concatenated(&slices, 0), lists.concat());
        let with_spare = concatenated(&slices, 50);
        assert_eq!(with_spare, lists.concat());
        assert!(with_spare.capacity() >= with_spare.len() + 50);
        assert_eq!(concatenated::<u32>(&[], 0), []);
    }

    #[test]
    fn pieces_give_the_bytes_of_any_range() {
        let lists = [vec![], vec![1_u8, 2], vec![3], vec![], vec![4, 5, 6]];
        let pieces = Pieces::new(lists.into_iter());
        let all = pieces.joined(0);
        assert_eq!((pieces.len(), &all[..]), (6, &[1, 2, 3, 4, 5, 6][..]));
        for range in [0..6, 0..0, 1..3, 2..2, 2..5, 3..6, 6..6] {
            let parts = pieces.bytes_of(range.clone());
            assert_eq!(parts.concat(), all[range]);
            assert!(parts.iter().all(|part| !part.is_empty()));
        }
        assert!(Pieces::<u8>::new([vec![]].into_iter()).is_empty());
    }
}
