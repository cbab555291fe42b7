//! The rules of CONTRIBUTING.md that a machine can hold: line width, file length, module headers,
//! words that must not come back, and links between files.

mod links;
mod repository;
mod rules;
mod violation;
mod words;

pub use links::check_links;
pub use repository::check_repository;
pub use rules::check_file;
pub use violation::Violation;
