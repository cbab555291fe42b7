//! The site as a LIF file, and many copies of it side by side.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::hall::{hall, mezzanine};
use super::level::{BOTH, Level};
use super::trajectory::Xy;

/// The example site as a LIF file.
pub(crate) fn site() -> String {
    file(&layouts())
}

/// Copies of the site in columns and rows, with distinct names.
pub(crate) fn campus(columns: u32, rows: u32) -> String {
    /// Distance between copies, in meters.
    const STEP: Xy = (150.0, 95.0);
    let hall = layouts();
    let mut all = hall.clone();
    for (layout, hall) in all.iter_mut().zip(&hall) {
        for list in ["nodes", "edges", "stations"] {
            let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
            let placed = places.flat_map(|(column, row)| {
                let by = (STEP.0 * f64::from(column), STEP.1 * f64::from(row));
                let items = hall[list].as_array().into_iter().flatten();
                items.map(move |item| placed(item, &format!("{column}.{row} "), by))
            });
            layout[list] = placed.collect();
        }
    }
    file(&all)
}

/// Moves all coordinates of a value and prefixes its names.
fn placed(value: &Value, prefix: &str, by: Xy) -> Value {
    let named = |value: &Value| format!("{prefix}{}", value.as_str().unwrap_or_default()).into();
    match value {
        Value::Array(items) => items.iter().map(|item| placed(item, prefix, by)).collect(),
        Value::Object(members) => {
            let members = members.iter().map(|(name, value)| {
                let value = match (name.as_str(), value) {
                    ("x", Value::Number(x)) => json!(x.as_f64().unwrap_or_default() + by.0),
                    ("y", Value::Number(y)) => json!(y.as_f64().unwrap_or_default() + by.1),
                    ("interactionNodeIds", Value::Array(nodes)) => {
                        nodes.iter().map(named).collect()
                    }
                    (
                        "nodeId" | "startNodeId" | "endNodeId" | "edgeId" | "stationId"
                        | "stationName",
                        id,
                    ) => named(id),
                    (_, value) => placed(value, prefix, by),
                };
                (name.clone(), value)
            });
            Value::Object(members.collect())
        }
        other => other.clone(),
    }
}

fn layouts() -> [Value; 2] {
    [
        layout("hall", "Hall", &hall()),
        layout("mezzanine", "Mezzanine", &mezzanine()),
    ]
}

fn file(layouts: &[Value]) -> String {
    let file = json!({
        "metaInformation": {
            "projectIdentification": "Guideway example site",
            "creator": "Guideway",
            "exportTimestamp": "2025-06-01T08:00:00Z",
            "lifVersion": "1.0.0",
        },
        "layouts": layouts,
    });
    lines(&file) + "\n"
}

fn layout(id: &str, name: &str, level: &Level) -> Value {
    let nodes = level.nodes.iter().map(|(node, (x, y))| {
        let types = BOTH.iter().map(|t| json!({ "vehicleTypeId": t }));
        json!({
            "nodeId": node,
            "mapId": id,
            "nodePosition": { "x": x, "y": y },
            "vehicleTypeNodeProperties": types.collect::<Vec<_>>(),
        })
    });
    json!({
        "layoutId": id,
        "layoutName": name,
        "layoutVersion": "1",
        "layoutLevelId": id,
        "nodes": nodes.collect::<Vec<_>>(),
        "edges": level.edges,
        "stations": level.stations,
    })
}

/// JSON with one line per node, edge and station, so that files are readable and comparable.
fn lines(file: &Value) -> String {
    let mut text = format!(
        "{{\n\"metaInformation\": {},\n\"layouts\": [",
        file["metaInformation"]
    );
    for (i, layout) in file["layouts"].as_array().into_iter().flatten().enumerate() {
        text += if i == 0 { "\n{" } else { ",\n{" };
        for (j, (key, value)) in layout.as_object().into_iter().flatten().enumerate() {
            let comma = if j == 0 { "" } else { "," };
            // Writing to a string cannot fail.
            let _ = write!(text, "{comma}\n\"{key}\": ");
            match value.as_array() {
                None => text += &value.to_string(),
                Some(rows) => {
                    let rows: Vec<String> = rows.iter().map(Value::to_string).collect();
                    text += &format!("[\n{}\n]", rows.join(",\n"));
                }
            }
        }
        text += "\n}";
    }
    text + "\n]\n}"
}
