//! The command line: one module per subcommand, and the modules that they share.
//!
//! | module | purpose |
//! |---|---|
//! | `app` | parses arguments, dispatches to a subcommand, exits |
//! | `input`, `floor_plan`, `envelope`, `arrow`, `relative_path`, `values`, `limits`, `threads` | read arguments and files |
//! | `output`, `stdout`, `text`, `progress_bar`, `error`, `exit`, `interrupt` | reports, errors, signals |
//! | all others | one subcommand each |

mod app;
mod arrow;
mod bench;
mod check;
mod convert;
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
