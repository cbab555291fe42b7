//! `guideway bench`: measures render methods side by side on one layout.
//!
//! | module | purpose |
//! |---|---|
//! | `args` | arguments |
//! | `contest` | the measurement that the arguments describe |
//! | `run` | measures and reports |
//! | `text` | the report as a table |
//! | `survey` | measures fixed cases instead, for a page to send |
//! | `tools` | measures the tools of a network instead |

mod args;
mod contest;
mod run;
mod survey;
mod text;
mod tools;

pub(crate) use args::Args;
pub(crate) use run::run;
