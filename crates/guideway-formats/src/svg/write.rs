//! Drawings as SVG: true curves, in meters over a page of their real size.

use std::fmt::Write as _;
use std::io::{self, Write};

use guideway_layout::{Layout, PathRef, Value};
use guideway_spline::{Bounds, Point};

use super::write_page::{PathData, Stroke, SvgWriter};
use crate::Losses;
use crate::clamped::POSITION_STEP_M;
use crate::common_losses::common_losses;

/// Name of the column that holds the groups of a drawing.
const GROUP: &str = "group";

/// Width of paths that have none of their own, in meters.
const WIDTH_M: f64 = 0.1;

/// What is left free around all paths, as a share of their extent, and at least, in meters.
const MARGIN: f64 = 0.02;
const LEAST_MARGIN_M: f64 = 0.5;

/// Writes a layout: a user unit is a meter, and the page is as large as the site, so that whoever measures in
/// the drawing measures meters. A path is a `path` with its identifier, its color and its width; levels, or the
/// column `group`, are groups. Positions are to a micrometer. Returns what the format cannot hold.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(layout: &Layout, out: &mut impl Write) -> io::Result<Losses> {
    let (min, max) = corners(layout);
    let size_mm = (max - min) * 1e3;
    let size_mm = Point::new(size_mm.x.round(), size_mm.y.round());
    let view = [min.x, -max.y, size_mm.x / 1e3, size_mm.y / 1e3];
    // Browsers take the size of the page for that on the screen: within that, it is as large as can be.
    let page = format!(
        r#"width="{}mm" height="{}mm" style="max-width:100%;max-height:100vh""#,
        size_mm.x, size_mm.y
    );
    let black = Stroke::new(0x0000_00FF, WIDTH_M);
    let mut page = SvgWriter::begin(out, view, &page, &black)?;
    let column = layout.paths.attributes.get(GROUP);
    let mut current: Option<String> = None;
    let mut order: Vec<usize> = (0..layout.paths.len()).collect();
    if let Some(rank) = layout.paths.rank() {
        order.sort_by_key(|&path| rank[path]);
    }
    for path in order.into_iter().map(|row| layout.paths.get(row)) {
        let own = column.and_then(|c| c.values.get(path.row()));
        let level = || Some(layout.levels.get(path.level()? as usize)?.id.clone());
        let group = own.map(|value: Value<'_>| value.to_string()).or_else(level);
        if group != current {
            if current.is_some() {
                page.end_group()?;
            }
            if let Some(group) = &group {
                page.begin_group(group)?;
            }
            current = group;
        }
        let mut outline = PathData::new(POSITION_STEP_M);
        for segment in path.runs().flat_map(|run| run.segments()) {
            // Up is down on a page.
            outline.push_segment(&segment.map(|p| Point::new(p.x, -p.y)));
        }
        page.path(path.id(), &outline, &stroke(layout, path))?;
    }
    if current.is_some() {
        page.end_group()?;
    }
    page.finish()?;
    Ok(losses(layout))
}

fn stroke(layout: &Layout, path: PathRef<'_>) -> Stroke {
    let own = layout.paths.own_style(path.row());
    // A stroke of no width is not drawn by anyone else.
    let width_m = own.width_m.map(f64::from).filter(|&w| w > 0.0);
    let width_m = width_m.unwrap_or(WIDTH_M);
    Stroke::new(own.color_rgba.unwrap_or(0x0000_00FF), width_m)
}

fn losses(layout: &Layout) -> Losses {
    let mut losses = common_losses(layout);
    let ranks = layout.paths.rank().map_or(0, <[i32]>::len);
    losses.add(
        "draw ranks",
        ranks,
        "draw ranks: paths are written in their order",
    );
    losses.add_network(layout);
    losses.add_columns(&layout.paths.attributes, "paths", |name| name == GROUP);
    let detail = match layout.paths.attributes.get(GROUP) {
        Some(_) => "levels",
        None => "levels: they become groups",
    };
    losses.add("levels", layout.levels.len(), detail);
    let unnamed = layout.paths.iter().filter(|p| !is_kept(p.id()));
    let detail = "identifiers that are empty or have characters that XML has not";
    losses.add("identifiers", unnamed.count(), detail);
    losses
}

fn is_kept(id: &str) -> bool {
    !id.is_empty() && !id.contains(|c: char| !is_xml(c))
}

/// Whether a character can be in XML 1.0.
pub(super) fn is_xml(c: char) -> bool {
    !c.is_control() && !matches!(c, '\u{FFFE}' | '\u{FFFF}')
        || matches!(c, '\t' | '\n' | '\r' | '\u{7F}'..='\u{9F}')
}

/// What the page shows: all paths with a margin, and never nothing.
fn corners(layout: &Layout) -> (Point<f64>, Point<f64>) {
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
    let margin_m = (MARGIN * size.x.max(size.y)).max(LEAST_MARGIN_M);
    let Bounds { min, max } = bounds.inflated(margin_m);
    // To the millimeter.
    let down = |v: f64| (v * 1e3).floor() / 1e3;
    let up = |v: f64| (v * 1e3).ceil() / 1e3;
    (
        Point::new(down(min.x), down(min.y)),
        Point::new(up(max.x), up(max.y)),
    )
}

/// Text for an attribute. What XML has no room for becomes an underscore.
pub(super) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // Unescaped, a reader makes spaces of them.
            '\t' | '\n' | '\r' => {
                // Writing to a text cannot fail.
                let _ = write!(safe, "&#{};", u32::from(c));
            }
            c if is_xml(c) => safe.push(c),
            _ => safe.push('_'),
        }
    }
    safe
}
