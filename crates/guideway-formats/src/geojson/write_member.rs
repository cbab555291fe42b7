//! GeoJSON member `guideway`: writes the parts of a layout that are no features.

use std::collections::HashSet;
use std::io::{self, Write};

use guideway_layout::{Attribute, Attributes, Layout};

use super::declared::{Owner, kind_name};
use super::json_writer::JsonWriter;
use super::names;
use super::references::References;

/// Writes the member: unit and place on earth, types and units of columns, properties of the
/// layout, levels, vehicle types and blocks.
pub(super) fn write_member<W: Write>(
    json: &mut JsonWriter<'_, W>,
    layout: &Layout,
    references: &References,
    is_degrees: bool,
) -> io::Result<()> {
    json.begin('{')?;
    json.field("version", &names::VERSION)?;
    json.field("unit", if is_degrees { "deg" } else { "m" })?;
    if let Some(origin) = layout.geo_origin {
        json.key("origin")?;
        json.begin('{')?;
        json.field("longitude", &origin.longitude_deg)?;
        json.field("latitude", &origin.latitude_deg)?;
        json.end('}')?;
    }
    json.key("columns")?;
    json.begin('{')?;
    for (owner, key) in Owner::ALL {
        write_columns(json, key, &tables(layout, owner))?;
    }
    json.end('}')?;
    write_properties(json, &layout.attributes)?;
    write_list(json, "levels", &layout.levels, |json, level| {
        json.field("id", &level.id)?;
        if let Some(name) = &level.name {
            json.field("name", name)?;
        }
        if let Some(elevation_m) = level.elevation_m {
            json.field("elevation", &elevation_m)?;
        }
        write_properties(json, &level.attributes)
    })?;
    write_list(json, "vehicleTypes", &layout.vehicle_types, |json, each| {
        json.field("id", &each.id)?;
        write_properties(json, &each.attributes)
    })?;
    write_list(json, "blocks", &layout.blocks, |json, block| {
        json.field("id", &block.id)?;
        json.key("members")?;
        json.begin('[')?;
        for &member in &block.members {
            references.write_member(json, layout, member)?;
        }
        json.end(']')?;
        write_properties(json, &block.attributes)
    })?;
    json.end('}')
}

/// Returns the attributes that share the columns of a table.
fn tables(layout: &Layout, owner: Owner) -> Vec<&Attributes> {
    match owner {
        Owner::Paths => vec![&layout.paths.attributes],
        Owner::PathTypes => vec![&layout.paths.vehicle_types().attributes],
        Owner::Nodes => vec![&layout.nodes.attributes],
        Owner::NodeTypes => vec![&layout.nodes.vehicle_types().attributes],
        Owner::Stations => vec![&layout.stations.attributes],
        Owner::Levels => layout.levels.iter().map(|l| &l.attributes).collect(),
        Owner::VehicleTypes => layout.vehicle_types.iter().map(|t| &t.attributes).collect(),
        Owner::Blocks => layout.blocks.iter().map(|b| &b.attributes).collect(),
        Owner::Zones => layout.zones.iter().map(|z| &z.attributes).collect(),
        Owner::Layout => vec![&layout.attributes],
    }
}

/// Writes type and unit of each column, under the key of its table.
fn write_columns<W: Write>(
    json: &mut JsonWriter<'_, W>,
    key: &str,
    tables: &[&Attributes],
) -> io::Result<()> {
    let mut seen = HashSet::new();
    let columns = tables.iter().flat_map(|attributes| attributes.iter());
    let columns: Vec<&Attribute> = columns.filter(|c| seen.insert(c.name.as_str())).collect();
    if columns.is_empty() {
        return Ok(());
    }
    json.key(key)?;
    json.begin('{')?;
    for column in columns {
        json.key(&column.name)?;
        json.begin('{')?;
        json.field("type", kind_name(column))?;
        if let Some(quantity) = column.quantity {
            json.field("unit", quantity.unit())?;
        }
        json.end('}')?;
    }
    json.end('}')
}

/// Writes the only row of a table, if it has values.
fn write_properties<W: Write>(
    json: &mut JsonWriter<'_, W>,
    attributes: &Attributes,
) -> io::Result<()> {
    if attributes.is_empty() {
        return Ok(());
    }
    json.key("properties")?;
    json.begin('{')?;
    json.row(attributes, 0, |_| false)?;
    json.end('}')
}

fn write_list<W: Write, T>(
    json: &mut JsonWriter<'_, W>,
    key: &str,
    items: &[T],
    mut write: impl FnMut(&mut JsonWriter<'_, W>, &T) -> io::Result<()>,
) -> io::Result<()> {
    if items.is_empty() {
        return Ok(());
    }
    json.key(key)?;
    json.begin('[')?;
    for item in items {
        json.begin('{')?;
        write(json, item)?;
        json.end('}')?;
    }
    json.end(']')
}
