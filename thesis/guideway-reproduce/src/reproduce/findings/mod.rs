//! Judges the claims of the thesis: from a run to one verdict per claim, with its evidence.
//!
//! | module | purpose |
//! |---|---|
//! | `claims` | the claims, and the function that judges them all |
//! | `build`, `frame`, `most_paths` | judges by the part of the run that they read |
//! | `judgment` | the result of a judge, and helpers |
//! | `finding` | the claim with its verdict, as the report shows it |

mod build;
mod claims;
mod finding;
mod frame;
mod judgment;
mod most_paths;
#[cfg(test)]
mod tests;

pub use claims::findings;
pub use finding::{Finding, Verdict};
