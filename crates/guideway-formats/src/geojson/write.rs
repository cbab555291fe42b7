//! GeoJSON writer: writes nodes as points and paths as lines, with columns as properties.

use std::collections::HashSet;
use std::io::{self, Write};

use guideway_layout::{Layout, PathRef, RunPoints};
use guideway_spline::{Point, flatten_run};

use super::write_feature::{FeatureWriter, RESERVED};
use crate::Losses;
use crate::clamped::POSITION_STEP_M;
use crate::common_losses::common_losses;

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

/// Writes a layout as GeoJSON: nodes as points, paths as lines, columns as properties. Returns the
/// losses.
///
/// Positions are in meters, with a resolution of one micrometer. Paths with nodes make the file a
/// route graph of Nav2.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    let mut losses = list_losses(layout);
    let mut curves = 0;
    // The projected system that Nav2 and its graph editors in QGIS write: a plane in meters.
    out.write_all(
        concat!(
            r#"{"type":"FeatureCollection","crs":{"type":"name","#,
            r#""properties":{"name":"urn:ogc:def:crs:EPSG::3857"}},"features":["#
        )
        .as_bytes(),
    )?;
    let mut feature = FeatureWriter::new(out);
    for node in 0..layout.nodes.len() as u32 {
        feature.begin(layout.nodes.id(node))?;
        feature.attributes(&layout.nodes.attributes, node as usize)?;
        feature.point(layout.nodes.position_m(node))?;
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
        feature.path_properties(layout, path)?;
        feature.attributes(&layout.paths.attributes, path.row())?;
        feature.lines(&lines(path, options.tolerance_m))?;
    }
    out.write_all(b"\n]}\n")?;
    let tolerance_m = options.tolerance_m;
    let detail = format!("curved paths: written as lines within {tolerance_m} m");
    losses.add("curves", curves, detail);
    Ok(losses)
}

/// Flattens a path to lines, one per connected part.
fn lines(path: PathRef<'_>, tolerance_m: f64) -> Vec<Vec<Point<f64>>> {
    let mut lines: Vec<Vec<Point<f64>>> = Vec::new();
    for run in path.runs() {
        let mut line = Vec::new();
        if is_line(run) {
            // The inner control points of a straight run are the ends of its segments.
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

/// Returns whether a run is a straight line of uniform speed: all second differences vanish.
fn is_line(run: RunPoints<'_>) -> bool {
    let second = |i: usize| run.get(i) + run.get(i + 2) - run.get(i + 1) * 2.0;
    (0..run.len() - 2).all(|i| second(i).norm() <= POSITION_STEP_M)
}

/// Lists the parts of a layout that GeoJSON does not hold.
fn list_losses(layout: &Layout) -> Losses {
    let mut losses = common_losses(layout);
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
    let detail = "nodes with a repeated name: paths will refer to the first";
    losses.add("nodes", repeated, detail);
    losses.add_stations(layout);
    let detail = "levels: written as a property of paths only";
    losses.add("levels", layout.levels.len(), detail);
    losses
}
