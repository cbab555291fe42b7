//! Measures render methods side by side on the same frames.
//!
//! [`compare`] takes a [`Contest`] (a scene, a view, a motion and a list of methods), renders its
//! frames with every method, one frame each in turn ([`interleaved`]), and returns times, memory
//! and counted work per method. The crate knows methods by name only: the caller starts them
//! ([`Start`]).
//!
//! | module | purpose |
//! |---|---|
//! | `dataset`, `style_preset` | scenes to measure, and their colors and widths |
//! | `zoomed_view`, `motion`, `edits` | the view, and its change from frame to frame |
//! | `start` | starts a method from its name |
//! | [`runner`] | prepares one method and times its frames |
//! | [`interleaved`] | draws the frames of several runners in turns |
//! | `comparison` | measures a whole contest |
//! | `tools`, `plan`, `peak_memory` | measures network, check, route and diff on one plan |
//! | `measured`, `statistics`, `machine` | the report: results, summaries, the computer |
//! | [`survey`] | measures the same contests on each computer, for a page to send |
//! | [`mod@format`], [`page`] | numbers for tables and sentences; parts of a page |

mod comparison;
mod dataset;
mod edits;
pub mod format;
pub mod interleaved;
mod machine;
mod measured;
mod motion;
pub mod page;
mod peak_memory;
mod plan;
pub mod runner;
mod start;
mod statistics;
mod style_preset;
pub mod survey;
mod tools;
mod zoomed_view;

pub use comparison::{Comparison, Contest, Contestant, SceneFacts, ViewFacts, compare};
pub use dataset::{Dataset, plain_scene};
pub use edits::{Change, Edits, Moves, Way};
pub use machine::Machine;
pub use measured::{
    FrameTime, MeasureError, Measured, Outcome, PathCounts, Prepare, Row, StageTime, WorkCounts,
};
pub use motion::Motion;
pub use start::{Start, StartError};
pub use statistics::Summary;
pub use style_preset::StylePreset;
pub use tools::{ToolError, ToolRow, measure_tools};
pub use zoomed_view::zoomed_view;
