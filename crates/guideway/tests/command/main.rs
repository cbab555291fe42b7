//! The command as its users meet it: every test runs the real binary.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

mod arrow;
mod bench;
mod envelope;
mod render;
mod reports;
mod sarif;
mod several;
mod support;
