//! The command line: one module per subcommand, and the modules that they share.
//!
//! | module | purpose |
//! |---|---|
//! | `default_command` | the command that `guideway FILE` means |
//! | `app` | parses arguments, dispatches to a subcommand, exits |
//! | `input`, `floor_plan`, `envelope`, `arrow`, `relative_path`, `values`, `limits`, `threads` | read arguments and files |
//! | `picture_file` | names of pictures |
//! | `output`, `stdout`, `text`, `progress_bar`, `error`, `exit`, `interrupt` | reports, errors, signals |
//! | all others | one subcommand each |

mod app;
mod arrow;
mod bench;
mod check;
mod convert;
mod default_command;
mod demo;
mod diff;
mod edit;
mod envelope;
mod error;
mod exit;
mod floor_plan;
mod generate;
mod info;
mod input;
mod interrupt;
mod limits;
mod methods;
mod network;
mod output;
mod picture_file;
mod progress_bar;
mod relative_path;
mod render;
mod reproduce;
mod route;
mod shell;
mod stdout;
mod text;
mod threads;
mod values;
#[cfg(feature = "viewer")]
mod view;

pub(crate) use app::main;
