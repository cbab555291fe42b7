//! GeoJSON writer: writes a layout as features with properties, and the rest of it as a member of
//! the collection.

use std::io::{self, Write};

use guideway_layout::{Direction, Layout, PathRef, TypeEntries, WrittenCurve};
use guideway_spline::Point;

use super::json_writer::JsonWriter;
use super::lines::{is_of_lines, lines};
use super::names::{self, is_reserved};
use super::references::References;
use super::write_losses::list_losses;
use super::write_member::write_member;
use crate::Losses;
use crate::finite::check_finite;
use crate::source::WrittenPaths;
use crate::wgs84::LocalProjection;

/// Options of [`write_layout`].
#[derive(Clone, Debug)]
pub struct WriteOptions {
    /// Largest distance of a written line from its curve, in meters.
    pub tolerance_m: f64,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self { tolerance_m: 1e-3 }
    }
}

/// Writes a whole layout as GeoJSON: nodes and stations as points, paths as lines, zones as
/// polygons, columns as properties. Returns the losses.
///
/// Positions are longitude and latitude if the layout has a place on earth, as RFC 7946 requires,
/// and else meters; both with a resolution of one micrometer. Properties with the prefix
/// `guideway:` and the member `guideway` of the collection hold the parts that GeoJSON has no word
/// for, among them the exact curve of a path, so that the file reads back as the same layout.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    write_watched(layout, out, options, &WrittenPaths::unwatched())
}

/// Writes as [`write_layout`] does, and counts the paths.
pub(crate) fn write_watched(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
    written_paths: &WrittenPaths<'_>,
) -> io::Result<Losses> {
    check_finite(layout)?;
    let references = References::new(layout);
    let degrees = degrees(layout);
    let mut json = JsonWriter::new(out, degrees);
    json.begin('{')?;
    json.field("type", "FeatureCollection")?;
    json.key("guideway")?;
    write_member(&mut json, layout, &references, degrees.is_some())?;
    if degrees.is_none() {
        // The projected system that Nav2 and its graph editors in QGIS write: a plane in meters.
        let crs = r#"{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3857"}}"#;
        json.key("crs")?;
        json.value(guideway_layout::Value::Json(crs))?;
    }
    json.key("features")?;
    json.begin('[')?;
    let mut features = Features {
        json,
        layout,
        references,
        tolerance_m: options.tolerance_m,
    };
    (0..layout.nodes.len() as u32).try_for_each(|node| features.node(node))?;
    for path in layout.paths.iter().filter(|path| path.runs().len() > 0) {
        written_paths.count();
        features.path(path)?;
    }
    (0..layout.stations.len() as u32).try_for_each(|station| features.station(station))?;
    features.zones()?;
    let mut json = features.json;
    json.end(']')?;
    json.end('}')?;
    out.write_all(b"\n")?;
    Ok(list_losses(layout))
}

/// Returns the projection to degrees, if the layout has a place on earth and lies on it.
fn degrees(layout: &Layout) -> Option<LocalProjection> {
    let projection = LocalProjection::about(layout.geo_origin?);
    let nodes = (0..layout.nodes.len() as u32).map(|node| layout.nodes.position_m(node));
    let stations = (0..layout.stations.len() as u32).filter_map(|s| layout.stations.position_m(s));
    let zones = layout
        .zones
        .iter()
        .flat_map(|zone| zone.outline_m.iter().copied());
    let bounds = layout.paths.hull_bounds();
    let corners = bounds
        .into_iter()
        .flat_map(|bounds| [bounds.min, bounds.max]);
    let mut all = nodes.chain(stations).chain(zones).chain(corners);
    let is_on_earth = |point: Point<f64>| {
        let degrees = projection.to_degrees(point);
        degrees.x.abs() <= 360.0 && degrees.y.abs() <= 90.0
    };
    all.all(is_on_earth).then_some(projection)
}

/// Writer of the features of a layout.
struct Features<'w, 'l, W> {
    json: JsonWriter<'w, W>,
    layout: &'l Layout,
    references: References,
    tolerance_m: f64,
}

impl<W: Write> Features<'_, '_, W> {
    fn begin(&mut self, id: &str, element: &str, level: Option<u32>) -> io::Result<()> {
        let json = &mut self.json;
        json.begin_line()?;
        json.field("type", "Feature")?;
        json.field("id", id)?;
        json.key("properties")?;
        json.begin('{')?;
        json.field(names::ELEMENT, element)?;
        match level {
            Some(level) => {
                json.key(names::LEVEL)?;
                self.references.write_level(json, self.layout, level)
            }
            None => Ok(()),
        }
    }

    fn node(&mut self, node: u32) -> io::Result<()> {
        let nodes = &self.layout.nodes;
        self.begin(nodes.id(node), "node", nodes.level(node))?;
        self.types(nodes.vehicle_types(), node as usize)?;
        self.json
            .row(&nodes.attributes, node as usize, is_reserved)?;
        self.json.end('}')?;
        self.json.point(nodes.position_m(node))
    }

