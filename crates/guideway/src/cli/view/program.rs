//! Finds the program of the window, and starts it with the arguments of `view`.

use std::env::{self, consts::EXE_SUFFIX};
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use guideway::layout::{UserError, shown_path};

use super::Args;
use crate::cli::error::Exit;
use crate::cli::output::Output;

/// The name of the program, and of its package.
const NAME: &str = "guideway-window";

/// Starts the window. `words` are all arguments of this command.
pub(crate) fn run(args: &Args, words: &[OsString], out: &Output) -> Result<Exit, UserError> {
    args.check(out)?;
    let program = find().ok_or_else(missing)?;
    start(Command::new(&program).args(arguments(words)))
        .map_err(|error| not_started(&program, &error))
}

/// The program of the window: beside this one, else in a folder of `PATH`.
pub(crate) fn find() -> Option<PathBuf> {
    let own = env::current_exe().ok();
    let beside = own.as_deref().and_then(Path::parent).map(Path::to_owned);
    let path = env::var_os("PATH").unwrap_or_default();
    find_in(beside.into_iter().chain(env::split_paths(&path)))
}

fn find_in(folders: impl IntoIterator<Item = PathBuf>) -> Option<PathBuf> {
    let name = format!("{NAME}{EXE_SUFFIX}");
    // An empty entry of `PATH` would be the current folder, which anybody may have filled.
    let mut programs = folders
        .into_iter()
        .filter(|folder| folder.is_absolute())
        .map(|folder| folder.join(&name));
    programs.find(|program| program.is_file())
}

/// The arguments of the window: those of the command, without its own name and `view`.
fn arguments(words: &[OsString]) -> Vec<OsString> {
    let mut words: Vec<OsString> = words.iter().skip(1).cloned().collect();
    // No option before the subcommand takes this value.
    if let Some(at) = words.iter().position(|word| word == "view") {
        words.remove(at);
    }
    words
}

/// Becomes the other program.
#[cfg(unix)]
fn start(command: &mut Command) -> io::Result<Exit> {
    use std::os::unix::process::CommandExt;
    Err(command.exec())
}

/// Runs the other program and waits for it.
#[cfg(not(unix))]
fn start(command: &mut Command) -> io::Result<Exit> {
    match command.status()?.code() {
        Some(0) => Ok(Exit::Clean),
        // It has printed its error.
        _ => Ok(Exit::Failed),
    }
}

fn missing() -> UserError {
    UserError::new(
        "no-window",
        format!(
            "the window is a program of its own, `{NAME}`, which is neither beside this command \
             nor in a folder of PATH"
        ),
        format!(
            "Install it with `cargo install --path crates/{NAME}` in Guideway's repository; \
             `guideway info` and `guideway render` do without"
        ),
    )
}

fn not_started(program: &Path, error: &io::Error) -> UserError {
    UserError::new(
        "no-window",
        format!("cannot start the window, {}: {error}", shown_path(program)),
        format!("Install `{NAME}` of this version again"),
    )
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn the_window_gets_all_arguments_but_its_command() {
        let words = |text: &str| -> Vec<OsString> { text.split(' ').map(Into::into).collect() };
        let given = words("guideway --quiet --formats lif view a.json view --timings");
        assert_eq!(
            arguments(&given),
            words("--quiet --formats lif a.json view --timings")
        );
    }

    #[test]
    fn only_an_absolute_folder_is_searched() {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join(format!("{NAME}{EXE_SUFFIX}"));
        let search = || find_in([PathBuf::new(), ".".into(), folder.path().to_owned()]);
        assert_eq!(search(), None);
        fs::create_dir(&program).unwrap();
        assert_eq!(search(), None, "a folder of this name");
        fs::remove_dir(&program).unwrap();
        fs::write(&program, "").unwrap();
        assert_eq!(search(), Some(program));
    }
}
