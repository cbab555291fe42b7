//! Reads speed limits: `speed` elements of a lane, else of the road, to meters per second.

use guideway_layout::Code;
use roxmltree::Node;

use super::reader::DocumentReader;
use crate::speed_unit;
use crate::xml::{child, children};

/// The speed limit of a lane.
pub(super) enum SpeedLimit {
    /// The file states none.
    Unlimited,
    /// In meters per second.
    MetersPerSecond(f64),
    /// A limit that is no speed, as written.
    Unknown(String),
}

/// Returns the limit of a lane on a part of its road. Of several limits the lowest one applies,
/// because a path has one.
pub(super) fn speed_limit<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    road: Node<'d, 't>,
    lane: Node<'d, 't>,
    [start_m, end_m]: [f64; 2],
) -> SpeedLimit {
    let mut limits: Vec<Node<'d, 't>> = children(lane, "speed").collect();
    if limits.is_empty() {
        let types: Vec<Node<'d, 't>> = children(road, "type").collect();
        let start = |node: Node<'d, 't>| {
            let text = node.attribute("s").unwrap_or_default();
            text.trim().parse::<f64>().unwrap_or(0.0)
        };
        let of_part = types.iter().enumerate().filter(|(i, node)| {
            let next = types.get(i + 1).map_or(f64::INFINITY, |next| start(*next));
            start(**node) < end_m && next > start_m
        });
        limits = of_part
            .filter_map(|(_, node)| child(*node, "speed"))
            .collect();
    }
    let mut speeds = Vec::new();
    for node in limits {
        let max = node.attribute("max").unwrap_or_default().trim();
        if matches!(max, "" | "no limit" | "undefined") {
            continue;
        }
        let unit = node.attribute("unit").unwrap_or("m/s");
        match max
            .parse()
            .ok()
            .and_then(|max| speed_unit::to_si(max, unit))
        {
            Some(speed) => speeds.push(speed),
            None => {
                let written: String = format!("{max} {unit}").chars().take(40).collect();
                let message = || format!("the speed limit `{written}` is no speed");
                let remedy = "It is kept as text; give a number, and the unit m/s, km/h or mph";
                let code = Code::UnknownValue;
                reader.base.report(code, node, message, remedy);
                return SpeedLimit::Unknown(written);
            }
        }
    }
    let least = speeds.iter().copied().reduce(f64::min);
    let Some(least) = least else {
        return SpeedLimit::Unlimited;
    };
    if speeds.iter().any(|&speed| speed != least) {
        let message = || format!("the lane has several speed limits; the least is {least} m/s");
        let remedy = "The least one is used; split the lane section where the limit changes";
        reader.base.report(Code::Attribute, lane, message, remedy);
    }
    SpeedLimit::MetersPerSecond(least)
}
