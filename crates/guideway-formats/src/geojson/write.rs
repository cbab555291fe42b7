use std::collections::HashSet;
use std::io::{self, Write};

use guideway_layout::{Attributes, Direction, Layout, PathRef, RunPoints, Value};
use guideway_spline::{Point, flatten_run};

use crate::Losses;
use crate::clamped::{POSITION_STEP_M, rounded};

/// The properties that mean something to a reader.
const RESERVED: [&str; 3] = ["id", "startid", "endid"];

/// How to write a layout.
#[derive(Clone, Debug)]
pub struct WriteOptions {
    /// Farthest that the lines written for a curve may be from it, in meters.
    pub tolerance_m: f64,
}

impl Default for WriteOptions {
    fn default() -> Self {
        Self { tolerance_m: 1e-3 }
    }
}

/// Writes a layout as GeoJSON: nodes as points, paths as lines, columns as properties; positions in meters,
/// to a micrometer. Where paths have nodes it is a route graph as Nav2 reads it. Returns what the format
/// cannot hold.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    let mut losses = losses_of(layout);
    let mut curves = 0;
    // What Nav2 and those who draw its graphs in QGIS write: a plane in meters.
    out.write_all(
        br#"{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3857"}},"features":["#,
    )?;
    let mut feature = Feature { out, first: true };
    for node in 0..layout.nodes.len() as u32 {
        feature.begin(layout.nodes.id(node))?;
        feature.attributes(&layout.nodes.attributes, node as usize)?;
        feature.points(layout.nodes.position_m(node))?;
    }
    for path in layout.paths.iter() {
        if path.runs().len() == 0 {
            continue;
        }
        curves += usize::from(!path.runs().all(is_line));
        feature.begin(path.id())?;
        for (name, node) in [("startid", path.start_node()), ("endid", path.end_node())] {
            if let Some(node) = node {
                feature.id(name, layout.nodes.id(node))?;
            }
        }
        feature.own_properties(layout, path)?;
        feature.attributes(&layout.paths.attributes, path.row())?;
        feature.lines(&lines(path, options.tolerance_m))?;
    }
    out.write_all(b"\n]}\n")?;
    let tolerance_m = options.tolerance_m;
    let detail = format!("paths that are curves: they become lines within {tolerance_m} m");
    losses.add("curves", curves, detail);
    Ok(losses)
}

/// Writes features one after the other.
struct Feature<'w, W> {
    out: &'w mut W,
    first: bool,
}

