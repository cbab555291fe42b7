//! The process: the threads that all stages share, and Ctrl-C, which ends it at once or cancels an
//! operation that saves its results.

use std::sync::{OnceLock, mpsc};
use std::thread;
use std::{env, process};

use guideway::layout::UserError;
use guideway::scene::Cancel;
use rayon::{ThreadBuilder, ThreadPoolBuilder};

use super::error::{INTERRUPTED, usage_error};

/// Cancels the operation that saves its results when it is stopped.
static CANCEL_ON_INTERRUPT: OnceLock<Cancel> = OnceLock::new();

/// Prepares the process, before it starts its first thread. Disables a layer of Mesa that selects a
/// graphics card: without a desktop it prints an error that concerns nobody.
pub(super) fn prepare() {
    let has_desktop = ["DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR"]
        .iter()
        .any(|name| env::var_os(name).is_some());
    if !has_desktop {
        #[expect(
            unsafe_code,
            reason = "no other thread runs yet that could read the variables"
        )]
        // SAFETY: `main` calls this first, and the program has started no other thread.
        unsafe {
            env::set_var("NODEVICE_SELECT", "1");
        }
    }
}

/// Installs the handler: Ctrl-C removes unfinished files and ends the process.
pub(super) fn watch() -> Result<(), UserError> {
    let stop = || {
        // The first Ctrl-C cancels the operation. It may be stuck, so the second one ends it.
        if let Some(cancel) = CANCEL_ON_INTERRUPT.get()
            && cancel.check().is_ok()
        {
            cancel.set();
            return;
        }
        guideway::remove_unfinished();
        process::exit(INTERRUPTED);
    };
    ctrlc::set_handler(stop).map_err(|error| {
        UserError::new(
            "signal",
            format!("cannot install the handler of Ctrl-C: {error}"),
            "Try again; the system may refuse signal handlers in this environment",
        )
    })
}

/// The flag that the first Ctrl-C sets from now on, instead of ending the process.
pub(super) fn cancel_on_interrupt() -> Cancel {
    CANCEL_ON_INTERRUPT.get_or_init(Cancel::default).clone()
}

/// Most threads. Each costs memory and time to start; beyond this number it is a mistake.
pub(crate) const MAX_THREADS: usize = 1024;

/// Their number, as the user sets it; as many as cores without it.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Starts the threads that all stages of a command share.
pub(super) fn start_threads() -> Result<(), UserError> {
    check_environment()?;
    let (started, has_started) = mpsc::channel();
    // One after the other: a thread that starts in the last of the memory aborts the process, while
    // one that cannot start is an error.
    let start = |worker: ThreadBuilder| {
        let started = started.clone();
        thread::Builder::new().spawn(move || {
            let _ = started.send(());
            worker.run();
        })?;
        let _ = has_started.recv();
        Ok(())
    };
    let pool = ThreadPoolBuilder::new().spawn_handler(start);
    pool.build_global().map_err(|error| {
        let message = format!("cannot start the threads of this run: {error}");
        let remedy = format!("Free some memory, allow more threads, or set {VARIABLE} to 1");
        UserError::new("threads", message, remedy)
    })
}

/// Rejects a number of threads that a system would choke on.
fn check_environment() -> Result<(), UserError> {
    let set = env::var(VARIABLE).ok();
    match set.and_then(|text| text.trim().parse::<u64>().ok()) {
        Some(threads) if threads > MAX_THREADS as u64 => Err(usage_error(
            format!("{VARIABLE}={threads}: above the limit of {MAX_THREADS} threads"),
            format!("Set {VARIABLE} to the number of cores, or unset it"),
        )),
        _ => Ok(()),
    }
}
