//! `guideway view`: the window.
//!
//! | module | purpose |
//! |---|---|
//! | `run` | arguments, opens the window |
//! | `services` | files, pictures and methods for the window |
//! | `floor_plan` | a floor plan that the window renders again and again |
//! | `measure` | `--measure`: frame times without a window |

mod floor_plan;
mod measure;
mod run;
mod services;

pub(crate) use run::{Args, run};
