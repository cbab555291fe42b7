//! `guideway tiles`: layout files as tiles for maps in browsers, in one PMTiles file.
//!
//! | module | purpose |
//! |---|---|
//! | `args` | files, output, zooms, content and style |
//! | `unfinished` | the journal beside the output, by which a stopped run goes on |
//! | `run` | reads the files, makes the tiles, writes the archive, prints the report |

mod args;
mod run;
mod unfinished;

pub(crate) use args::Args;
pub(crate) use run::run;
