//! The error of checks and of missing devices: one sentence for the output of a failed test.

/// A sentence about a failed check or a missing device.
pub type BoxError = Box<dyn std::error::Error + Send + Sync>;
