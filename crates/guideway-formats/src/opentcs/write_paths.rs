//! Writes the paths of a plant: speeds, lengths, control points.

use std::collections::HashMap;
use std::io::{self, Write};

use guideway_layout::{Layout, Value};
use guideway_spline::run_length;
use serde_json::{Map, Value as Json};

use super::context::Context;
use super::elements::PERIPHERAL_OPERATION;
use super::held::held_by_path;
use super::layers::Layers;
use super::path_mapper::PERIPHERAL_OPERATIONS;
use super::values::{SAME_NUMBER, is_two_way, json, number, speed_mm_s};
use super::write_elements::write_fields;
use super::write_places::{Rounding, write_envelopes};
use super::xml_writer::XmlWriter;
use crate::Losses;

/// Speed of paths without one, in mm/s: that of a new path in the editor. openTCS takes 0 as
/// closed.
const DEFAULT_SPEED_MM_S: i32 = 1000;

/// Precision of computed lengths, in meters.
const LENGTH_TOLERANCE_M: f64 = 1e-4;

/// Counts what changes.
#[derive(Default)]
struct Changes {
    without_speed: usize,
    without_length: usize,
    speeds: usize,
    reverse_speeds: usize,
    lengths: usize,
    operations: usize,
    /// Two-way paths that are closed both ways.
    closed: usize,
    /// Two-way paths that are closed from their start to their end.
    half_closed: usize,
}

/// Writes all paths with a curve, and counts each of them.
pub(super) fn write_paths<W: Write>(
    context: &Context<'_>,
    layers: &mut Layers,
    xml: &mut XmlWriter<'_, W>,
    losses: &mut Losses,
    count: impl Fn(),
) -> io::Result<()> {
    let mut changes = Changes::default();
    let mut rounding = Rounding::default();
    let stations = &context.layout.stations;
    let mut station_rows = HashMap::new();
    for row in 0..stations.len() as u32 {
        station_rows.entry(stations.id(row)).or_insert(row as usize);
    }
    let written_name = |id: &str| {
        let row = station_rows.get(id)?;
        Some(&*context.plant.station_names[*row])
    };
    for row in 0..context.layout.paths.len() {
        count();
        write_path(
            context,
            layers,
            xml,
            row,
            &written_name,
            (&mut changes, &mut rounding),
        )?;
    }
    rounding.add_to("paths", losses);
    let speed = f64::from(DEFAULT_SPEED_MM_S) / 1e3;
    let detail = format!("paths without a speed: written with {speed} m/s");
    losses.add("column maxSpeed", changes.without_speed, detail);
    let detail = "paths without a length: written with that of their curve";
    losses.add("column length", changes.without_length, detail);
    let detail = "values of paths, rounded to mm/s";
    losses.add("column maxSpeed", changes.speeds, detail);
    losses.add("column maxReverseSpeed", changes.reverse_speeds, detail);
    losses.add(
        "column length",
        changes.lengths,
        "values of paths, rounded to millimeters",
    );
    let detail = "values of paths: operations at stations that do not exist";
    losses.add(
        format!("column {PERIPHERAL_OPERATIONS}"),
        changes.operations,
        detail,
    );
    let detail = "two-way paths of speed 0: closed, which readers take as one-way";
    losses.add("directions", changes.closed, detail);
    let detail = "two-way paths of speed 0, but for their way back: written as its one-way paths";
    for what in [
        "directions",
        "curves",
        "column maxSpeed",
        "column maxReverseSpeed",
    ] {
        losses.add(what, changes.half_closed, detail);
    }
    Ok(())
}

