//! What Ctrl-C does.

use std::process;
use std::sync::OnceLock;

use guideway::render::Cancel;

use super::{Failure, INTERRUPTED};

/// Work that keeps what it has when it is stopped.
static PATIENT: OnceLock<Cancel> = OnceLock::new();

/// Makes Ctrl-C take half-written files away and end the process at once, whatever it is doing.
pub(super) fn watch() -> Result<(), Failure> {
    let stop = || {
        // The first time, such work is asked to come to an end; it may be stuck, so not the second time.
        if let Some(cancel) = PATIENT.get()
            && cancel.check().is_ok()
        {
            cancel.set();
            return;
        }
        guideway::remove_unfinished();
        process::exit(INTERRUPTED);
    };
    ctrlc::set_handler(stop).map_err(|error| Failure {
        code: "signal",
        message: format!("cannot watch for Ctrl-C: {error}"),
        remedy: "Try again; if it stays so, the system refuses signal handlers here".into(),
    })
}

/// What the first Ctrl-C sets from now on, instead of ending the process.
pub(super) fn patiently() -> Cancel {
    PATIENT.get_or_init(Cancel::default).clone()
}
