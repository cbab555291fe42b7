//! Maps lifts to stations.

use std::collections::HashMap;

use guideway_layout::{Code, Quantity, Value};
use guideway_spline::Point;

use super::frame::Frame;
use super::level::Level;
use super::parameters::{set_json, set_parameters};
use super::reader::{SiteReader, place};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::yaml::YamlNode;

/// Lists and objects of a lift that become columns.
const NESTED: [&str; 2] = ["level_doors", "doors"];

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
        // A building has `x`, `y`, `yaw`, `width` and `depth`; a navigation graph has `position`
        // and `dims`.
        let number = |key: &str, (list, index): (&str, usize)| {
            let of_list = || lift.get(list)?.item(index);
            lift.get(key).or_else(of_list).and_then(YamlNode::number)
        };
        let position = number("x", ("position", 0)).zip(number("y", ("position", 1)));
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
        let nodes = reader.lifts.remove(name).unwrap_or_default();
        let builder = &mut reader.builder;
        let row = builder.push_station(name, position_m, nodes, None)? as usize;
        let source = &mut builder.layout.stations.source;
        source.set_position(row, lift.position());
        builder.set(Table::Stations, row, "kind", Value::Text("lift"))?;
        for (key, entry, quantity) in [
            ("theta", number("yaw", ("position", 2)), Quantity::Angle),
            ("width", number("width", ("dims", 0)), Quantity::Length),
            ("depth", number("depth", ("dims", 1)), Quantity::Length),
        ] {
            if let Some(value) = entry {
                let attributes = builder.attributes(Table::Stations);
                attributes.set_quantity(row, key, value, quantity);
            }
        }
        let is_elsewhere = |key: &str| {
            let known = ["x", "y", "yaw", "width", "depth", "position", "dims"];
            known.contains(&key) || NESTED.contains(&key)
        };
        for key in NESTED {
            if let Some(node) = lift.get(key).filter(|node| node.is_map() || node.is_list()) {
                set_json(reader, (Table::Stations, row), key, node, at)?;
            }
        }
        set_parameters(reader, (Table::Stations, row), lift, is_elsewhere, at)?;
    }
    Ok(())
}
