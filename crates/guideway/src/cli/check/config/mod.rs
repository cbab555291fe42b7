//! `guideway.toml`: the options of `check` for the files of a repository.
//!
//! | file | purpose |
//! |---|---|
//! | `rules` | the file as TOML, and the rules for one file |
//! | `glob` | patterns of file names |
//! | `find` | the file for a checked file: in its folder or the nearest one above |

mod find;
mod glob;
mod rules;

pub(super) use find::Configs;
pub(super) use rules::Rules;
