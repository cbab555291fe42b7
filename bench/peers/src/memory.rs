//! Memory of this process, as the system counts it.

use std::fs;

use anyhow::{Context, Result};

/// Most bytes held since the start, or since [`forget_peak`].
pub(crate) fn peak_bytes() -> Result<u64> {
    status_bytes("VmHWM")
}

/// Bytes held now.
pub(crate) fn held_bytes() -> Result<u64> {
    status_bytes("VmRSS")
}

/// Lets the system count the most memory held from now on.
pub(crate) fn forget_peak() -> Result<()> {
    Ok(fs::write("/proc/self/clear_refs", "5")?)
}

fn status_bytes(figure: &str) -> Result<u64> {
    let status = fs::read_to_string("/proc/self/status")?;
    let line = status
        .lines()
        .find_map(|l| l.strip_prefix(figure)?.strip_prefix(':'))
        .context("no such figure")?;
    let kib: u64 = line.trim().trim_end_matches("kB").trim().parse()?;
    Ok(kib * 1024)
}
