//! Fits how a cost grows with the size of an input, as the exponent of a power: three sizes in, the
//! slope of the logarithms out. So the speed of the machine does not matter.

use std::fs;
use std::sync::LazyLock;
use std::time::Instant;

/// Shorter work is repeated, in nanoseconds: many steps of the clock, and of the scheduler.
const MIN_NS: u64 = 20_000_000;

/// Measurements per size; the least one counts, for other programs share the caches.
const REPEATS: u32 = 3;

/// Longer work is not measured again, in nanoseconds: what disturbs it is a small part.
const LONG_NS: f64 = 5e8;

/// Returns the exponent by which a cost grows with the size.
pub fn exponent(sizes: [usize; 3], mut cost: impl FnMut(usize) -> f64) -> f64 {
    let points = sizes.map(|size| ((size as f64).ln(), cost(size).ln()));
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / 3.0;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum::<f64>()
}

/// Returns the exponent by which the processor time of `work` grows with the size of what `prepare`
/// makes. All of the work runs on one thread, that of the parallel parts too.
///
/// # Panics
/// When no thread can be started.
pub fn exponent_of_time<T>(
    sizes: [usize; 3],
    prepare: impl Fn(usize) -> T + Sync,
    work: impl Fn(&T) + Sync,
) -> f64 {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread").install(|| {
        exponent(sizes, |size| {
            let input = prepare(size);
            let (mut least, mut all) = (f64::INFINITY, 0.0);
            for _ in 0..REPEATS {
                let time = mean_ns(|| work(&input));
                (least, all) = (least.min(time), all + time);
                if all > LONG_NS {
                    break;
                }
            }
            least
        })
    })
}

fn mean_ns(work: impl Fn()) -> f64 {
    const MOST_RUNS: u32 = 1000;
    let start = clock_ns();
    for runs in 1..=MOST_RUNS {
        work();
        let elapsed = clock_ns() - start;
        if elapsed > MIN_NS || runs == MOST_RUNS {
            return elapsed.max(1) as f64 / f64::from(runs);
        }
    }
    f64::INFINITY
}

/// Time that this thread has run, in nanoseconds: on Linux without the time in which others ran.
fn clock_ns() -> u64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    let of_thread = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let of_thread = of_thread.and_then(|text| text.split(' ').next()?.parse().ok());
    of_thread.unwrap_or_else(|| START.elapsed().as_nanos() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_tell_linear_from_quadratic() {
        for power in [1, 2] {
            let found = exponent([100, 300, 1000], |n| 7.0 * (n as f64).powi(power));
            assert!((found - f64::from(power)).abs() < 1e-9, "{found}");
        }
    }

    #[test]
    fn a_square_takes_the_time_of_a_square() {
        let square = |all: &Vec<usize>| {
            let sum = |a: &usize| all.iter().map(|b| (a ^ b).count_ones()).sum::<u32>();
            std::hint::black_box(all.iter().map(sum).max());
        };
        let found = exponent_of_time([300, 900, 2700], |size| (0..size).collect(), square);
        assert!(found > 1.7, "{found:.2}");
    }
}