fn write_path<'n, W: Write>(
    context: &'n Context<'_>,
    layers: &mut Layers,
    xml: &mut XmlWriter<'_, W>,
    row: usize,
    station_name: &impl Fn(&str) -> Option<&'n str>,
    (changes, rounding): (&mut Changes, &mut Rounding),
) -> io::Result<()> {
    let &Context { layout, plant, .. } = context;
    let (Some(mut ends), Some(drawn)) = (plant.ends[row], context.drawn.get(row)) else {
        return Ok(());
    };
    if drawn.is_reversed {
        ends.reverse();
    }
    let attributes = &layout.paths.attributes;
    let value = |name: &str| attributes.value(row, name);
    let [source, destination] = ends.map(|point| &plant.points[point as usize].name);
    xml.begin("path")?;
    xml.attribute("name", &plant.path_names[row])?;
    xml.attribute("sourcePoint", source)?;
    xml.attribute("destinationPoint", destination)?;
    xml.attribute("length", length_mm(layout, row, changes))?;
    let [forward, reverse] = speeds_mm_s(layout, row, drawn.is_reversed, changes);
    xml.attribute("maxVelocity", forward)?;
    xml.attribute("maxReverseVelocity", reverse)?;
    xml.attribute("locked", value("locked") == Some(Value::Bool(true)))?;
    let operations: Vec<Map<String, Json>> = json(value(PERIPHERAL_OPERATIONS)).unwrap_or_default();
    let mut lost = 0;
    for mut operation in operations {
        let station = operation.get("locationName").and_then(Json::as_str);
        let Some(name) = station.and_then(station_name) else {
            lost += 1;
            continue;
        };
        operation.insert("locationName".into(), name.into());
        xml.begin(PERIPHERAL_OPERATION.tag)?;
        write_fields(xml, &PERIPHERAL_OPERATION, &operation)?;
        xml.end()?;
    }
    changes.operations += usize::from(lost > 0);
    write_envelopes(xml, attributes, row, rounding)?;
    let held =
        |row, name: &str, value: Value<'_>| held_by_path(layout, context.drawn, row, name, value);
    context.properties.write(xml, attributes, row, held)?;
    let level = layout.paths.get(row).level();
    let layer = layers.id(layout, attributes, row, level);
    xml.begin("pathLayout")?;
    xml.attribute("connectionType", drawn.shape.connection.name())?;
    xml.attribute("layerId", layer)?;
    for [x, y] in &drawn.control_units {
        xml.element("controlPoint", &[("x", x), ("y", y)])?;
    }
    xml.end()?;
    xml.end()
}

/// The length of a path, or else of its curve, in whole millimeters from 1 on.
fn length_mm(layout: &Layout, row: usize, changes: &mut Changes) -> u32 {
    let stated = number(layout.paths.attributes.value(row, "length"));
    let stated = stated.filter(|length| *length >= 0.0);
    let meters = stated.unwrap_or_else(|| {
        changes.without_length += 1;
        let runs = layout.paths.get(row).runs();
        let length = |run: guideway_layout::RunPoints<'_>| {
            run_length(&run.iter().collect::<Vec<_>>(), LENGTH_TOLERANCE_M)
        };
        runs.map(length).sum()
    });
    let mm = (meters * 1e3).round().clamp(1.0, f64::from(u32::MAX));
    let is_same = (mm - meters * 1e3).abs() <= SAME_NUMBER * mm;
    changes.lengths += usize::from(stated.is_some() && !is_same);
    mm as u32
}

/// Speeds from the source to the destination of the file, and back, in mm/s; 0 where the path is
/// not driven.
fn speeds_mm_s(layout: &Layout, row: usize, is_reversed: bool, changes: &mut Changes) -> [i32; 2] {
    let stated = layout.paths.value(row, "maxSpeed");
    let forward = speed_mm_s(stated);
    changes.without_speed += usize::from(forward.is_none());
    changes.speeds += usize::from(is_rounded(stated, forward));
    let forward = forward.unwrap_or(DEFAULT_SPEED_MM_S);
    match (is_reversed, is_two_way(layout, row)) {
        (true, _) => [0, forward],
        (_, false) => [forward, 0],
        (_, true) => {
            let stated = layout.paths.value(row, "maxReverseSpeed");
            let reverse = speed_mm_s(stated).filter(|&reverse| reverse > 0);
            changes.reverse_speeds += usize::from(is_rounded(stated, reverse));
            // Speed 0 closes a direction.
            match (forward, reverse) {
                (0, None) => changes.closed += 1,
                (0, Some(_)) => changes.half_closed += 1,
                _ => {}
            }
            [forward, reverse.unwrap_or(forward)]
        }
    }
}

fn is_rounded(stated: Option<Value<'_>>, mm_s: Option<i32>) -> bool {
    match (number(stated), mm_s) {
        (Some(stated), Some(mm_s)) => {
            let mm_s = f64::from(mm_s);
            (stated * 1e3 - mm_s).abs() > SAME_NUMBER * mm_s
        }
        _ => false,
    }
}
