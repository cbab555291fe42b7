//! Each call returns what rayon's call of the same name returns.

use std::collections::BTreeMap;

/// Runs the same code with either crate, and compares the results.
macro_rules! same {
    ($work:expr) => {{
        let here = {
            use rayon::prelude::*;
            $work
        };
        let there = {
            use parallel::prelude::*;
            $work
        };
        assert_eq!(here, there);
    }};
}

const NUMBERS: [u32; 9] = [3, 1, 4, 1, 5, 9, 2, 6, 5];

#[test]
fn iterators_return_the_same() {
    same!(NUMBERS.par_iter().map(|n| n * 2).collect::<Vec<_>>());
    same!(
        NUMBERS
            .par_iter()
            .enumerate()
            .map(|(i, n)| (i, *n))
            .collect::<BTreeMap<_, _>>()
    );
    same!(NUMBERS.par_iter().filter(|n| **n > 3).count());
    same!(
        NUMBERS
            .par_iter()
            .filter_map(|n| n.checked_sub(3))
            .collect::<Vec<_>>()
    );
    same!(
        (0..5_u32)
            .into_par_iter()
            .flat_map_iter(|n| 0..n)
            .collect::<Vec<_>>()
    );
    same!(
        [Some(1), None, Some(3)]
            .par_iter()
            .flatten()
            .map(|n| n + 1)
            .sum::<u32>()
    );
    same!(
        NUMBERS
            .par_iter()
            .zip(&[7_u32, 8])
            .map(|(a, b)| a * b)
            .collect::<Vec<_>>()
    );
    same!((0..10).into_par_iter().step_by(4).collect::<Vec<_>>());
    same!(
        NUMBERS
            .par_iter()
            .with_min_len(2)
            .with_max_len(4)
            .map(|n| u64::from(*n))
            .sum::<u64>()
    );
    same!(
        NUMBERS
            .par_iter()
            .fold(|| 0, |sum, n| sum + n)
            .reduce(|| 0, |a, b| a + b)
    );
    same!(NUMBERS.into_par_iter().reduce_with(u32::max));
    same!([0_u32; 0].into_par_iter().reduce_with(u32::max));
    for most in [9, 4] {
        let within = |n: &u32| if *n > most { Err(most) } else { Ok(*n) };
        same!(
            NUMBERS
                .par_iter()
                .map(within)
                .try_reduce(|| 0, |a, b| Ok(a.max(b)))
        );
    }
    same!(NUMBERS.par_iter().all(|n| *n < 9));
    same!(NUMBERS.par_iter().any(|n| *n == 9));
    same!(NUMBERS.into_par_iter().find_first(|n| *n > 3));
    same!({
        let parts: (Vec<u32>, Vec<u32>) = NUMBERS.into_par_iter().partition(|n| *n > 3);
        parts
    });
    same!(
        NUMBERS
            .par_iter()
            .try_for_each(|n| if *n == 9 { Err(*n) } else { Ok(()) })
    );
    same!(
        NUMBERS
            .par_iter()
            .map_init(|| 1, |one, n| *one + n)
            .collect::<Vec<_>>()
    );
}

#[test]
fn what_changes_in_place_is_the_same() {
    same!({
        let mut numbers = NUMBERS;
        numbers.par_iter_mut().for_each(|n| *n += 1);
        numbers.par_sort_unstable();
        numbers
    });
    same!({
        let mut pairs = NUMBERS.map(|n| (n % 2, n));
        pairs.par_sort_by(|a, b| a.0.cmp(&b.0));
        pairs
    });
    same!({
        let mut numbers = NUMBERS;
        let parts = numbers.par_chunks_mut(4).zip(NUMBERS.par_chunks(4));
        parts.for_each_init(|| 2, |two, (to, from)| to[0] = from[0] * *two);
        numbers
    });
    same!({
        let mut all = vec![1];
        all.par_extend((2..5).into_par_iter().map(|n| n * n));
        all
    });
    same!(
        NUMBERS
            .par_windows(2)
            .map(|pair| pair[0].max(pair[1]))
            .collect::<Vec<_>>()
    );
}

#[test]
fn tasks_run_on_the_calling_thread() {
    let thread = std::thread::current().id();
    let (first, second) = rayon::join(std::thread::current, std::thread::current);
    assert_eq!((first.id(), second.id()), (thread, thread));
    assert_eq!(rayon::scope(|()| std::thread::current().id()), thread);
    assert_eq!(rayon::current_num_threads(), 1);
    assert!(
        rayon::ThreadPoolBuilder::new()
            .num_threads(2)
            .build()
            .is_err()
    );
}
