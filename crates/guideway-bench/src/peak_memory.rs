//! Peak memory of this process, from its start or the last reset, where the system tells it.

use std::fs;

/// Begins a new peak at the memory in use. Returns whether the system can.
pub(crate) fn reset() -> bool {
    // Linux: 5 resets the peak of the resident memory.
    fs::write("/proc/self/clear_refs", "5").is_ok()
}

/// The peak of the resident memory, in bytes.
pub(crate) fn bytes() -> Option<u64> {
    of_status(&fs::read_to_string("/proc/self/status").ok()?)
}

fn of_status(status: &str) -> Option<u64> {
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_peak_of_a_status() {
        let status = "Name:\tx\nVmHWM:\t    2048 kB\nVmRSS:\t 1024 kB\n";
        assert_eq!(of_status(status), Some(2 << 20));
        assert_eq!(of_status("VmRSS:\t 1024 kB\n"), None);
    }
}
