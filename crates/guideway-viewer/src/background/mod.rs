//! Work on other threads: one task with one result, the result for the latest subject, the handle
//! that wakes the window, and which requests for a repaint show a frame.

mod latest_task;
mod redraw_timer;
mod repaint_gate;
mod task;

pub(crate) use latest_task::LatestTask;
pub(crate) use redraw_timer::RedrawTimer;
pub(crate) use repaint_gate::{RepaintGate, changes_parts_late, lay_out_again};
pub(crate) use task::{BackgroundTask, RepaintHandle};
