//! Maps lifts to stations.

use std::collections::HashMap;

use guideway_layout::{Code, Value};
use guideway_spline::Point;

use super::frame::Frame;
use super::level::Level;
use super::reader::{SiteReader, place};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::yaml::YamlNode;

/// Appends a station per lift of `root`. A lift is placed in the frame of its reference floor, or
/// else of the level `reference`.
///
/// # Errors
/// When the layout exceeds a limit, or when the caller cancels.
pub(super) fn map_lifts<'y>(
    reader: &mut SiteReader<'_, 'y>,
    root: YamlNode<'y>,
    levels: &[Level<'_>],
    frames: &[Frame],
    reference: usize,
) -> Result<(), ReadError> {
    let lifts = root.get("lifts");
    if let Some(odd) = lifts.filter(|lifts| !lifts.is_map() && lifts.kind() != "nothing") {
        reader.report_type(&|| place("lifts", odd), "an object of lifts", odd);
    }
    let names = levels
        .iter()
        .enumerate()
        .map(|(row, level)| (level.name, row));
    let rows: HashMap<&str, usize> = names.collect();
    for (name, lift) in lifts.into_iter().flat_map(YamlNode::entries) {
        reader.builder.check_text(name)?;
        let floor = lift.get("reference_floor_name").and_then(YamlNode::text);
        let floor = floor.and_then(|name| rows.get(name).copied());
        // A building has `x` and `y`, a navigation graph has `position`.
        let position = lift.get("position");
        let x = lift.get("x").or_else(|| position?.item(0));
        let y = lift.get("y").or_else(|| position?.item(1));
        let position = x
            .and_then(YamlNode::number)
            .zip(y.and_then(YamlNode::number));
        let frame = frames.get(floor.unwrap_or(reference));
        let position_m = position
            .zip(frame)
            .map(|((x, y), frame)| frame.to_meters(Point::new(x, y)));
        let at: PlaceFn<'_> = &|| place(&format!("lifts.{name}"), lift);
        if position_m.is_none() {
            let message = || "the lift has no position".to_owned();
            let remedy = "Give it one in the editor";
            reader
                .builder
                .report(Code::MissingField, at, message, remedy);
        }
        let position_m = position_m.filter(|&p| reader.builder.check_point(p, at));
        let builder = &mut reader.builder;
        let row = builder.push_station(name, position_m, Vec::new(), None)? as usize;
        builder.set(Table::Stations, row, "element", Value::Text("lift"))?;
        for key in ["width", "depth"] {
            if let Some(meters) = lift.get(key).and_then(YamlNode::number) {
                builder.set(Table::Stations, row, key, Value::Float(meters))?;
            }
        }
    }
    Ok(())
}
