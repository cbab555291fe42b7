//! [`concatenated`]: joins the lists of tasks to one, by all threads.

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
