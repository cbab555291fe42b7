//! Tests of [`guideway_layout::check`] and of docs/diagnostics.md, which explains its findings.

mod differences;
mod driven;
mod findings;
mod in_place;
mod page;
mod pairs;
mod sketch;
mod units;
