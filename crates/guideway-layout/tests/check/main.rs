//! Tests of [`guideway_layout::check`] and of docs/diagnostics.md, which explains its findings.

mod findings;
mod page;
mod pairs;
mod sketch;
