//! The viewer driven as a person drives it, by mouse and keys, without a window.

mod beside;
mod content;
mod desk;
mod drags;
mod files;
mod findings;
mod fingers;
mod hand;
mod journeys;
mod random;
mod recovery;
mod soak;
pub(crate) mod table;
