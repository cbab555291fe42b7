//! Writes a layout as SVG: exact curves, in meters, on a page of the real size of the site.

use std::io::{self, Write};

use guideway_layout::{Direction, Layout, PathRef, Value};
use guideway_spline::{Bounds, Point};

use super::svg_writer::{PathData, Stroke, SvgWriter};
use crate::Losses;
use crate::clamped::POSITION_STEP_M;
use crate::finite::check_finite;
use crate::losses::common_losses;
use crate::source::WrittenPaths;
use crate::xml_text::is_xml_char;

/// Name of the attribute column that holds group names.
const GROUP_COLUMN: &str = "group";

/// Name of the attribute column that holds names of elements.
const ELEMENT_COLUMN: &str = "element";

/// Width of paths without a width, in meters.
const DEFAULT_WIDTH_M: f64 = 0.1;

/// Color of paths without a color: opaque black.
const DEFAULT_COLOR: u32 = 0x0000_00FF;

/// Page margin context all paths, as a fraction of the larger side of their bounds.
const MARGIN: f64 = 0.02;

/// Smallest page margin, in meters; gives an empty layout a page of 1 m.
const MIN_MARGIN_M: f64 = 0.5;

/// Writes a layout, and returns what SVG cannot hold of it.
///
/// One user unit is one meter and the page has the size of the site, so that lengths measured in a
/// drawing program are real ones. Each path becomes a `path` element with identifier, color and
/// width; levels, or values of the column `group`, become groups. Coordinates are rounded to a
/// micrometer.
///
/// # Errors
/// When writing to `out` fails.
pub fn write_layout(layout: &Layout, out: &mut impl Write) -> io::Result<Losses> {
    write_watched(layout, out, &WrittenPaths::unwatched())
}

/// Writes as [`write_layout`] does, and counts the paths.
pub(crate) fn write_watched(
    layout: &Layout,
    out: &mut impl Write,
    written_paths: &WrittenPaths<'_>,
) -> io::Result<Losses> {
    check_finite(layout)?;
    let Bounds { min, max } = page_bounds(layout);
    let size_mm = (max - min) * 1e3;
    let size_mm = Point::new(size_mm.x.round(), size_mm.y.round());
    let view = [min.x, -max.y, size_mm.x / 1e3, size_mm.y / 1e3];
    // A browser shows the page in its real size, so the style limits it to the window.
    let attributes = format!(
        r#"width="{}mm" height="{}mm" style="max-width:100%;max-height:100vh""#,
        size_mm.x, size_mm.y
    );
    let common = Stroke::new(DEFAULT_COLOR, DEFAULT_WIDTH_M);
    let mut svg = SvgWriter::begin(out, view, &attributes, &common)?;
    let column = layout.paths.attributes.get(GROUP_COLUMN);
    let mut current: Option<String> = None;
    let mut order: Vec<usize> = (0..layout.paths.len()).collect();
    if let Some(rank) = layout.paths.rank() {
        order.sort_by_key(|&path| rank[path]);
    }
    for path in order.into_iter().map(|row| layout.paths.get(row)) {
        written_paths.count();
        let own = column.and_then(|c| c.values.get(path.row()));
        let level = || Some(layout.levels.get(path.level()? as usize)?.id.clone());
        let group = own.map(|value: Value<'_>| value.to_string()).or_else(level);
        if group != current {
            if current.is_some() {
                svg.end_group()?;
            }
            if let Some(group) = &group {
                svg.begin_group(group)?;
            }
            current = group;
        }
        let mut data = PathData::new(POSITION_STEP_M);
        for segment in path.runs().flat_map(|run| run.segments()) {
            // The y axis of SVG points down.
            data.push_segment(&segment.map(|p| Point::new(p.x, -p.y)));
        }
        svg.path(path.id(), &data, &stroke(layout, path))?;
    }
    if current.is_some() {
        svg.end_group()?;
    }
    svg.finish()?;
    Ok(losses(layout))
}

fn stroke(layout: &Layout, path: PathRef<'_>) -> Stroke {
    let own = layout.paths.own_style(path.row());
    // SVG programs do not draw a stroke of width 0; Guideway does.
    let width_m = own.width_m.map(f64::from).filter(|&w| w > 0.0);
    let width_m = width_m.unwrap_or(DEFAULT_WIDTH_M);
    Stroke::new(own.color_rgba.unwrap_or(DEFAULT_COLOR), width_m)
}

fn losses(layout: &Layout) -> Losses {
    let mut losses = common_losses(layout);
    let ranks = layout.paths.rank().unwrap_or_default();
    let ranks = ranks.iter().filter(|&&rank| rank != 0).count();
    let detail = "draw ranks: written as the order of paths";
    losses.add("draw ranks", ranks, detail);
    let curves = layout.paths.written_curves().len();
    let detail = "curves: drawn as they are, without the numbers of their files";
    losses.add("curves", curves, detail);
    let widths = layout.paths.width_m().unwrap_or_default();
    let zero = widths.iter().filter(|&&width| width == 0.0).count();
    let detail = "paths of width 0: written with the default width";
    losses.add("widths", zero, detail);
    losses.add_network_and_groups(layout, Direction::Both);
    losses.add_columns(&layout.paths.attributes, "paths", |name| {
        [GROUP_COLUMN, ELEMENT_COLUMN].contains(&name)
    });
    losses.add_replaced(layout, ELEMENT_COLUMN, |_| Some("path"));
    losses.add_replaced(layout, GROUP_COLUMN, |row| {
        match layout.paths.attributes.value(row, GROUP_COLUMN)? {
            Value::Text(group) => Some(group),
            _ => None,
        }
    });
    let is_valid = |id: &str| !id.is_empty() && id.chars().all(is_xml_char);
    let invalid = layout.paths.iter().filter(|p| !is_valid(p.id()));
    let detail =
        "paths whose identifiers are empty or contain characters that XML forbids: renamed";
    let invalid = invalid.count();
    // Without any identifier, paths are told apart by their order.
    let what = match invalid == layout.paths.len() {
        true => "identifiers",
        false => "paths",
    };
    losses.add(what, invalid, detail);
    losses
}

/// The bounds of the page: all paths and a margin, rounded outwards to a millimeter.
fn page_bounds(layout: &Layout) -> Bounds<f64> {
    let segments = layout.paths.iter().flat_map(PathRef::runs);
    let segments = segments.flat_map(|run| run.segments());
    let bounds = segments
        .map(|s| Bounds::of_segment(&s))
        .reduce(Bounds::union);
    let origin = Point::default();
    let bounds = bounds.unwrap_or(Bounds {
        min: origin,
        max: origin,
    });
    let size = bounds.size();
    let margin_m = (MARGIN * size.x.max(size.y)).max(MIN_MARGIN_M);
    let Bounds { min, max } = bounds.inflated(margin_m);
    let down = |v: f64| (v * 1e3).floor() / 1e3;
    let up = |v: f64| (v * 1e3).ceil() / 1e3;
    Bounds {
        min: Point::new(down(min.x), down(min.y)),
        max: Point::new(up(max.x), up(max.y)),
    }
}
