//! `guideway check`: findings in layout files, each with a remedy.
//!
//! | module | purpose |
//! |---|---|
//! | `run` | arguments, checks the files, prints the report |
//! | `findings` | findings per file, and their number by severity |
//! | `clearance` | `--clearance`: distances between swept areas |
//! | `table`, `sarif` | the report for people and for code review tools |

mod clearance;
mod findings;
mod run;
mod sarif;
mod table;

pub(crate) use run::{Args, run};
