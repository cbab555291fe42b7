//! `guideway view`: the window, a program of its own.
//!
//! | module | purpose |
//! |---|---|
//! | `args` | the arguments |
//! | `program` | finds the program of the window and starts it |
//! | `window` | the part of the command that this program shares |

mod args;
mod program;
pub mod window;

pub(crate) use args::Args;
pub(crate) use program::{find, run};
