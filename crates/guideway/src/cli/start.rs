//! The options of every command, and how a run starts and ends: the same for the command and for
//! the program of the window.

use std::borrow::Cow;
use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use guideway::formats::Format;
use guideway::layout::{UserError, shown_lines};

use super::colors::When;
use super::error::{ERROR, Exit, parser_error};
use super::output::{Output, stdout_error};
use super::{limits, process};
use crate::out_of_memory;

/// Options that every command takes.
#[derive(Debug, clap::Args)]
pub(super) struct GlobalOptions {
    /// Print one JSON object instead of text, also for errors
    #[arg(long, global = true)]
    json: bool,
    /// Print only errors
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Color severities, hints and help: `auto` on a terminal, unless NO_COLOR is set
    #[arg(
        long,
        global = true,
        value_name = "WHEN",
        default_value = "auto",
        value_parser = When::parser()
    )]
    color: When,
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

/// Parses the arguments, or prints help, version or the error of the parser and returns the exit
/// code.
pub(super) fn parse<C: Parser>(args: Vec<OsString>) -> Result<C, ExitCode> {
    C::try_parse_from(&args).map_err(|error| {
        When::in_arguments(&args).apply();
        exit_from_parser(&error, &args)
    })
}

/// Runs a task with the options of every command. Returns its exit code.
pub(super) fn run(
    options: &GlobalOptions,
    task: impl FnOnce(&Output) -> Result<Exit, UserError>,
) -> ExitCode {
    options.color.apply();
    let out = Output::new(options.json, options.quiet);
    #[cfg(panic = "abort")]
    super::panic::end_by_panic(out);
    if options.json {
        out_of_memory::report_as_json();
    }
    limits::set(&options.limit, &options.formats);
    let ready = process::watch().and_then(|()| process::start_threads());
    match ready.and_then(|()| task(&out)) {
        Ok(exit) => ExitCode::from(exit.code()),
        Err(error) => {
            out.error(&error);
            ExitCode::from(ERROR)
        }
    }
}

/// Prints help, version or the error of the parser.
fn exit_from_parser(error: &clap::Error, args: &[OsString]) -> ExitCode {
    let wants_json = args.iter().any(|arg| arg == "--json");
    if error.use_stderr() && wants_json {
        Output::new(true, false).error(&parser_error(error));
    } else {
        let text = error.render().to_string();
        let printed = match shown_lines(&text) {
            Cow::Borrowed(_) => error.print(),
            Cow::Owned(shown) => io::stderr().write_all(shown.as_bytes()),
        };
        // The reader of a closed pipe wants no more, and without standard error nobody listens.
        if let Err(problem) = printed
            && !error.use_stderr()
            && problem.kind() != io::ErrorKind::BrokenPipe
        {
            Output::new(wants_json, false).error(&stdout_error(&problem));
            return ExitCode::from(ERROR);
        }
    }
    ExitCode::from(error.exit_code() as u8)
}
