//! The command line: one module a subcommand, beside what they share.

mod activity;
mod arrow;
mod bench;
mod check;
mod convert;
mod demo;
mod envelope;
mod failure;
mod generate;
mod info;
mod input;
mod interrupt;
mod methods;
mod output;
mod render;
mod reproduce;
mod shell;
mod text;
mod values;
#[cfg(feature = "viewer")]
mod view;

use std::ffi::OsStr;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use failure::Failure;
use output::Output;

/// How a command that worked ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// All is well.
    Clean,
    /// `check --strict` found warnings.
    Warnings,
    /// `check` found errors, or `bench` could measure nothing.
    Errors,
    /// Ctrl-C stopped it, and what it had is kept.
    Interrupted,
}

impl Exit {
    fn code(self) -> u8 {
        match self {
            Self::Clean => 0,
            Self::Warnings => 1,
            Self::Errors => ERROR,
            Self::Interrupted => INTERRUPTED as u8,
        }
    }
}

/// Exit code of every error.
const ERROR: u8 = 2;
/// Exit code after Ctrl-C: 128 and the number of the signal, as shells have it.
const INTERRUPTED: i32 = 130;

/// Draws and checks the path layouts of automated guided vehicles.
#[derive(Debug, Parser)]
#[command(
    name = "guideway",
    version,
    subcommand_required = true,
    arg_required_else_help = true,
    after_help = "Start with `guideway demo`; it needs no file.\n\n\
        Exit codes: 0 all is well, 1 warnings under `check --strict`, 2 an error, 130 stopped by Ctrl-C."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print one JSON object instead of text; errors too
    #[arg(long, global = true)]
    json: bool,
    /// Print nothing but errors
    #[arg(long, short, global = true)]
    quiet: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Look at layout files in a window, and edit them
    #[cfg(feature = "viewer")]
    View(view::Args),
    /// Draw a layout file as a PNG picture
    Render(Box<render::Args>),
    /// Show what is in a layout file
    Info(info::Args),
    /// Look for mistakes in a layout file
    Check(check::Args),
    /// Write a layout in another format
    Convert(convert::Args),
    /// Make a test layout of any size
    Generate(generate::Args),
    /// List the ways of drawing, and which of them run here
    Methods,
    /// Measure ways of drawing side by side
    Bench(Box<bench::Args>),
    /// Measure the tables and figures of the thesis on this computer
    Reproduce(reproduce::Args),
    /// Draw the built-in example site
    Demo(demo::Args),
    /// Print the completion script of a shell
    Completions(shell::CompletionsArgs),
    /// Print the manual page, or write all of them to a folder
    Man(shell::ManArgs),
}

/// Runs the command and says how it ended.
pub(crate) fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return usage(&error),
    };
    let out = Output::new(cli.json, cli.quiet);
    match interrupt::watch().and_then(|()| run(&cli.command, &out)) {
        Ok(exit) => ExitCode::from(exit.code()),
        Err(failure) => {
            out.failure(&failure);
            ExitCode::from(ERROR)
        }
    }
}

fn run(command: &Command, out: &Output) -> Result<Exit, Failure> {
    match command {
        #[cfg(feature = "viewer")]
        Command::View(args) => view::run(args, out),
        Command::Render(args) => render::run(args, out),
        Command::Info(args) => info::run(args, out),
        Command::Check(args) => check::run(args, out),
        Command::Convert(args) => convert::run(args, out),
        Command::Generate(args) => generate::run(args, out),
        Command::Methods => methods::run(out),
        Command::Bench(args) => bench::run(args, out),
        Command::Reproduce(args) => reproduce::run(args, out),
        Command::Demo(args) => demo::run(args, out),
        Command::Completions(args) => shell::completions(args),
        Command::Man(args) => shell::man(args, out),
    }
}

/// Help and version are answers; anything else that the parser says is an error.
fn usage(error: &clap::Error) -> ExitCode {
    let wants_json = std::env::args_os().any(|arg| arg == OsStr::new("--json"));
    if error.use_stderr() && wants_json {
        Output::new(true, false).failure(&Failure::usage(error));
    } else {
        // A closed pipe is the only thing that can go wrong here, and its reader wants no more.
        let _ = error.print();
    }
    ExitCode::from(error.exit_code() as u8)
}
