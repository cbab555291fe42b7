//! `guideway view`: the window.
//!
//! | module | purpose |
//! |---|---|
//! | `run` | arguments, opens the window |
//! | `file_dialog` | the file dialogs of the desktop |
//! | `project_file` | reads the text of a project |
//! | `save` | saves a layout, unless that loses too much |
//! | `services` | files, pictures and methods for the window |
//! | `measure` | `--measure`: frame times without a window |

mod file_dialog;
mod measure;
mod project_file;
mod run;
mod save;
mod services;

pub(crate) use run::{Args, run};
