//! `guideway share`: layout files as one HTML file that opens in a browser, without a server.
//!
//! | module | purpose |
//! |---|---|
//! | `args` | files, output, title, view, colors, floor plan, vehicle |
//! | `page` | the page of this build, with a layout put into it |
//! | `fonts` | the fonts that the page needs beside its own |
//! | `run` | reads the files, writes the page, prints the report |

mod args;
mod fonts;
mod page;
mod run;

pub(crate) use args::Args;
pub(crate) use page::SharedLook;
pub(crate) use run::{Content, is_page, run, write};
