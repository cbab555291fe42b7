//! `guideway completions`, `guideway man` and `guideway schema`: descriptions of the command for
//! shells, people and programs.

use std::path::{Path, PathBuf};

use clap_complete::Shell;
use guideway::layout::{UserError, shown_path};
use serde_json::{Value, json};

use super::error::{Exit, json_error, usage_error};
use super::input::check_no_stdout;
use super::output::{self, Output};
use super::packed;

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

#[derive(Debug, clap::Args)]
pub(crate) struct SchemaArgs {
    /// The command, or `error`; all of them without it
    command: Option<String>,
}

pub(crate) fn schema(args: &SchemaArgs, out: &Output) -> Result<Exit, UserError> {
    let remedy = "Report this as a bug of the program";
    let schema =
        serde_json::from_str(&packed::answers()?).map_err(|error| json_error(&error, remedy));
    let mut schema: Value = schema?;
    if let Some(command) = &args.command {
        if schema["$defs"].get(command).is_none() {
            let known = schema["$defs"].as_object().into_iter().flatten();
            let known: Vec<&str> = known.map(|(name, _)| name.as_str()).collect();
            return Err(usage_error(
                format!("`{command}` is no command with an answer in JSON"),
                format!("Name one of {}", known.join(", ")),
            ));
        }
        schema = json!({
            "$schema": schema["$schema"],
            "$ref": format!("#/$defs/{command}"),
            "$defs": schema["$defs"],
        });
    }
    let text = serde_json::to_string_pretty(&schema).map_err(|error| json_error(&error, remedy))?;
    print_or_report(out, "schema", "schema", (text + "\n").as_bytes())?;
    Ok(Exit::Clean)
}

pub(crate) fn completions(
    args: &CompletionsArgs,
    mut command: clap::Command,
    out: &Output,
) -> Result<Exit, UserError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "guideway", &mut script);
    print_or_report(out, "completions", "script", &script)?;
    Ok(Exit::Clean)
}

pub(crate) fn man(args: &ManArgs, command: clap::Command, out: &Output) -> Result<Exit, UserError> {
    match &args.dir {
        None => {
            let mut page = Vec::new();
            clap_mangen::Man::new(command)
                .render(&mut page)
                .map_err(|error| save_error("standard output", &error))?;
            print_or_report(out, "man", "page", &page)?;
        }
        Some(dir) => {
            check_no_stdout(dir)?;
            std::fs::create_dir_all(dir).map_err(|error| save_error(&shown_path(dir), &error))?;
            let mut command = command.disable_help_subcommand(true);
            command.build();
            write_pages(&command, dir)?;
            let folder = shown_path(dir);
            out.report("man", &json!({ "folder": folder }), || {
                format!("manual pages are in {folder}\n")
            })?;
        }
    }
    Ok(Exit::Clean)
}

/// Prints a text, or with `--json` an object that holds it.
fn print_or_report(out: &Output, name: &str, key: &str, text: &[u8]) -> Result<(), UserError> {
    if !out.is_json() {
        return output::print(text);
    }
    let text = String::from_utf8_lossy(text);
    out.report(name, &json!({ key: text }), String::new)
}

/// Writes the pages of a command and its subcommands, each whole or not at all.
fn write_pages(command: &clap::Command, dir: &Path) -> Result<(), UserError> {
    let visible = |command: &&clap::Command| !command.is_hide_set();
    for subcommand in command.get_subcommands().filter(visible) {
        write_pages(subcommand, dir)?;
    }
    let page = clap_mangen::Man::new(command.clone());
    let file = dir.join(page.get_filename());
    let mut text = Vec::new();
    page.render(&mut text)
        .map_err(|error| save_error(&shown_path(&file), &error))?;
    output::save(&file, &text)
}

fn save_error(target: &str, error: &std::io::Error) -> UserError {
    UserError::new(
        "save",
        format!("{target}: cannot write the manual page: {error}"),
        "Check that the folder exists and that you may write to it",
    )
}
