//! The threads of this run: as many as cores, or as `RAYON_NUM_THREADS` says.

use guideway::layout::UserError;
use rayon::ThreadPoolBuilder;

use super::error::usage_error;

/// Most threads. Each costs memory and time to start; beyond this number it is a mistake.
pub(crate) const MAX_THREADS: usize = 1024;

const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Starts the threads that all stages of a command share.
pub(super) fn start() -> Result<(), UserError> {
    check_environment()?;
    let started = ThreadPoolBuilder::new().build_global();
    started.map_err(|error| {
        let message = format!("cannot start the threads of this run: {error}");
        let remedy = format!("Free some memory, allow more threads, or set {VARIABLE} to 1");
        UserError::new("threads", message, remedy)
    })
}

/// Rejects a number of threads that a system would choke on.
fn check_environment() -> Result<(), UserError> {
    let set = std::env::var(VARIABLE).ok();
    match set.and_then(|text| text.trim().parse::<u64>().ok()) {
        Some(threads) if threads > MAX_THREADS as u64 => Err(usage_error(
            format!("{VARIABLE}={threads}: above the limit of {MAX_THREADS} threads"),
            format!("Set {VARIABLE} to the number of cores, or unset it"),
        )),
        _ => Ok(()),
    }
}
