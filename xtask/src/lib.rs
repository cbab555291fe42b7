//! Checks on the source text itself: circles of modules, and the style rules of CONTRIBUTING.md;
//! packages of a release.

pub mod dist;
pub mod files;
pub mod module_graph;
pub mod style;
