//! Parses the arguments, runs the subcommand and converts its outcome to an exit code.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use guideway::formats::Format;
use guideway::layout::{UserError, shown_lines};

use super::error::{ERROR, Exit, parser_error};
use super::output::Output;
#[cfg(feature = "viewer")]
use super::view;
use super::{
    bench, check, convert, default_command, demo, diff, edit, generate, info, limits, methods,
    network, process, render, reproduce, route, shell,
};
use crate::out_of_memory;

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
    /// Print one JSON object instead of text, also for errors
    #[arg(long, global = true)]
    json: bool,
    /// Print only errors
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Set a limit on what is read or written; can be repeated. Names: file-bytes, output-bytes,
    /// paths, control-points, curve-points, elements, text-bytes, depth, coordinate (in meters)
    #[arg(long, global = true, value_name = "NAME=VALUE", value_parser = limits::setting)]
    limit: Vec<limits::Setting>,
    /// Formats that are read, such as `lif,dxf`; a file of another format is an error [default:
    /// all]
    #[arg(
        long,
        global = true,
        value_name = "A,B",
        value_delimiter = ',',
        value_parser = limits::format
    )]
    formats: Vec<Format>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Show layout files in a window and edit them
    #[cfg(feature = "viewer")]
    View(view::Args),
    /// Draw layout files as a PNG, SVG or PDF picture
    Render(Box<render::Args>),
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
pub(crate) fn main() -> ExitCode {
    let grammar = Cli::command();
    let commands: Vec<&str> = grammar
        .get_subcommands()
        .map(clap::Command::get_name)
        .collect();
    let args = default_command::insert(std::env::args_os().collect(), &commands);
    let cli = match Cli::try_parse_from(args) {
        Ok(cli) => cli,
        Err(error) => return exit_from_parser(&error),
    };
    let out = Output::new(cli.json, cli.quiet);
    if cli.json {
        out_of_memory::report_as_json();
    }
    limits::set(&cli.limit, &cli.formats);
    let ready = process::watch().and_then(|()| process::start_threads());
    match ready.and_then(|()| run(&cli.command, &out)) {
        Ok(exit) => ExitCode::from(exit.code()),
        Err(error) => {
            out.error(&error);
            ExitCode::from(ERROR)
        }
    }
}

fn run(command: &Command, out: &Output) -> Result<Exit, UserError> {
    match command {
        #[cfg(feature = "viewer")]
        Command::View(args) => view::run(args, out),
        Command::Render(args) => render::run(args, out),
        Command::Info(args) => info::run(args, out),
        Command::Check(args) => check::run(args, out),
        Command::Diff(args) => diff::run(args, out),
        Command::Convert(args) => convert::run(args, out),
        Command::Edit(args) => edit::run(args, out),
        Command::Network(args) => network::run(args, out),
        Command::Route(args) => route::run(args, out),
        Command::Generate(args) => generate::run(args, out),
        Command::Methods => methods::run(out),
        Command::Bench(args) => bench::run(args, out),
        Command::Reproduce(args) => reproduce::run(args, out),
        Command::Demo(args) => demo::run(args, out),
        Command::Completions(args) => shell::completions(args, Cli::command(), out),
        Command::Man(args) => shell::man(args, Cli::command(), out),
        Command::Schema(args) => shell::schema(args, out),
    }
}

/// Prints help, version or the error of the parser.
fn exit_from_parser(error: &clap::Error) -> ExitCode {
    let wants_json = std::env::args_os().any(|arg| arg == OsStr::new("--json"));
    if error.use_stderr() && wants_json {
        Output::new(true, false).error(&parser_error(error));
    } else {
        let text = error.render().to_string();
        // Only a closed pipe can fail here, and its reader wants no more.
        let _ = match shown_lines(&text) {
            Cow::Borrowed(_) => error.print(),
            Cow::Owned(shown) => io::stderr().write_all(shown.as_bytes()),
        };
    }
    ExitCode::from(error.exit_code() as u8)
}
