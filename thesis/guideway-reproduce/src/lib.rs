//! Reproduces the thesis' tables and figures on this machine and writes the report on them.
//!
//! [`reproduce::reproduce`] follows a plan through every measurement of the thesis and records a run;
//! [`report::files`] writes the page and the tables from that record alone.

pub mod report;
pub mod reproduce;
