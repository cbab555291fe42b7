//! `guideway completions` and `guideway man`: files for the installation of the command.

use std::path::PathBuf;

use clap_complete::Shell;
use guideway::layout::UserError;

use super::exit::Exit;
use super::output::{self, Output};

#[derive(Debug, clap::Args)]
pub(crate) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// Folder for one page per subcommand
    dir: Option<PathBuf>,
}

pub(crate) fn completions(
    args: &CompletionsArgs,
    mut command: clap::Command,
) -> Result<Exit, UserError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "guideway", &mut script);
    output::print(&script)?;
    Ok(Exit::Clean)
}

pub(crate) fn man(args: &ManArgs, command: clap::Command, out: &Output) -> Result<Exit, UserError> {
    match &args.dir {
        None => {
            let mut page = Vec::new();
            clap_mangen::Man::new(command)
                .render(&mut page)
                .map_err(|error| save_error("standard output", &error))?;
            output::print(&page)?;
        }
        Some(dir) => {
            std::fs::create_dir_all(dir)
                .and_then(|()| clap_mangen::generate_to(command, dir))
                .map_err(|error| save_error(&dir.display().to_string(), &error))?;
            out.note(&format!("manual pages are in {}", dir.display()));
        }
    }
    Ok(Exit::Clean)
}

fn save_error(target: &str, error: &std::io::Error) -> UserError {
    UserError::new(
        "save",
        format!("{target}: cannot write the manual page: {error}"),
        "Check that the folder exists and that you may write to it",
    )
}
