//! Memory of this process, from `/proc/self` of Linux.

use std::fs;

use anyhow::{Context, Result};

/// Peak resident bytes since the start, or since [`reset_peak`].
pub(crate) fn peak_bytes() -> Result<u64> {
    status_bytes("VmHWM")
}

/// Current resident bytes.
pub(crate) fn resident_bytes() -> Result<u64> {
    status_bytes("VmRSS")
}

/// Resets the peak to the current value.
pub(crate) fn reset_peak() -> Result<()> {
    Ok(fs::write("/proc/self/clear_refs", "5")?)
}

fn status_bytes(figure: &str) -> Result<u64> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status
        .lines()
        .find_map(|l| l.strip_prefix(figure)?.strip_prefix(':'))
        .with_context(|| format!("`{figure}` is missing in /proc/self/status"))?;
    let kib: u64 = line.trim().trim_end_matches("kB").trim().parse()?;
    Ok(kib * 1024)
}
