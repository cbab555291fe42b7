//! Measures render methods side by side, and reproduces the thesis' tables and figures with them.
//!
//! [`compare`] lets methods draw the same frames in turns. [`reproduce::reproduce`] follows a plan through
//! every measurement of the thesis and writes down a run; [`report::files`] makes the page and the tables
//! from that alone. No method is known by more than its name: the caller starts them ([`Start`]).

mod comparison;
mod dataset;
mod dress;
mod edits;
mod machine;
mod measured;
mod motion;
mod near;
pub mod report;
pub mod reproduce;
mod runner;
mod statistics;
mod turns;
mod words;

use guideway_render::Method;

pub use comparison::{Comparison, Contest, Contestant, SceneFacts, ViewFacts, compare};
pub use dataset::{Dataset, plain_scene};
pub use dress::Dress;
pub use edits::Moves;
pub use machine::Machine;
pub use measured::{FrameTime, Measured, Outcome, PathCounts, Prepare, Row, StageTime, WorkCounts};
pub use motion::Motion;
pub use statistics::Summary;

/// Starts the method of this name with its options, such as `grid+scan`, or says why it does not run here.
pub type Start<'a> = &'a dyn Fn(&str) -> Result<Box<dyn Method>, String>;
