//! Writes a layout as a plant model of openTCS 6.0.0 or 7.0.0.

use std::io::{self, Write};

use guideway_layout::{Attributes, Layout, Member, Value};

use super::context::Context;
use super::drawn_paths::DrawnPaths;
use super::elements::{
    BLOCK_TYPES, Kind, LAYER, LAYER_GROUP, LOCATION_TYPE, VEHICLE, VISUAL_LAYOUT,
};
use super::group_mapper::{LOCATION_TYPES, VEHICLES};
use super::held::{held_by_block, held_by_layout, held_by_node, held_by_path, held_by_station};
use super::layers::Layers;
use super::plant::{Plant, objects};
use super::version::Version;
use super::visual_layout::{DEFAULT_LAYER, default_group};
use super::write_elements::{PropertyColumns, write_children, write_fields, write_object};
use super::write_paths::write_paths;
use super::write_places::{write_locations, write_points};
use super::xml_writer::XmlWriter;
use crate::Losses;
use crate::finite::check_finite;
use crate::source::WrittenPaths;

/// Writes a layout, and returns what a plant model cannot hold of it or holds in another form.
///
/// Nodes become points, paths become paths between points, stations become locations with a
/// location type per kind, blocks become blocks. Positions are rounded to millimeters, control
/// points to units of the drawing. Columns that openTCS has no member for become properties
/// `guideway:NAME`, which the reader turns back into columns.
///
/// # Errors
/// When writing to `out` fails.
pub fn write_layout(layout: &Layout, out: &mut impl Write, version: Version) -> io::Result<Losses> {
    write_watched(layout, out, version, &WrittenPaths::unwatched())
}

/// Writes as [`write_layout`] does, and counts the paths.
pub(crate) fn write_watched(
    layout: &Layout,
    out: &mut impl Write,
    version: Version,
    written_paths: &WrittenPaths<'_>,
) -> io::Result<Losses> {
    check_finite(layout)?;
    let mut losses = Losses::of_paths(layout, layout.refused.len());
    add_general_losses(layout, &mut losses);
    let plant = Plant::complete(layout, &mut losses);
    let drawn = DrawnPaths::draw(layout, &plant, &mut losses);
    let mut context = Context {
        layout,
        version,
        plant: &plant,
        drawn: &drawn,
        properties: PropertyColumns::default(),
    };
    add_columns(&mut context, &mut losses);
    let mut layers = Layers::of_layout(layout);
    let mut xml = XmlWriter::begin_file(out)?;
    xml.begin("model")?;
    xml.attribute("version", version.number())?;
    xml.attribute("name", model_name(layout, &mut losses))?;
    write_points(&context, &mut layers, &mut xml, &mut losses)?;
    let count = || written_paths.count();
    write_paths(&context, &mut layers, &mut xml, &mut losses, count)?;
    let mut lost = 0;
    for vehicle in &plant.vehicles {
        lost += write_object(&mut xml, &VEHICLE, vehicle)?;
    }
    losses.add("layout properties", lost, format!("values of `{VEHICLES}`"));
    let mut lost = 0;
    for kind in &plant.types {
        lost += write_object(&mut xml, &LOCATION_TYPE, kind)?;
    }
    losses.add(
        "layout properties",
        lost,
        format!("values of `{LOCATION_TYPES}`"),
    );
    write_locations(&context, &mut layers, &mut xml, &mut losses)?;
    write_blocks(&context, &mut xml, &mut losses)?;
    write_drawing(&context, &mut layers, &mut xml, &mut losses)?;
    let attributes = &layout.attributes;
    context
        .properties
        .write(&mut xml, attributes, 0, held_by_layout)?;
    xml.end()?;
    let replaced = xml.finish()?;
    let detail = "texts with characters that XML forbids: replaced by `_`";
    losses.add("texts", replaced, detail);
    Ok(losses)
}

/// Lists what a plant model has no place for.
fn add_general_losses(layout: &Layout, losses: &mut Losses) {
    losses.add_widths(layout);
    losses.add_colors(layout);
    losses.add_ranks(layout);
    losses.add("levels", layout.levels.len(), "levels: written as layers");
    let (paths, nodes, stations) = (&layout.paths, &layout.nodes, &layout.stations);
    let on_level = |attributes: &Attributes, row: usize, level: Option<u32>| {
        attributes.value(row, "layer").is_none() && is_layer(layout, level)
    };
    let path_rows =
        (0..paths.len()).filter(|&row| on_level(&paths.attributes, row, paths.get(row).level()));
    let node_rows =
        (0..nodes.len()).filter(|&row| on_level(&nodes.attributes, row, nodes.level(row as u32)));
    let station_rows = (0..stations.len())
        .filter(|&row| on_level(&stations.attributes, row, stations.level(row as u32)));
    let count = path_rows.count() + node_rows.count() + station_rows.count();
    let detail = "paths, nodes and stations on a level: written on the layer of its name";
    losses.add("column layer", count, detail);
    losses.add("zones", layout.zones.len(), "zones");
    let origin = usize::from(layout.geo_origin.is_some());
    losses.add("geo origin", origin, "place on earth of the origin");
    let written = layout.paths.written_curves().len();
    losses.add(
        "curves",
        written,
        "curves as written in the file, such as NURBS with weights",
    );
    let types = layout.paths.vehicle_types();
    let limited = (0..layout.paths.len()).filter(|&row| types.of(row).len() > 0);
    let detail = "paths for certain vehicle types: open to all";
    losses.add("vehicle types", limited.count(), detail);
    losses.add_columns(&types.attributes, "paths per vehicle type", |_| false);
    let types = layout.nodes.vehicle_types();
    let limited = (0..layout.nodes.len()).filter(|&row| types.of(row).len() > 0);
    let detail = "nodes with properties of certain vehicle types";
    losses.add("vehicle types", limited.count(), detail);
    losses.add_columns(&types.attributes, "nodes per vehicle type", |_| false);
    let detail = "vehicle types with their properties";
    losses.add("vehicle types", layout.vehicle_types.len(), detail);
}

