//! A finding: one claim of the thesis with its verdict in a run.

use serde::{Deserialize, Serialize};

/// One claim of the thesis with its verdict in a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Topic of the claim.
    pub title: String,
    /// Section of the thesis.
    pub section: String,
    /// The claim.
    pub claim: String,
    /// Verdict of the run.
    pub verdict: Verdict,
    /// The deciding numbers and their meaning.
    pub evidence: String,
}

/// Verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The claim holds in this run.
    Holds,
    /// The claim does not hold in this run.
    DoesNotHold,
    /// The run lacks the measurements.
    NotMeasured,
}
