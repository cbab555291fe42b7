//! Memory of long lists: joins those of tasks by all threads, and keeps what is freed.

use bytemuck::Zeroable;
use bytemuck::allocation::zeroed_vec;
use rayon::prelude::*;

/// The elements of all lists, in order. Fresh memory costs more than the copy, so that the threads
/// share both.
pub(super) fn concatenated<T: Copy + Send + Sync + Zeroable>(lists: &[&[T]]) -> Vec<T> {
    let mut all = zeroed_vec(lists.iter().map(|list| list.len()).sum());
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
        assert_eq!(concatenated(&slices), lists.concat());
        assert_eq!(concatenated::<u32>(&[]), []);
    }
}
