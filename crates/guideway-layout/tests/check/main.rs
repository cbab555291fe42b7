//! Tests of [`guideway_layout::check`] and of the page that explains its findings.

mod findings;
mod page;
mod pairs;
mod sketch;
