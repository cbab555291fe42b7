//! Measures render methods side by side on the same frames.
//!
//! [`compare`] renders the same frames with several methods, one frame each in turn ([`interleaved`]), and
//! returns times, memory and work per method. A method is known by its name alone: the caller starts it
//! ([`Start`]).

mod comparison;
mod dataset;
mod dress;
mod edits;
pub mod format;
pub mod interleaved;
mod machine;
mod measured;
mod motion;
pub mod runner;
mod statistics;
mod zoomed_view;

use guideway_scene::Method;

pub use comparison::{Comparison, Contest, Contestant, SceneFacts, ViewFacts, compare};
pub use dataset::{Dataset, plain_scene};
pub use dress::Dress;
pub use edits::{Edits, Moves};
pub use machine::Machine;
pub use measured::{
    Fault, FrameTime, Measured, Outcome, PathCounts, Prepare, Row, StageTime, WorkCounts,
};
pub use motion::Motion;
pub use statistics::Summary;
pub use zoomed_view::zoomed_view;

/// Starts a method from its name and options, such as `grid+scan`; the error says why it cannot run here.
pub type Start<'a> = &'a dyn Fn(&str) -> Result<Box<dyn Method>, String>;
