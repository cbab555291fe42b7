//! Shared parts of the whole-system tests: scenes, methods to test, and comparison with the oracle.
//!
//! | module | purpose |
//! |---|---|
//! | [`sketch`], [`scenes`] | describes a drawing in pixels; the scene suite |
//! | [`edits`], [`random`] | seeded random edits and numbers |
//! | [`methods`], [`devices`] | methods on the processor, and on graphics devices |
//! | [`compare`], [`hairline`] | compares pictures, and pictures of one-pixel lines |
//! | [`evidence`] | writes pictures of failed comparisons |
//! | [`parallel`] | runs a function over a list on all threads |

pub mod compare;
pub mod devices;
pub mod edits;
pub mod evidence;
pub mod hairline;
pub mod methods;
pub mod parallel;
pub mod random;
pub mod scenes;
pub mod sketch;

/// A sentence about a failed check or a missing device, for the output of a failed test.
pub type BoxError = Box<dyn std::error::Error + Send + Sync>;
