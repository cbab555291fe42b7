//! The paths of a route as GeoJSON: a line per path in driving order, with lengths and times.

use guideway::formats::geojson::{WriteOptions, write_layout};
use guideway::layout::{Layout, Nodes, Stations, UserError, Value};
use guideway::network::Route;

/// The route as a collection of lines: in degrees if the layout has a place on earth, else in
/// meters, as in every GeoJSON file of this program.
///
/// # Errors
/// When a number of the layout is not finite.
pub(super) fn bytes(layout: &Layout, route: &Route) -> Result<Vec<u8>, UserError> {
    let mut lines = route.layout(layout);
    let node = |row: u32| layout.nodes.id(row);
    for (order, row) in route.rows.iter().enumerate() {
        let paths = &mut lines.paths;
        for (name, value) in [
            ("order", Value::Int(order as i64 + 1)),
            ("from", Value::Text(node(row.from))),
            ("to", Value::Text(node(row.to))),
            ("backward", Value::Bool(row.is_backward)),
            ("length_m", Value::Float(row.length_m)),
            ("speed_m_s", Value::Float(row.speed_m_s)),
            ("turn_deg", Value::Float(row.turn_rad.to_degrees())),
            ("turn_s", Value::Float(row.turn_s)),
            ("drive_s", Value::Float(row.drive_s)),
            ("end_s", Value::Float(row.end_s)),
        ] {
            paths.attributes.set(order, name, value);
        }
        paths.set_nodes(order, None, None);
    }
    (lines.nodes, lines.stations) = (Nodes::default(), Stations::default());
    let mut bytes = Vec::new();
    write_layout(&lines, &mut bytes, &WriteOptions::default()).map_err(|error| {
        UserError::new(
            "save",
            format!("cannot write the route: {error}"),
            "Correct the layout: `guideway check` lists what is wrong",
        )
    })?;
    Ok(bytes)
}
