//! The viewer driven as a person drives it, by mouse and keys, without a window.

mod desk;
mod journeys;
mod random;
pub(crate) mod table;
