//! The `guideway` command.

mod cli;

use std::env;

fn main() -> std::process::ExitCode {
    keep_drivers_from_looking_for_a_screen();
    cli::main()
}

/// Where there is no desktop, a layer of Mesa that chooses among graphics cards looks for one all the same,
/// and prints an error of no concern to anybody.
fn keep_drivers_from_looking_for_a_screen() {
    let has_desktop = ["DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR"]
        .iter()
        .any(|name| env::var_os(name).is_some());
    if !has_desktop {
        #[expect(
            unsafe_code,
            reason = "no other thread runs yet that could read the variables"
        )]
        // SAFETY: this is the first thing that the program does.
        unsafe {
            env::set_var("NODEVICE_SELECT", "1");
        }
    }
}
