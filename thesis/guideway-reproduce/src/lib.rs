//! Reproduces the tables and figures of the thesis on this computer, and writes the report.
//!
//! | stage | input | output |
//! |---|---|---|
//! | [`reproduce::reproduce`], [`reproduce::resume`] | a plan, or an incomplete run | a run |
//! | [`reproduce::findings`] | a run | verdicts on the claims of the thesis |
//! | [`report::files`] | a run | the page and the CSV tables |

pub mod report;
pub mod reproduce;
