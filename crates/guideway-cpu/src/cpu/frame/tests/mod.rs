//! Frames from view to pixels.

mod budget;
mod edits;
mod picture_cache;
