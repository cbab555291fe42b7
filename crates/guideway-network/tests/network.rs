//! Tests of networks.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

#[path = "network/analyze.rs"]
mod analyze;
#[path = "network/build.rs"]
mod build;
#[path = "network/growth.rs"]
mod growth;
#[path = "network/laws.rs"]
mod laws;
#[path = "network/not_driven.rs"]
mod not_driven;
#[path = "network/notes.rs"]
mod notes;
#[path = "network/route.rs"]
mod route;
#[path = "network/sketch.rs"]
mod sketch;
#[path = "network/smooth.rs"]
mod smooth;
