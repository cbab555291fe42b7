//! `guideway completions` and `guideway man`: for whoever installs the command.

use std::path::PathBuf;

use clap::CommandFactory;
use clap_complete::Shell;

use super::{Cli, Exit, Failure, Output, output};

#[derive(Debug, clap::Args)]
pub(crate) struct CompletionsArgs {
    /// Shell to complete in
    shell: Shell,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ManArgs {
    /// Folder to write a page for every subcommand to
    dir: Option<PathBuf>,
}

pub(crate) fn completions(args: &CompletionsArgs) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "guideway", &mut script);
    output::print(&script)?;
    Ok(Exit::Clean)
}

pub(crate) fn man(args: &ManArgs, out: &Output) -> Result<Exit, Failure> {
    match &args.dir {
        None => {
            let mut page = Vec::new();
            clap_mangen::Man::new(Cli::command())
                .render(&mut page)
                .map_err(|error| unwritten("standard output", &error))?;
            output::print(&page)?;
        }
        Some(dir) => {
            std::fs::create_dir_all(dir)
                .and_then(|()| clap_mangen::generate_to(Cli::command(), dir))
                .map_err(|error| unwritten(&dir.display().to_string(), &error))?;
            out.note(&format!("manual pages are in {}", dir.display()));
        }
    }
    Ok(Exit::Clean)
}

fn unwritten(place: &str, error: &std::io::Error) -> Failure {
    Failure {
        code: "save",
        message: format!("{place}: cannot write the manual page: {error}"),
        remedy: "Check that the folder is there and may be written".into(),
    }
}
