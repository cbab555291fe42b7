//! The command that `guideway FILE` means: the window, or a summary where no window can open.

use std::ffi::OsString;
use std::path::Path;

use super::view;

/// Inserts the name of the command before a first argument that is a file and no command.
pub(crate) fn insert(mut args: Vec<OsString>, commands: &[&str]) -> Vec<OsString> {
    let is_file = args.get(1).is_some_and(|first| {
        let is_command = commands.iter().any(|name| first == name);
        !is_command && Path::new(first).is_file()
    });
    if is_file {
        let opens = has_display() && view::find().is_some();
        args.insert(1, command(opens).into());
    }
    args
}

fn command(opens_window: bool) -> &'static str {
    match opens_window {
        true => "view",
        false => "info",
    }
}

/// Returns `true` where a window can be expected to open.
fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos")) || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_file_gets_a_command() {
        let words = |text: &str| -> Vec<OsString> { text.split(' ').map(Into::into).collect() };
        let commands = ["info", "render"];
        for unchanged in [
            "guideway",
            "guideway info Cargo.toml",
            "guideway --json Cargo.toml",
        ] {
            let args = words(unchanged);
            assert_eq!(insert(args.clone(), &commands), args);
        }
        let missing = words("guideway nosuchfile.lif.json");
        assert_eq!(insert(missing.clone(), &commands), missing);
        let args = insert(words("guideway Cargo.toml --json"), &commands);
        assert_eq!(args[2..], words("Cargo.toml --json"));
        assert!(["view", "info"].iter().any(|name| args[1] == *name));
        assert_eq!(command(false), "info");
    }
}
