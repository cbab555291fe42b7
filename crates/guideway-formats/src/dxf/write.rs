//! A layout as a drawing: ASCII DXF of release 2007, in meters, which every CAD program since reads.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::{self, Write};

use guideway_layout::{Layout, PathRef, Value};

use super::write_frame::{write_end, write_start};
use super::write_pairs::Pairs;
use crate::Losses;
use crate::clamped::{ClampedCurve, rounded};
use crate::common_losses::common_losses;

/// The application under whose name an entity keeps the identifier of its path.
pub(super) const APPLICATION: &str = "GUIDEWAY";

/// Name of the column that holds the layers of a drawing.
pub(super) const LAYER: &str = "layer";

/// Most bytes of one text of extended data, with some to spare.
const MOST_TEXT_BYTES: usize = 240;

/// Writes a layout: a LINE for each straight path, an LWPOLYLINE where several straight lines follow each
/// other, and a SPLINE of degree 3, which is the same curve over clamped knots, for any other. The layer is
/// that of the column `layer`, or else the level. Positions are to a micrometer. Returns what the format
/// cannot hold.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(layout: &Layout, out: &mut impl Write) -> io::Result<Losses> {
    let mut losses = losses(layout);
    let layers = Layers::of(layout, &mut losses);
    let most_entities = layout.paths.geometry().run_count() as u64;
    let mut pairs = Pairs::new(out);
    write_start(&mut pairs, &layers.names, most_entities)?;
    let mut broken = 0;
    for path in layout.paths.iter() {
        let parts = ClampedCurve::connected_parts(path);
        broken += usize::from(parts.len() > 1);
        for (i, part) in parts.iter().enumerate() {
            let id = match i {
                0 => Cow::Borrowed(path.id()),
                _ => Cow::Owned(format!("{}~{}", path.id(), i + 1)),
            };
            let layer = &layers.names[layers.rows[path.row()] as usize];
            write_entity(&mut pairs, part, layer, own_color(layout, path))?;
            write_id(&mut pairs, &id)?;
        }
    }
    write_end(&mut pairs)?;
    losses.add(
        "broken paths",
        broken,
        "paths with gaps: each part is an entity of its own",
    );
    Ok(losses)
}

fn write_entity<W: Write>(
    pairs: &mut Pairs<'_, W>,
    curve: &ClampedCurve,
    layer: &str,
    rgb: Option<u32>,
) -> io::Result<()> {
    let line = curve.as_line();
    let (kind, class) = match (line, curve.degree) {
        (Some(_), _) => ("LINE", "AcDbLine"),
        (None, 1) => ("LWPOLYLINE", "AcDbPolyline"),
        _ => ("SPLINE", "AcDbSpline"),
    };
    pairs.entity(kind, layer)?;
    if let Some(rgb) = rgb {
        pairs.whole(420, rgb.into())?;
    }
    pairs.text(100, class)?;
    let points = curve.points.iter().map(|p| [p.x, p.y].map(rounded));
    if let Some([start, end]) = line {
        pairs.point(10, [start.x, start.y].map(rounded), true)?;
        pairs.point(11, [end.x, end.y].map(rounded), true)
    } else if curve.degree == 1 {
        pairs.whole(90, curve.points.len() as u64)?;
        pairs.whole(70, 0)?;
        points
            .into_iter()
            .try_for_each(|p| pairs.point(10, p, false))
    } else {
        // Planar.
        pairs.whole(70, 8)?;
        pairs.whole(71, curve.degree as u64)?;
        pairs.whole(72, curve.knots.len() as u64)?;
        pairs.whole(73, curve.points.len() as u64)?;
        pairs.whole(74, 0)?;
        curve
            .knots
            .iter()
            .try_for_each(|&knot| pairs.real(40, knot))?;
        points
            .into_iter()
            .try_for_each(|p| pairs.point(10, p, true))
    }
}

/// Extended data of an entity: the identifier, in as many texts as it takes.
fn write_id<W: Write>(pairs: &mut Pairs<'_, W>, id: &str) -> io::Result<()> {
    pairs.text(1001, APPLICATION)?;
    let mut rest = id;
    loop {
        // Escapes take up to seven times the room of a character.
        let (part, after) = rest.split_at(rest.floor_char_boundary(MOST_TEXT_BYTES / 7));
        pairs.text(1000, part)?;
        if after.is_empty() {
            return Ok(());
        }
        rest = after;
    }
}

/// Red, green and blue of a path in one number, if it has a color of its own.
fn own_color(layout: &Layout, path: PathRef<'_>) -> Option<u32> {
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
        "translucent colors: they become opaque",
    );
    let white = colors().filter(|&&c| c >> 8 == 0xFF_FFFF).count();
    let detail = "paths in white: programs take it for black on paper";
    losses.add("colors", white, detail);
    losses.add_ranks(layout);
    losses.add_network(layout);
    losses.add_columns(&layout.paths.attributes, "paths", |name| name == LAYER);
    losses
}

/// The layers of the drawing.
struct Layers {
    /// Their names; the first is `0`, which every drawing has.
    names: Vec<String>,
    /// The layer of each path.
    rows: Vec<u32>,
}

impl Layers {
    fn of(layout: &Layout, losses: &mut Losses) -> Self {
        let column = layout.paths.attributes.get(LAYER);
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
            let allowed = allowed(&name);
            // Upper and lower case are one.
            let row = *known.entry(allowed.to_uppercase()).or_insert_with(|| {
                layers.names.push(allowed.clone());
                layers.names.len() as u32 - 1
            });
            changed += usize::from(layers.names[row as usize] != name);
            layers.rows.push(row);
        }
        let detail = "paths on layers whose names a drawing cannot have: they are changed";
        losses.add("layers", changed, detail);
        let what = match column {
            Some(_) => "levels",
            None => "levels: they become layers",
        };
        losses.add("levels", layout.levels.len(), what);
        layers
    }
}

/// A name that a layer can have.
fn allowed(name: &str) -> String {
    const FORBIDDEN: &str = "<>/\\\":;?*|=`,";
    let keep = |c: char| !c.is_control() && !FORBIDDEN.contains(c);
    let name: String = name
        .chars()
        .map(|c| if keep(c) { c } else { '_' })
        .take(255)
        .collect();
    if name.is_empty() {
        "0".to_owned()
    } else {
        name
    }
}
