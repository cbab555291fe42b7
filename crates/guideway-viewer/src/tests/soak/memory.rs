/// Growth over a whole run that is taken for chance: what the allocator keeps differs from rest to rest.
const MOST_GROWTH_MB: f64 = 48.0;

/// Megabytes of memory that the process holds; none where the system does not say.
pub(super) fn resident_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kb: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kb / 1024.0)
}

/// What memory at rest grew by from the second quarter of a run to the last, by their medians.
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
    if growth_mb > MOST_GROWTH_MB {
        return Err(format!("memory at rest grew by {growth_mb:.1} MB"));
    }
    Ok(())
}

#[test]
fn what_leaks_is_told_from_what_does_not() {
    let noise = |i: usize| ((i * 7919) % 13) as f64;
    let flat: Vec<f64> = (0..400).map(|i| 200.0 + noise(i)).collect();
    assert_eq!(check(&flat), Ok(()));
    let leaking: Vec<f64> = (0..400)
        .map(|i| 200.0 + noise(i) + 0.25 * i as f64)
        .collect();
    assert!(check(&leaking).is_err());
    assert_eq!(check(&[]), Ok(()));
}