/// Tells if the name of a level is that of a layer other than the default one.
fn is_layer(layout: &Layout, level: Option<u32>) -> bool {
    let level = level.and_then(|level| layout.levels.get(level as usize));
    level.is_some_and(|level| level.name_or_id() != DEFAULT_LAYER)
}

/// Adds the columns of all tables that become properties.
fn add_columns(context: &mut Context<'_>, losses: &mut Losses) {
    let (layout, version, drawn) = (context.layout, context.version, context.drawn);
    let columns = &mut context.properties;
    let by_path = |row, name: &str, value: Value<'_>| held_by_path(layout, drawn, row, name, value);
    columns.add(&layout.paths.attributes, "paths", losses, by_path);
    let by_node = |_, name: &str, value: Value<'_>| held_by_node(version, name, value);
    columns.add(&layout.nodes.attributes, "nodes", losses, by_node);
    let by_station = |_, name: &str, value: Value<'_>| held_by_station(version, name, value);
    columns.add(&layout.stations.attributes, "stations", losses, by_station);
    for block in &layout.blocks {
        columns.add(&block.attributes, "blocks", losses, held_by_block);
    }
    columns.add(&layout.attributes, "the layout", losses, held_by_layout);
}

/// The name of the model: that of the layout, else that of its file.
fn model_name(layout: &Layout, losses: &mut Losses) -> String {
    if let Some(Value::Text(name)) = layout.attributes.value(0, "name") {
        return name.to_owned();
    }
    let source = &layout.provenance.source;
    let file = source.rsplit(['/', '\\']).next().unwrap_or(source);
    let name = file.split('.').find(|part| !part.is_empty());
    let name = name.unwrap_or("layout").to_owned();
    let detail = format!("layout without a name: written as the model `{name}`");
    losses.add("layout properties", 1, detail);
    name
}

fn write_blocks<W: Write>(
    context: &Context<'_>,
    xml: &mut XmlWriter<'_, W>,
    losses: &mut Losses,
) -> io::Result<()> {
    let (plant, mut without_type, mut not_written) = (context.plant, 0, 0);
    for (block, name) in context.layout.blocks.iter().zip(&plant.block_names) {
        let text = |name: &str, kind: Kind| match block.attributes.value(0, name) {
            Some(Value::Text(text)) => kind.text(&text.into()),
            _ => None,
        };
        let kind = text("type", Kind::Choice(BLOCK_TYPES));
        without_type += usize::from(block.attributes.value(0, "type").is_none());
        xml.begin("block")?;
        xml.attribute("name", name)?;
        xml.attribute("type", kind.as_deref().unwrap_or(BLOCK_TYPES[0]))?;
        for member in &block.members {
            let name = match *member {
                Member::Path(row) if plant.ends[row as usize].is_none() => {
                    not_written += 1;
                    continue;
                }
                Member::Path(row) => &plant.path_names[row as usize],
                Member::Node(row) => &plant.points[row as usize].name,
                Member::Station(row) => &plant.station_names[row as usize],
            };
            xml.element("member", &[("name", name)])?;
        }
        context
            .properties
            .write(xml, &block.attributes, 0, held_by_block)?;
        if let Some(color) = text("color", Kind::Color) {
            xml.element("blockLayout", &[("color", &color)])?;
        }
        xml.end()?;
    }
    let detail = format!("blocks without a type: written as `{}`", BLOCK_TYPES[0]);
    losses.add("column type", without_type, detail);
    losses.add(
        "blocks",
        not_written,
        "members of blocks: paths without a curve",
    );
    Ok(())
}

fn write_drawing<W: Write>(
    context: &Context<'_>,
    layers: &mut Layers,
    xml: &mut XmlWriter<'_, W>,
    losses: &mut Losses,
) -> io::Result<()> {
    let layout = context.layout;
    let mut drawing = context.drawn.drawing(layout);
    let scale = context.drawn.scale_mm;
    drawing.insert("scaleX".into(), scale.x.into());
    drawing.insert("scaleY".into(), scale.y.into());
    xml.begin(VISUAL_LAYOUT.tag)?;
    write_fields(xml, &VISUAL_LAYOUT, &drawing)?;
    let mut lost = 0;
    for layer in layers.objects() {
        lost += write_object(xml, &LAYER, layer)?;
    }
    let mut groups = objects(layout, "layerGroups");
    if groups.is_empty() {
        groups.extend(default_group().as_object().cloned());
    }
    for group in &groups {
        lost += write_object(xml, &LAYER_GROUP, group)?;
    }
    lost += write_children(xml, &VISUAL_LAYOUT, &drawing)?;
    xml.end()?;
    losses.add(
        "layout properties",
        lost,
        "values of layers and their groups",
    );
    losses.add("layout properties", layers.new_layers(), "new layers");
    Ok(())
}
