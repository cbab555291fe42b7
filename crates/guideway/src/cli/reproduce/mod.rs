//! `guideway reproduce`: measures the tables and figures of the thesis on this computer.
//!
//! | module | purpose |
//! |---|---|
//! | `run` | arguments; measures, continues or shows a run |
//! | `saved` | the files of a run: reads and writes them |
//! | `text` | the report on the terminal |

mod run;
mod saved;
mod text;

pub(crate) use run::{Args, run};
