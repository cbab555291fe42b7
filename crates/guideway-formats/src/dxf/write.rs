//! Writes a layout as ASCII DXF of release 2007, in meters, and reports what DXF cannot hold.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Write};

use guideway_layout::{Direction, Layout, PathRef, Value, WrittenCurve};
use guideway_spline::knots;

use super::pair_writer::PairWriter;
use super::write_sections::{write_after_entities, write_before_entities};
use super::xdata::write_path_id;
use crate::Losses;
use crate::clamped::{ClampedCurve, is_rewritten_as, rounded};
use crate::finite::check_finite;
use crate::losses::common_losses;
use crate::source::WrittenPaths;

/// Name of the attribute column that holds layer names.
const LAYER_COLUMN: &str = "layer";

/// Name of the attribute column that holds kinds of entities.
const ENTITY_COLUMN: &str = "entity";

/// Writes a layout, and returns what DXF cannot hold of it.
///
/// A straight path becomes a LINE, a path of several straight lines an LWPOLYLINE, and any other
/// path a SPLINE: the NURBS of its file, else one of degree 3 with clamped knots, which is the same
/// curve. The layer is the value of
/// the column `layer`, or else the level. Coordinates are rounded to a micrometer.
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
    let mut losses = losses(layout);
    let layers = LayerTable::of(layout, &mut losses);
    let max_entities = layout.paths.geometry().run_count() as u64;
    let mut pairs = PairWriter::new(out);
    write_before_entities(&mut pairs, &layers.names, max_entities)?;
    let (mut broken, mut without_knots, mut plain) = (0, 0, 0);
    let mut kinds = vec![None; layout.paths.len()];
    for path in layout.paths.iter() {
        written_paths.count();
        let layer = &layers.names[layers.rows[path.row()] as usize];
        if let Some(written) = layout.paths.written_curve(path.row()) {
            without_knots += usize::from(written.knots.is_empty());
            plain += usize::from(is_rewritten_as(path, None, written));
            kinds[path.row()] = Some("SPLINE");
            pairs.entity("SPLINE", layer)?;
            write_color(&mut pairs, true_color(layout, path))?;
            write_spline(&mut pairs, written)?;
            write_path_id(&mut pairs, path.id())?;
            continue;
        }
        let parts = ClampedCurve::connected_parts(path);
        broken += usize::from(parts.len() > 1);
        kinds[path.row()] = parts.first().map(entity_kind);
        for (i, part) in parts.iter().enumerate() {
            let id = match i {
                0 => Cow::Borrowed(path.id()),
                _ => Cow::Owned(format!("{}~{}", path.id(), i + 1)),
            };
            write_entity(&mut pairs, part, layer, true_color(layout, path))?;
            write_path_id(&mut pairs, &id)?;
        }
    }
    write_after_entities(&mut pairs)?;
    let detail = "paths with gaps: each part is a separate entity";
    losses.add("curves", broken, detail);
    let detail = "curves without knots: written with uniform ones";
    losses.add("curves", without_knots, detail);
    let detail = "lines with a trajectory of their own: read as lines";
    losses.add("curves", plain, detail);
    losses.add_replaced(layout, ENTITY_COLUMN, |row| kinds[row]);
    Ok(losses)
}

/// The entity that holds a curve.
fn entity_kind(curve: &ClampedCurve) -> &'static str {
    match (curve.as_line(), curve.degree) {
        (Some(_), _) => "LINE",
        (None, 1) => "LWPOLYLINE",
        _ => "SPLINE",
    }
}

fn write_entity<W: Write>(
    pairs: &mut PairWriter<'_, W>,
    curve: &ClampedCurve,
    layer: &str,
    rgb: Option<u32>,
) -> io::Result<()> {
    let kind = entity_kind(curve);
    pairs.entity(kind, layer)?;
    write_color(pairs, rgb)?;
    let points = curve.points.iter().map(|p| [p.x, p.y].map(rounded));
    if let Some([start, end]) = curve.as_line() {
        pairs.text(100, "AcDbLine")?;
        pairs.point(10, [start.x, start.y].map(rounded), true)?;
        pairs.point(11, [end.x, end.y].map(rounded), true)
    } else if curve.degree == 1 {
        pairs.text(100, "AcDbPolyline")?;
        pairs.int(90, curve.points.len() as u64)?;
        pairs.int(70, 0)?;
        points
            .into_iter()
            .try_for_each(|p| pairs.point(10, p, false))
    } else {
        write_spline(pairs, &curve.clone().into_written())
    }
}

fn write_color<W: Write>(pairs: &mut PairWriter<'_, W>, rgb: Option<u32>) -> io::Result<()> {
    match rgb {
        Some(rgb) => pairs.int(420, rgb.into()),
        None => Ok(()),
    }
}

