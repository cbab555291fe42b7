//! `guideway bench`: measures render methods side by side on one layout.
//!
//! | module | purpose |
//! |---|---|
//! | `args` | arguments |
//! | `contest` | the measurement that the arguments describe |
//! | `run` | measures and reports |
//! | `text` | the report as a table |

mod args;
mod contest;
mod run;
mod text;

pub(crate) use args::Args;
pub(crate) use run::run;
