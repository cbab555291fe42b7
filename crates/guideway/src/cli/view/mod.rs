//! `guideway view`: the window.
//!
//! | module | purpose |
//! |---|---|
//! | `run` | arguments, opens the window |
//! | `services` | files, pictures and methods for the window |
//! | `measure` | `--measure`: frame times without a window |

mod measure;
mod run;
mod services;

pub(crate) use run::{Args, run};
