//! The threads of this run: as many as cores, or as `RAYON_NUM_THREADS` says.

use guideway::layout::UserError;

use super::error::usage_error;

/// Most threads. Each costs memory and time to start; beyond this number it is a mistake.
pub(crate) const MAX_THREADS: usize = 1024;

const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Rejects a number of threads that a system would choke on.
pub(super) fn check_environment() -> Result<(), UserError> {
    let set = std::env::var(VARIABLE).ok();
    match set.and_then(|text| text.trim().parse::<u64>().ok()) {
        Some(threads) if threads > MAX_THREADS as u64 => Err(usage_error(
            format!("{VARIABLE}={threads}: above the limit of {MAX_THREADS} threads"),
            format!("Set {VARIABLE} to the number of cores, or unset it"),
        )),
        _ => Ok(()),
    }
}
