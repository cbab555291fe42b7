//! Checks the clearance of a whole layout.

use guideway_layout::{Code, Diagnostics, Layout, Place};

use super::pairs;
use super::report::{ClearanceOptions, ClearanceReport};
use super::walls::Walls;
use crate::source::EnvelopeSource;

/// Finds paths whose envelopes come closer to each other, or to walls, than the clearance.
///
/// Never compares paths of different levels, or paths along the same curve, which are one road. Two
/// paths that meet at an end are compared except where both vehicles are near that end. The same
/// holds for paths whose ends are connected by paths so short that vehicles at both ends would
/// violate the clearance. Still found are, for example, crossings without a node and parallel lanes
/// that are too close.
pub fn check_clearance(
    layout: &Layout,
    source: EnvelopeSource,
    walls: Option<&Walls>,
    options: &ClearanceOptions,
) -> ClearanceReport {
    let mut findings = Diagnostics::with_limit(options.diagnostics_per_code);
    let mut work = pairs::check(layout, source, options, &mut findings);
    if let Some(walls) = walls {
        work = work.plus(walls.check(layout, source, options, &mut findings));
    }
    work.doubtful = source.doubtful(layout);
    // First, because the list stores only the first findings of a code.
    let mut first = Diagnostics::with_limit(options.diagnostics_per_code);
    if work.incomplete > 0 {
        first.push(
            Code::Clearance,
            || Place::element("paths"),
            || {
                format!(
                    "{} of {} paths were compared with a part of what is near them only: each may \
                     take {} distances",
                    work.incomplete,
                    work.paths,
                    options.tests_per_path(layout.paths.len())
                )
            },
            "Mend the other findings first; then check parts of the layout by themselves",
        );
    }
    first.append(findings);
    let mut findings = first;
    layout.locate(&mut findings);
    ClearanceReport { findings, work }
}
