//! Reads speed limits: `speed` elements of lanes and roads to meters per second.

use guideway_layout::Code;
use roxmltree::Node;

use super::reader::{DocumentReader, start_m};
use crate::speed_unit;
use crate::xml::{child, children};

/// The speed limit of a lane.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum SpeedLimit {
    /// The file states none.
    Unlimited,
    /// In meters per second.
    MetersPerSecond(f64),
    /// A limit that is no speed, as written.
    Unknown(String),
}

/// The `type` elements of a road, which state the speed limits of its parts.
pub(super) struct RoadTypes<'d, 't> {
    /// Start and element, sorted by start.
    types: Vec<(f64, Node<'d, 't>)>,
}

impl<'d, 't> RoadTypes<'d, 't> {
    pub(super) fn read(road: Node<'d, 't>) -> Self {
        let types = children(road, "type").map(|node| (start_m(node), node));
        let mut types: Vec<_> = types.collect();
        types.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { types }
    }

    /// The limit on a part of the road.
    pub(super) fn limit(
        &self,
        reader: &mut DocumentReader<'_, 'd, 't>,
        [start_m, end_m]: [f64; 2],
    ) -> SpeedLimit {
        let begun = self.types.partition_point(|(start, _)| *start <= start_m);
        let end = self.types.partition_point(|(start, _)| *start < end_m);
        let part = self
            .types
            .get(begun.saturating_sub(1)..end)
            .unwrap_or_default();
        let limits = part.iter().filter_map(|(_, node)| child(*node, "speed"));
        least(reader, limits)
    }
}

/// The limit that a lane states; `None` if it is that of its road.
pub(super) fn lane_limit<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    lane: Node<'d, 't>,
) -> Option<SpeedLimit> {
    let mut limits = children(lane, "speed").peekable();
    limits.peek()?;
    Some(least(reader, limits))
}

/// The lowest one of several limits, because a path has one. Reports the others.
fn least<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    limits: impl Iterator<Item = Node<'d, 't>>,
) -> SpeedLimit {
    let mut speeds: Vec<(f64, Node<'d, 't>)> = Vec::new();
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
            Some(speed) => speeds.push((speed, node)),
            None => {
                let written: String = format!("{max} {unit}").chars().take(40).collect();
                let message = || format!("the speed limit `{written}` is no speed");
                let remedy = "It is kept as text; give a number, and the unit m/s, km/h or mph";
                let code = Code::UnknownValue;
                reader.report(code, node, message, remedy);
                return SpeedLimit::Unknown(written);
            }
        }
    }
    let least = speeds.iter().map(|(speed, _)| *speed).reduce(f64::min);
    let Some(least) = least else {
        return SpeedLimit::Unlimited;
    };
    if let Some((_, node)) = speeds.iter().find(|(speed, _)| *speed != least) {
        let message = || format!("one of several speed limits; the least is {least} m/s");
        let remedy = "The least one is used; split the lane section where the limit changes";
        reader.report(Code::Attribute, *node, message, remedy);
    }
    SpeedLimit::MetersPerSecond(least)
}
