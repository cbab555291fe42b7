//! Ctrl-C: ends the process at once, or cancels an operation that saves its results.

use std::process;
use std::sync::OnceLock;

use guideway::layout::UserError;
use guideway::scene::Cancel;

use super::exit::INTERRUPTED;

/// Cancels the operation that saves its results when it is stopped.
static CANCEL_ON_INTERRUPT: OnceLock<Cancel> = OnceLock::new();

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
