//! Draws a frame: from a view to pixels.
//!
//! | module            | does                                                                     |
//! |-------------------|--------------------------------------------------------------------------|
//! | `state`           | the scene and what lasts between frames                                  |
//! | `prepared`        | renders frames                                                           |
//! | `changes`         | applies edits, colors and gestures                                       |
//! | `clusters`        | clusters, cached lines and styles of the scene                           |
//! | `memory`          | plans a frame within the budget                                          |
//! | `pipeline`        | runs the stages for the bands of a frame                                 |
//! | `flatten_visible` | flattens the visible clusters of a band                                  |
//! | `picture_cache`   | reuses the last picture after a pan or an edit                           |

mod changes;
pub(super) mod clusters;
pub(super) mod flatten_visible;
pub(super) mod memory;
pub(super) mod picture_cache;
pub(super) mod pipeline;
pub(super) mod prepared;
pub(super) mod state;
#[cfg(test)]
mod tests;