    fn path(&mut self, path: PathRef<'_>) -> io::Result<()> {
        let paths = &self.layout.paths;
        let row = path.row();
        self.begin(path.id(), "path", path.level())?;
        for (name, node) in [
            (names::START, path.start_node()),
            (names::END, path.end_node()),
        ] {
            if let Some(node) = node {
                self.json.key(name)?;
                self.references
                    .write_node(&mut self.json, self.layout, node)?;
            }
        }
        if path.direction() == Direction::Both {
            self.json.field(names::DIRECTION, "both")?;
        }
        self.types(paths.vehicle_types(), row)?;
        self.json.row(&paths.attributes, row, is_reserved)?;
        self.style(row)?;
        let written = paths.written_curve(row);
        if written.is_some() || !is_of_lines(path) {
            self.curve(path)?;
        }
        if let Some(written) = written {
            self.nurbs(written)?;
        }
        self.json.end('}')?;
        self.json.lines(&lines(path, self.tolerance_m))
    }

    fn style(&mut self, row: usize) -> io::Result<()> {
        let paths = &self.layout.paths;
        let style = paths.own_style(row);
        if let Some(width_m) = style.width_m {
            self.json.field(names::WIDTH, &width_m)?;
        }
        if let Some(color) = style.color_rgba {
            self.json.field(names::COLOR, &format!("#{color:08x}"))?;
        }
        match paths.rank().map(|ranks| ranks[row]) {
            Some(rank) if rank != 0 => self.json.field(names::RANK, &rank),
            _ => Ok(()),
        }
    }

    /// Writes the control points of a path, in meters and to the last bit.
    fn curve(&mut self, path: PathRef<'_>) -> io::Result<()> {
        let json = &mut self.json;
        json.key(names::CURVE)?;
        json.begin('[')?;
        for run in path.runs() {
            json.begin('[')?;
            run.iter()
                .try_for_each(|point| json.any(&[point.x, point.y]))?;
            json.end(']')?;
        }
        json.end(']')
    }

    fn nurbs(&mut self, curve: &WrittenCurve) -> io::Result<()> {
        let json = &mut self.json;
        json.key(names::NURBS)?;
        json.begin('{')?;
        json.field("degree", &curve.degree)?;
        json.field("knots", &curve.knots)?;
        let points: Vec<_> = curve.points_m.iter().map(|p| [p.x, p.y]).collect();
        json.field("points", &points)?;
        if let Some(weights) = &curve.weights {
            json.field("weights", weights)?;
        }
        json.end('}')
    }

    /// Writes the vehicle types of an element, and their properties in the same order.
    fn types(&mut self, types: &TypeEntries, element: usize) -> io::Result<()> {
        let entries = types.entries(element);
        if entries.is_empty() {
            return Ok(());
        }
        let json = &mut self.json;
        let names: Vec<&str> = types.of(element).collect();
        json.field(names::VEHICLE_TYPES, &names)?;
        let has_value = |entry: usize| {
            let mut columns = types.attributes.iter();
            columns.any(|column| column.values.get(entry).is_some())
        };
        if !entries.clone().any(has_value) {
            return Ok(());
        }
        json.key(names::TYPE_PROPERTIES)?;
        json.begin('[')?;
        for entry in entries {
            json.begin('{')?;
            json.row(&types.attributes, entry, |_| false)?;
            json.end('}')?;
        }
        json.end(']')
    }

    fn station(&mut self, station: u32) -> io::Result<()> {
        let stations = &self.layout.stations;
        self.begin(stations.id(station), "station", stations.level(station))?;
        let nodes = stations.nodes(station);
        if !nodes.is_empty() {
            self.json.key(names::NODES)?;
            self.json.begin('[')?;
            for &node in nodes {
                self.references
                    .write_node(&mut self.json, self.layout, node)?;
            }
            self.json.end(']')?;
        }
        self.json
            .row(&stations.attributes, station as usize, is_reserved)?;
        self.json.end('}')?;
        match stations.position_m(station) {
            Some(position_m) => self.json.point(position_m),
            None => self.without_geometry(),
        }
    }

    fn zones(&mut self) -> io::Result<()> {
        for zone in &self.layout.zones {
            self.begin(&zone.id, "zone", zone.level)?;
            self.json.row(&zone.attributes, 0, is_reserved)?;
            self.json.end('}')?;
            let Some(&first) = zone.outline_m.first() else {
                self.without_geometry()?;
                continue;
            };
            // A ring ends where it begins.
            let ring: Vec<_> = zone.outline_m.iter().copied().chain([first]).collect();
            self.json.geometry("Polygon", |json| {
                json.begin('[')?;
                json.line(&ring)?;
                json.end(']')
            })?;
        }
        Ok(())
    }

    fn without_geometry(&mut self) -> io::Result<()> {
        self.json.field("geometry", &())?;
        self.json.end('}')
    }
}
