//! Parses the arguments, runs the subcommand and converts its outcome to an exit code.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use guideway::layout::UserError;

use super::error::Exit;
use super::output::Output;
use super::start::{self, GlobalOptions};
use super::{
    bench, check, convert, default_command, demo, diff, doctor, edit, generate, info, methods,
    network, process, render, reproduce, route, share, shell, tiles, view,
};

/// Draws and checks the path layouts of automated guided vehicles.
#[derive(Debug, Parser)]
#[command(
    name = "guideway",
    version,
    subcommand_required = true,
    arg_required_else_help = true,
    after_help = "Start with `guideway demo`, which needs no file. `guideway FILE` opens the \
        window, or prints a summary where there is no display.\n\n\
        Exit codes: 0 success, 1 findings of `check` at or above its failing level, or \
        differences under `diff --exit-code`, 2 an error, 130 stopped by Ctrl-C."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    options: GlobalOptions,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Show layout files in a window and edit them
    View(view::Args),
    /// Draw layout files as a PNG, SVG or PDF picture
    Render(Box<render::Args>),
    /// Write layout files into one HTML file that any browser opens
    Share(Box<share::Args>),
    /// Make tiles of layout files for maps in browsers
    Tiles(Box<tiles::Args>),
    /// Summarize the content of layout files
    Info(info::Args),
    /// Find mistakes in layout files
    Check(Box<check::Args>),
    /// List what changed from one layout to another
    Diff(diff::Args),
    /// Write a layout in another format
    Convert(convert::Args),
    /// Edit a layout by a script
    Edit(edit::Args),
    /// Make a network from the lines of a drawing
    Network(Box<network::Args>),
    /// Find the fastest way between two stations or nodes
    Route(route::Args),
    /// Generate a test layout of any size
    Generate(generate::Args),
    /// List the render methods and whether they run on this computer
    Methods,
    /// List what this computer has for Guideway, for the report of a fault
    Doctor,
    /// Measure render methods side by side
    Bench(Box<bench::Args>),
    /// Measure the tables and figures of the thesis on this computer
    Reproduce(reproduce::Args),
    /// Draw a built-in site, a crowd of paths and the findings in a faulty site
    Demo(demo::Args),
    /// Print the completion script of a shell
    Completions(shell::CompletionsArgs),
    /// Print the manual page, or write all manual pages to a folder
    Man(shell::ManArgs),
    /// Print the JSON Schema of the answer of a command with --json
    Schema(shell::SchemaArgs),
}

/// Runs the command and returns its exit code.
pub fn main() -> ExitCode {
    process::prepare();
    let grammar = Cli::command();
    let commands: Vec<&str> = grammar
        .get_subcommands()
        .map(clap::Command::get_name)
        .collect();
    let args = default_command::insert(std::env::args_os().collect(), &commands);
    match start::parse::<Cli>(args.clone()) {
        Ok(cli) => start::run(&cli.options, |out| run(&cli.command, &args, out)),
        Err(exit) => exit,
    }
}

fn run(command: &Command, args: &[OsString], out: &Output) -> Result<Exit, UserError> {
    match command {
        Command::View(view) => view::run(view, args, out),
        Command::Render(args) => render::run(args, out),
        Command::Share(args) => share::run(args, out),
        Command::Tiles(args) => tiles::run(args, out),
        Command::Info(args) => info::run(args, out),
        Command::Check(args) => check::run(args, out),
        Command::Diff(args) => diff::run(args, out),
        Command::Convert(args) => convert::run(args, out),
        Command::Edit(args) => edit::run(args, out),
        Command::Network(args) => network::run(args, out),
        Command::Route(args) => route::run(args, out),
        Command::Generate(args) => generate::run(args, out),
        Command::Methods => methods::run(out),
        Command::Doctor => doctor::run(out),
        Command::Bench(args) => bench::run(args, out),
        Command::Reproduce(args) => reproduce::run(args, out),
        Command::Demo(args) => demo::run(args, out),
        Command::Completions(args) => shell::completions(args, Cli::command(), out),
        Command::Man(args) => shell::man(args, Cli::command(), out),
        Command::Schema(args) => shell::schema(args, out),
    }
}
