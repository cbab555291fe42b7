//! Checks on the source text itself: circles of modules, and the style rules of CONTRIBUTING.md.

pub mod module_graph;
pub mod style;
