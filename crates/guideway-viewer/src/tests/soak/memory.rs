//! Memory of the process at rest.

/// Tolerated growth over a run: the memory that the allocator keeps varies from rest to rest.
const MAX_GROWTH_MB: f64 = 48.0;

/// Resident megabytes of the process; `None` where the system does not report them.
pub(super) fn resident_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kb: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kb / 1024.0)
}

/// Growth of memory at rest, from the median of the second quarter of a run to that of the last.
pub(super) fn growth_mb(at_rest_mb: &[f64]) -> f64 {
    let quarter = at_rest_mb.len() / 4;
    if quarter == 0 {
        return 0.0;
    }
    let median = |part: &[f64]| {
        let mut sorted = part.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    median(&at_rest_mb[3 * quarter..]) - median(&at_rest_mb[quarter..2 * quarter])
}

/// # Errors
/// When memory at rest grows.
pub(super) fn check(at_rest_mb: &[f64]) -> Result<(), String> {
    let growth_mb = growth_mb(at_rest_mb);
    if growth_mb > MAX_GROWTH_MB {
        return Err(format!("memory at rest grew by {growth_mb:.1} MB"));
    }
    Ok(())
}

#[test]
fn distinguishes_a_leak_from_noise() {
    let noise = |i: usize| ((i * 7919) % 13) as f64;
    let flat: Vec<f64> = (0..400).map(|i| 200.0 + noise(i)).collect();
    assert_eq!(check(&flat), Ok(()));
    let leaking: Vec<f64> = (0..400)
        .map(|i| 200.0 + noise(i) + 0.25 * i as f64)
        .collect();
    assert!(check(&leaking).is_err());
    assert_eq!(check(&[]), Ok(()));
}
