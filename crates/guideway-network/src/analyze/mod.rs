//! Analyze: finds the faults of a network, per vehicle type.
//!
//! | module | finds |
//! |---|---|
//! | `parts` | parts that no path connects |
//! | `components` | parts that vehicles can enter and not leave, or leave and not enter |
//! | `ends` | dead ends, and one-way paths that lead to each other |
//! | `stations` | stations without a node, and those that vehicles cannot reach or leave |
//! | `turns` | turns that rotation rules forbid, and reverse driving without orientation |
//! | `speeds` | speeds that are too high for a bend |
//! | `drawing` | drawings, which have no nodes |
//!
//! `finding` merges the findings of all vehicle types; `options` has the thresholds.

mod components;
mod drawing;
mod ends;
mod finding;
mod options;
mod parts;
mod speeds;
mod stations;
mod turns;

use guideway_layout::{Code, Diagnostics, Layout, Place};

pub use options::AnalyzeOptions;

use crate::arcs::Arcs;
use finding::Findings;
use finding::MAX_TYPES;

/// Finds the faults of a network, per vehicle type: parts that are not connected, one-way parts,
/// dead ends, stations out of reach, turns and speeds that vehicles cannot drive.
///
/// An order of VDA 5050 is one route: it has no parts or dead ends. A drawing, whose paths have no
/// nodes, has one finding that says so.
///
/// Cost: linear in the number of paths and their turns, per vehicle type, for at most 64 types.
pub fn analyze(layout: &Layout, options: &AnalyzeOptions) -> Diagnostics {
    analyze_watched(layout, options, &|_| ())
}

/// Finds faults as [`analyze`] does, and tells `done` what share of the work is done, from 0 to 1.
pub fn analyze_watched(
    layout: &Layout,
    options: &AnalyzeOptions,
    done: &dyn Fn(f64),
) -> Diagnostics {
    /// Share of the work on a vehicle type that its parts, ends and stations take.
    const NETWORK: f64 = 0.6;
    let mut found = Diagnostics::with_limit(options.diagnostics_per_code);
    let has_nodes = layout.paths.iter().any(|p| p.start_node().is_some());
    if !has_nodes {
        drawing::check(layout, &mut found);
        speeds::check_all(layout, options, &mut found);
        layout.locate(&mut found);
        return found;
    }
    let names = layout.paths.vehicle_types().names();
    let types: Vec<Option<&str>> = match names.is_empty() {
        true => vec![None],
        false => names
            .iter()
            .take(MAX_TYPES)
            .map(|name| Some(name.as_str()))
            .collect(),
    };
    let mut findings = Findings::default();
    let is_route = layout.provenance.format == "VDA 5050";
    let of_types = |types_done: f64| done(types_done / types.len() as f64);
    for (row, &vehicle_type) in types.iter().enumerate() {
        of_types(row as f64);
        let arcs = Arcs::of(layout, vehicle_type);
        findings.vehicle_type = row as u32;
        if !is_route {
            let components = components::Components::of(layout, &arcs);
            parts::check(layout, &arcs, &mut findings);
            components::check(&arcs, &components, &mut findings);
            ends::check(layout, &arcs, &components, &mut findings);
            stations::check_access(layout, &arcs, &components, &mut findings);
        }
        of_types(row as f64 + NETWORK);
        turns::check(layout, vehicle_type, &arcs, options, &mut findings);
        speeds::check(layout, vehicle_type, options, &mut findings);
    }
    stations::check_nodes(layout, &mut findings);
    findings.report(layout, &types, &mut found);
    if names.len() > MAX_TYPES {
        found.push(
            Code::NotAnalyzed,
            || Place::element("vehicle types"),
            || {
                let count = names.len();
                format!("{count} vehicle types; the network is analyzed for the first {MAX_TYPES}")
            },
            "Check the vehicle types one by one, in files of their own",
        );
    }
    layout.locate(&mut found);
    done(1.0);
    found
}
