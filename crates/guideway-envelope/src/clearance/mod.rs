//! Checks the clearance of paths to each other and to walls: layout in, findings out.
//!
//! `pairs` compares paths, `walls` compares paths with a floor plan, and `joints` finds where paths
//! meet, so that vehicles may be near each other there.

mod check;
mod joints;
mod pairs;
mod report;
mod walls;

pub use check::check_clearance;
pub use report::{ClearanceOptions, ClearanceReport, ClearanceWork};
pub use walls::Walls;