impl<W: Write> Feature<'_, W> {
    fn begin(&mut self, id: &str) -> io::Result<()> {
        let separator = if self.first { "\n" } else { ",\n" };
        self.first = false;
        write!(
            self.out,
            r#"{separator}{{"type":"Feature","properties":{{"id":"#
        )?;
        self.id_value(id)
    }

    fn property(&mut self, name: &str, value: Value<'_>) -> io::Result<()> {
        self.name(name)?;
        match value {
            Value::Bool(value) => write!(self.out, "{value}"),
            Value::Int(value) => write!(self.out, "{value}"),
            Value::Float(value) => self.json(&value),
            Value::Text(value) => self.json(value),
        }
    }

    fn id(&mut self, name: &str, id: &str) -> io::Result<()> {
        self.name(name)?;
        self.id_value(id)
    }

    /// Nav2 asks for whole numbers, so what can be one is one.
    fn id_value(&mut self, id: &str) -> io::Result<()> {
        match id.parse::<u32>() {
            Ok(number) if number.to_string() == id => write!(self.out, "{number}"),
            _ => self.json(id),
        }
    }

    fn name(&mut self, name: &str) -> io::Result<()> {
        write!(self.out, ",")?;
        self.json(name)?;
        write!(self.out, ":")
    }

    /// What a layout has beside columns, for those who read it; it comes back as columns.
    fn own_properties(&mut self, layout: &Layout, path: PathRef<'_>) -> io::Result<()> {
        let column = |name| layout.paths.attributes.get(name);
        let level = path.level().and_then(|l| layout.levels.get(l as usize));
        if let (Some(level), None) = (level, column("level")) {
            self.property("level", Value::Text(&level.id))?;
        }
        if path.direction() == Direction::Both && column("direction").is_none() {
            self.property("direction", Value::Text("both"))?;
        }
        let types: Vec<&str> = layout.paths.vehicle_types().of(path.row()).collect();
        if !types.is_empty() && column("vehicle_types").is_none() {
            self.property("vehicle_types", Value::Text(&types.join(", ")))?;
        }
        Ok(())
    }

    fn attributes(&mut self, attributes: &Attributes, row: usize) -> io::Result<()> {
        for attribute in attributes.iter() {
            let reserved = RESERVED.contains(&attribute.name.as_str());
            if let Some(value) = attribute.values.get(row).filter(|_| !reserved) {
                self.property(&attribute.name, value)?;
            }
        }
        Ok(())
    }

    fn points(&mut self, position: Point<f64>) -> io::Result<()> {
        write!(self.out, r#"}},"geometry":{{"type":"Point","coordinates":"#)?;
        self.position(position)?;
        write!(self.out, "}}}}")
    }

    fn lines(&mut self, lines: &[Vec<Point<f64>>]) -> io::Result<()> {
        let several = lines.len() != 1;
        let (kind, open, close) = match several {
            true => ("MultiLineString", "[", "]"),
            false => ("LineString", "", ""),
        };
        write!(
            self.out,
            r#"}},"geometry":{{"type":"{kind}","coordinates":{open}"#
        )?;
        for (i, line) in lines.iter().enumerate() {
            write!(self.out, "{}[", if i == 0 { "" } else { "," })?;
            for (j, &point) in line.iter().enumerate() {
                write!(self.out, "{}", if j == 0 { "" } else { "," })?;
                self.position(point)?;
            }
            write!(self.out, "]")?;
        }
        write!(self.out, "{close}}}}}")
    }

    fn position(&mut self, position: Point<f64>) -> io::Result<()> {
        let [x, y] = [position.x, position.y].map(rounded);
        write!(self.out, "[")?;
        self.json(&x)?;
        write!(self.out, ",")?;
        self.json(&y)?;
        write!(self.out, "]")
    }

    fn json<T: serde::Serialize + ?Sized>(&mut self, value: &T) -> io::Result<()> {
        serde_json::to_writer(&mut *self.out, value).map_err(io::Error::from)
    }
}

/// The lines of a path, a new one where it is broken.
fn lines(path: PathRef<'_>, tolerance_m: f64) -> Vec<Vec<Point<f64>>> {
    let mut lines: Vec<Vec<Point<f64>>> = Vec::new();
    for run in path.runs() {
        let mut line = Vec::new();
        if is_line(run) {
            // Its inner control points are the ends of its segments, and so the vertices that it came from.
            line.extend(run.iter().skip(1).take(run.len() - 2));
        } else {
            let points: Vec<_> = run.iter().collect();
            flatten_run(&points, tolerance_m, &mut |point| line.push(point));
        }
        let end = lines.last().and_then(|line| line.last());
        match end {
            Some(end) if end.distance(line[0]) <= POSITION_STEP_M => {
                let last = lines.len() - 1;
                lines[last].extend_from_slice(&line[1..]);
            }
            _ => lines.push(line),
        }
    }
    lines
}

/// Whether a run is one straight line, evenly passed.
fn is_line(run: RunPoints<'_>) -> bool {
    let second = |i: usize| run.get(i) + run.get(i + 2) - run.get(i + 1) * 2.0;
    (0..run.len() - 2).all(|i| second(i).norm() <= POSITION_STEP_M)
}

/// What GeoJSON has no place for.
fn losses_of(layout: &Layout) -> Losses {
    let mut losses = Losses::of(layout);
    losses.add_widths(layout);
    losses.add_colors(layout);
    losses.add_ranks(layout);
    let is_held = |name: &str| !RESERVED.contains(&name);
    losses.add_columns(&layout.paths.attributes, "paths", is_held);
    losses.add_columns(&layout.nodes.attributes, "nodes", is_held);
    let ids: HashSet<&str> = (0..layout.nodes.len() as u32)
        .map(|node| layout.nodes.id(node))
        .collect();
    let repeated = layout.nodes.len() - ids.len();
    let detail = "nodes with a name used before: paths will be joined to the first";
    losses.add("nodes", repeated, detail);
    losses.add_stations(layout);
    let detail = "levels: only their names are kept, of paths";
    losses.add("levels", layout.levels.len(), detail);
    losses
}
