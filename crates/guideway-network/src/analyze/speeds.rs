//! Speeds against bends: the lateral acceleration of a vehicle is its speed squared over the
//! radius.

use guideway_layout::{Code, Diagnostics, Layout, Member};

use super::AnalyzeOptions;
use super::finding::MAX_TYPES;
use super::finding::{Detail, Findings};
use crate::arcs::number;
use crate::bend::tightest;

/// Rounding may push an arc of exactly the limit above it.
const SLACK: f64 = 1e-3;

pub(super) fn check(
    layout: &Layout,
    vehicle_type: Option<&str>,
    options: &AnalyzeOptions,
    findings: &mut Findings,
) {
    let Some(limit) = options.lateral_acceleration_m_s2 else {
        return;
    };
    let types = layout.paths.vehicle_types();
    let own = layout
        .vehicle_types
        .iter()
        .find(|t| Some(t.id.as_str()) == vehicle_type);
    let own = own.and_then(|t| match t.attributes.value(0, "maxSpeed") {
        Some(guideway_layout::Value::Float(speed)) => Some(speed),
        _ => None,
    });
    for path in layout.paths.iter() {
        let row = path.row();
        let is_open = types.entries(row).is_empty()
            || vehicle_type.is_none_or(|name| types.entry_for(row, name).is_some());
        let on_path = number(layout, row as u32, vehicle_type, "maxSpeed");
        let speed = match (on_path, own) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        let Some(speed) = speed.filter(|_| is_open) else {
            continue;
        };
        let Some((radius_m, at)) = tightest(path) else {
            continue;
        };
        if speed * speed > limit * radius_m * (1.0 + SLACK) {
            let detail = Detail::Speed {
                speed,
                radius_m,
                limit,
                at,
            };
            findings.add(Code::LateralAcceleration, Member::Path(row as u32), detail);
        }
    }
}

/// Checks paths without nodes, for all vehicle types together.
pub(super) fn check_all(layout: &Layout, options: &AnalyzeOptions, found: &mut Diagnostics) {
    let mut findings = Findings::default();
    let names = layout.paths.vehicle_types().names();
    let mut types: Vec<Option<&str>> = names
        .iter()
        .take(MAX_TYPES)
        .map(|n| Some(n.as_str()))
        .collect();
    if types.is_empty() {
        types.push(None);
    }
    for (row, vehicle_type) in types.iter().enumerate() {
        findings.vehicle_type = row as u32;
        check(layout, *vehicle_type, options, &mut findings);
    }
    findings.report(layout, &types, found);
}