/// Writes a NURBS with its own numbers.
fn write_spline<W: Write>(pairs: &mut PairWriter<'_, W>, curve: &WrittenCurve) -> io::Result<()> {
    /// Flags of a planar curve, and of one with weights.
    const PLANAR: u64 = 8;
    const RATIONAL: u64 = 4;
    let degree = curve.degree as usize;
    let knots = match curve.knots.is_empty() {
        true => Cow::Owned(knots::uniform_clamped(degree, curve.points_m.len())),
        false => Cow::Borrowed(&curve.knots[..]),
    };
    let weights = curve.weights.as_deref().unwrap_or_default();
    let rational = if weights.is_empty() { 0 } else { RATIONAL };
    pairs.text(100, "AcDbSpline")?;
    pairs.int(70, PLANAR + rational)?;
    pairs.int(71, curve.degree.into())?;
    pairs.int(72, knots.len() as u64)?;
    pairs.int(73, curve.points_m.len() as u64)?;
    pairs.int(74, 0)?;
    knots.iter().try_for_each(|&knot| pairs.real(40, knot))?;
    let mut weights = weights.iter();
    weights.try_for_each(|&weight| pairs.real(41, weight))?;
    let mut points = curve.points_m.iter();
    points.try_for_each(|p| pairs.point(10, [p.x, p.y], true))
}

/// The color of a path as 0xRRGGBB; `None` if the path has no color.
fn true_color(layout: &Layout, path: PathRef<'_>) -> Option<u32> {
    let color = layout.paths.color_rgba()?[path.row()];
    (color != 0).then_some(color >> 8)
}

fn losses(layout: &Layout) -> Losses {
    let mut losses = common_losses(layout);
    losses.add_widths(layout);
    let colors = || layout.paths.color_rgba().unwrap_or_default().iter();
    let translucent = colors().filter(|&&c| c != 0 && c & 0xFF != 0xFF).count();
    losses.add(
        "colors",
        translucent,
        "translucent colors: written as opaque",
    );
    let white = colors().filter(|&&c| c >> 8 == 0xFF_FFFF).count();
    let detail = "white paths: CAD programs draw them in black on paper";
    losses.add("colors", white, detail);
    losses.add_ranks(layout);
    losses.add_network_and_groups(layout, Direction::Forward);
    losses.add_columns(&layout.paths.attributes, "paths", |name| {
        [LAYER_COLUMN, ENTITY_COLUMN].contains(&name)
    });
    losses
}

/// The layers of the written drawing.
struct LayerTable {
    /// Layer names; the first is `0`, which every drawing has.
    names: Vec<String>,
    /// Index into `names` per path.
    rows: Vec<u32>,
}

impl LayerTable {
    /// Collects the layers of a layout, and reports the names that DXF does not allow.
    fn of(layout: &Layout, losses: &mut Losses) -> Self {
        let column = layout.paths.attributes.get(LAYER_COLUMN);
        let mut layers = Self {
            names: vec!["0".to_owned()],
            rows: Vec::with_capacity(layout.paths.len()),
        };
        let mut known = HashMap::from([("0".to_owned(), 0)]);
        let mut changed = 0;
        for path in layout.paths.iter() {
            let own = column.and_then(|c| c.values.get(path.row()));
            let level = || Some(layout.levels.get(path.level()? as usize)?.id.as_str());
            let name = match own {
                Some(Value::Text(name)) => Cow::Borrowed(name),
                Some(other) => Cow::Owned(other.to_string()),
                None => Cow::Borrowed(level().unwrap_or("0")),
            };
            let valid = valid_layer_name(&name);
            // DXF compares layer names without case.
            let row = *known.entry(valid.to_uppercase()).or_insert_with(|| {
                layers.names.push(valid.clone());
                layers.names.len() as u32 - 1
            });
            let is_same = match own {
                Some(own) => own == Value::Text(&layers.names[row as usize]),
                None => true,
            };
            changed += usize::from(!is_same);
            layers.rows.push(row);
        }
        let detail = "paths on layers whose names are invalid in DXF: the names are changed";
        losses.add(format!("column {LAYER_COLUMN}"), changed, detail);
        layers
    }
}

/// Replaces the characters that DXF forbids in a layer name, and cuts the name to its limit of 255.
fn valid_layer_name(name: &str) -> String {
    const FORBIDDEN: &str = "<>/\\\":;?*|=`,";
    let is_valid = |c: char| !c.is_control() && !FORBIDDEN.contains(c);
    let name: String = name
        .chars()
        .map(|c| if is_valid(c) { c } else { '_' })
        .take(255)
        .collect();
    if name.is_empty() {
        "0".to_owned()
    } else {
        name
    }
}
