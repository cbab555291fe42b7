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
//! | `picture`, `holder` | `--picture`: the findings in the layout |
//! | `clearance` | `--clearance`: distances between swept areas |
//! | `report`, `table`, `sarif` | the report for programs, people and code review tools |

mod args;
mod baseline;
mod clearance;
mod codes;
mod config;
mod findings;
mod fingerprint;
mod holder;
mod one_file;
mod picture;
mod report;
mod run;
mod sarif;
mod table;

use guideway::layout::{Diagnostics, Layout};

pub(crate) use args::Args;
pub(crate) use picture::write as write_picture;
pub(crate) use run::run;

use self::config::Rules;
use self::findings::CheckedFile;
use super::input::Input;

/// The findings of a layout as a table with a few of each kind.
pub(crate) fn findings_text(file: &Input, layout: &Layout, found: Diagnostics) -> String {
    /// Findings per kind.
    const SHOWN: usize = 3;
    let mut checked = CheckedFile::new(file, None, &Rules::default());
    checked.paths = layout.path_count() as u64;
    checked.refused = layout.refused.len() as u64;
    checked.found = found;
    table::text(&checked, SHOWN)
}
