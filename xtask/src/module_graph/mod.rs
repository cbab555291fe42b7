//! The graph of imports between the files of a crate, and its circles.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | parse | the files of a crate | modules: definitions, imports, paths used | `parse.rs` |
//! | resolve | modules | arrows: file A uses a definition of file B | `resolve.rs` |
//! | circles | arrows | strongly connected groups of files | `circles.rs` |
//! | workspace | the repository | the circles of every crate | `workspace.rs` |
//!
//! A file that only declares and re-exports has no arrows pointing to it: names resolve through
//! re-exports to the file that defines them. Tests (`#[cfg(test)]`) are left out.

mod circles;
mod parse;
mod resolve;
mod workspace;

pub use circles::{Circle, circles};
pub use parse::{Module, crate_modules, parse_sources};
pub use resolve::{Arrow, arrows};
pub use workspace::{crate_roots, workspace_circles};
