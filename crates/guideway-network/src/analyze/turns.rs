//! Turns from path to path that rotation rules forbid, and reverse driving without orientation.
//!
//! A node is reported if a path that leads to it has no continuation that vehicles can take, or a
//! path that leads away has none before it. At a crossing without rotation, straight on is enough.

use guideway_layout::{Code, Layout, Member};

use super::AnalyzeOptions;
use super::finding::{Detail, Findings};
use crate::arcs::{Arc, Arcs};
use crate::heading::Headings;

/// Paths in and out of a node that are compared, each with each. A node with more is no corner.
const MAX_COMPARED: usize = 32;

pub(super) fn check(
    layout: &Layout,
    vehicle_type: Option<&str>,
    arcs: &Arcs,
    options: &AnalyzeOptions,
    findings: &mut Findings,
) {
    let paths = &layout.paths;
    let has_rules = ["rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed"];
    if !has_rules.iter().all(|name| paths.has_column(name)) {
        return;
    }
    let headings = Headings {
        layout,
        vehicle_type,
    };
    for node in 0..arcs.node_count() {
        let rows = |rows: &[u32]| -> Vec<Arc> {
            rows.iter()
                .take(MAX_COMPARED)
                .map(|&row| arcs.get(row))
                .collect()
        };
        let (entering, leaving) = (rows(arcs.entering(node)), rows(arcs.leaving(node)));
        if let Some(detail) = forbidden(&headings, &entering, &leaving, options) {
            let code = match detail {
                Detail::Reverse { .. } => Code::ReverseDriving,
                _ => Code::HeadingJump,
            };
            findings.add(code, Member::Node(node), detail);
        }
    }
}

/// The first way through a node that has no alternative and that vehicles cannot take.
fn forbidden(
    headings: &Headings<'_>,
    entering: &[Arc],
    leaving: &[Arc],
    options: &AnalyzeOptions,
) -> Option<Detail> {
    let of_entering = entering.iter().map(|&from| {
        let pairs: Vec<(Arc, Arc)> = leaving.iter().map(|&to| (from, to)).collect();
        least(headings, &pairs, options)
    });
    let of_leaving = leaving.iter().map(|&to| {
        let pairs: Vec<(Arc, Arc)> = entering.iter().map(|&from| (from, to)).collect();
        least(headings, &pairs, options)
    });
    of_entering.chain(of_leaving).flatten().next()
}

/// The fault that all of some ways have; `None` if vehicles can take one of them.
fn least(
    headings: &Headings<'_>,
    pairs: &[(Arc, Arc)],
    options: &AnalyzeOptions,
) -> Option<Detail> {
    let mut best: Option<(f64, Detail)> = None;
    // The way back counts only where there is no other one.
    let is_back = |&&(from, to): &&(Arc, Arc)| to.to == from.from && from.from != from.to;
    let is_only_back = pairs.iter().all(|pair| is_back(&pair));
    for &(from, to) in pairs.iter().filter(|pair| is_only_back || !is_back(pair)) {
        if !headings.is_rigid(from, to) {
            return None;
        }
        let angle_rad = headings.turn_rad(from, to);
        let lacks_orientation = is_only_back && !headings.is_stated(to);
        if angle_rad <= options.turn_angle_rad && !lacks_orientation {
            return None;
        }
        let (from, to) = (from.path, to.path);
        let detail = match lacks_orientation {
            true => Detail::Reverse { from, to },
            false => Detail::Turn {
                from,
                to,
                angle_rad,
            },
        };
        if best.is_none_or(|(least, _)| angle_rad < least) {
            best = Some((angle_rad, detail));
        }
    }
    best.map(|(_, detail)| detail)
}
