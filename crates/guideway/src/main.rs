//! The `guideway` command.

mod cli;
mod out_of_memory;

use std::env;

fn main() -> std::process::ExitCode {
    disable_device_selection_layer();
    cli::main()
}

/// Disables a layer of Mesa that selects a graphics card: without a desktop it prints an error that
/// concerns nobody.
fn disable_device_selection_layer() {
    let has_desktop = ["DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR"]
        .iter()
        .any(|name| env::var_os(name).is_some());
    if !has_desktop {
        #[expect(
            unsafe_code,
            reason = "no other thread runs yet that could read the variables"
        )]
        // SAFETY: the program has started no other thread.
        unsafe {
            env::set_var("NODEVICE_SELECT", "1");
        }
    }
}
