//! Frames from view to pixels.

mod budget;
mod edits;
mod gesture;
mod picture_cache;
