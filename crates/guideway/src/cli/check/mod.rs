//! `guideway check`: findings in layout files, each with a remedy.
//!
//! | module | purpose |
//! |---|---|
//! | `args`, `codes` | arguments, and names of findings in them |
//! | `config` | `guideway.toml`, the options for the files of a repository |
//! | `run` | checks the files, prints the report |
//! | `one_file` | reads and checks one file |
//! | `findings` | findings per file, and their number by severity |
//! | `fingerprint`, `baseline` | findings that are known and do not count |
//! | `clearance` | `--clearance`: distances between swept areas |
//! | `report`, `table`, `sarif` | the report for programs, people and code review tools |

mod args;
mod baseline;
mod clearance;
mod codes;
mod config;
mod findings;
mod fingerprint;
mod one_file;
mod report;
mod run;
mod sarif;
mod table;

pub(crate) use args::Args;
pub(crate) use run::run;
