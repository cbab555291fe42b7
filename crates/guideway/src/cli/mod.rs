//! The command line, with the feature `cli`: [`main`] is the command, [`window`] its part in the
//! program of the window. One module per subcommand, and the modules that they share.
//!
//! | module | purpose |
//! |---|---|
//! | `default_command` | the command that `guideway FILE` means |
//! | `app`, `start` | parse arguments, dispatch to a subcommand, exit |
//! | `input`, `image_name`, `floor_plan`, `envelope`, `number_args`, `values`, `limits` | read arguments and files |
//! | `layout_output`, `picture_file`, `picture_output` | outputs: layouts, names of pictures, pictures |
//! | `output`, `stdout`, `text`, `colors`, `progress_bar`, `error`, `process`, `panic` | reports, errors, exit codes, threads and signals |
//! | all others | one subcommand each |

mod app;
mod bench;
mod check;
mod colors;
mod convert;
mod default_command;
mod demo;
mod diff;
mod doctor;
mod edit;
mod envelope;
mod error;
mod floor_plan;
mod generate;
mod image_name;
mod info;
mod input;
mod layout_output;
mod limits;
mod methods;
mod network;
mod number_args;
mod output;
mod packed;
#[cfg(panic = "abort")]
mod panic;
mod part_progress;
mod picture_file;
mod picture_output;
mod process;
mod progress_bar;
mod render;
mod reproduce;
mod route;
mod share;
mod shell;
mod start;
mod stdout;
mod text;
mod tiles;
mod values;
mod view;

pub use app::main;
pub use view::window;

pub use crate::out_of_memory::Allocator;
