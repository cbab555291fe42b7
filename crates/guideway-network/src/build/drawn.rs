//! Collects the curves of a drawing that the options select, each with its level and rule.

use std::collections::HashMap;

use guideway_layout::{Layout, Level, NoteKind, PathRef, Value};
use guideway_spline::bezier::{Bezier, SAME_M};
use guideway_spline::{Bounds, Point, uniform};

use super::{BuildOptions, BuildReport, NoteSource};

/// A curve between two ends.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    /// Row of its path in the drawing.
    pub(super) source: u32,
    /// Row of its level.
    pub(super) level: Option<u32>,
    /// Row of the rule of its layer.
    pub(super) rule: Option<u32>,
    /// Cubics, each beginning where the one before ends.
    pub(super) beziers: Vec<Bezier>,
    /// The curve is not the one of its path any more, or only a part of it.
    pub(super) is_changed: bool,
}

impl Curve {
    /// Start (side 0) or end (side 1).
    pub(super) fn end(&self, side: u32) -> Point<f64> {
        match side {
            0 => self.beziers[0][0],
            _ => self.beziers[self.beziers.len() - 1][3],
        }
    }

    /// Length of the control polygons, an upper bound of the length of the curve.
    pub(super) fn polygon_m(&self) -> f64 {
        self.beziers.iter().map(polygon_m).sum()
    }
}

/// Length of a control polygon.
pub(super) fn polygon_m(b: &Bezier) -> f64 {
    b[0].distance(b[1]) + b[1].distance(b[2]) + b[2].distance(b[3])
}

/// A circle that may mark a station.
pub(super) struct Circle {
    pub(super) center_m: Point<f64>,
    pub(super) layer: String,
}

/// The part of a drawing that the options select.
pub(super) struct Drawn {
    pub(super) curves: Vec<Curve>,
    pub(super) circles: Vec<Circle>,
    /// Levels of the drawing, then those that only rules name.
    pub(super) levels: Vec<Level>,
    /// Row of the level that each rule names.
    pub(super) rule_levels: Vec<Option<u32>>,
}

impl Drawn {
    /// Name of a level for people.
    pub(super) fn level_name(&self, level: Option<u32>) -> String {
        match level {
            Some(row) => format!("level \"{}\"", self.levels[row as usize].id),
            None => "no level".to_owned(),
        }
    }
}

/// Kinds of entities whose paths go around areas: no vehicle drives on them. Many are the heads of
/// arrows.
const AREAS: [&str; 4] = ["SOLID", "TRACE", "3DFACE", "HATCH"];

pub(super) fn collect(drawing: &Layout, options: &BuildOptions, report: &mut BuildReport) -> Drawn {
    let (levels, rule_levels) = levels(drawing, options);
    let mut drawn = Drawn {
        curves: Vec::with_capacity(drawing.paths.len()),
        circles: Vec::new(),
        levels,
        rule_levels,
    };
    let mut rules: HashMap<&str, Option<u32>> = HashMap::new();
    for path in drawing.paths.iter() {
        report.paths += 1;
        let layer = text(drawing, path.row(), "layer");
        let rule = *rules.entry(layer).or_insert_with(|| options.rule_of(layer));
        if text(drawing, path.row(), "entity") == "CIRCLE"
            && options.stations.iter().any(|s| s.is_circle_on(layer))
            && let Some(center_m) = center(path)
        {
            report.circles += 1;
            let layer = layer.to_owned();
            drawn.circles.push(Circle { center_m, layer });
            continue;
        }
        let is_used = match rule {
            _ if AREAS.contains(&text(drawing, path.row(), "entity")) => false,
            Some(rule) => !options.layers[rule as usize].leave,
            None => options.other_layers,
        };
        if !is_used {
            report.paths_left += 1;
            continue;
        }
        let level = rule.and_then(|rule| drawn.rule_levels[rule as usize]);
        let level = level.or(path.level());
        add_curves(path, level, rule, options.weld_m, &mut drawn.curves, report);
    }
    drawn
}

/// The levels of the drawing and of the rules, and the level of each rule.
fn levels(drawing: &Layout, options: &BuildOptions) -> (Vec<Level>, Vec<Option<u32>>) {
    let mut levels = drawing.levels.clone();
    let mut row_of = |name: &str| {
        let is_named = |l: &Level| l.id == name || l.name.as_deref() == Some(name);
        let row = levels.iter().position(is_named).unwrap_or_else(|| {
            levels.push(Level {
                id: name.to_owned(),
                ..Level::default()
            });
            levels.len() - 1
        });
        row as u32
    };
    let names = options.layers.iter().map(|rule| rule.level.as_deref());
    let rows = names.map(|name| name.map(&mut row_of)).collect();
    (levels, rows)
}

/// A text attribute of a path; empty if it has none.
pub(super) fn text<'a>(drawing: &'a Layout, path: usize, column: &str) -> &'a str {
    match drawing.paths.attributes.value(path, column) {
        Some(Value::Text(text)) => text,
        _ => "",
    }
}

fn center(path: PathRef<'_>) -> Option<Point<f64>> {
    let boxes = path.runs().flat_map(|run| run.segments());
    let boxes = boxes.map(|segment| Bounds::of_segment(&segment));
    boxes.reduce(Bounds::union).map(Bounds::center)
}

/// Adds the curves of a path: one, or one per part between gaps wider than the weld distance.
fn add_curves(
    path: PathRef<'_>,
    level: Option<u32>,
    rule: Option<u32>,
    weld_m: f64,
    curves: &mut Vec<Curve>,
    report: &mut BuildReport,
) {
    let new = || Curve {
        source: path.row() as u32,
        level,
        rule,
        beziers: Vec::new(),
        is_changed: false,
    };
    let (mut curve, mut parts) = (new(), 0);
    let mut finish = |curve: Curve| {
        if !curve.beziers.is_empty() {
            parts += 1;
            curves.push(curve);
        }
    };
    for segment in path.runs().flat_map(|run| run.segments()) {
        let mut bezier = uniform::to_bezier(&segment);
        if !bezier.iter().all(|p| p.is_finite()) || polygon_m(&bezier) <= SAME_M {
            continue;
        }
        if let Some(last) = curve.beziers.last() {
            if last[3].distance(bezier[0]) > weld_m.max(SAME_M) {
                finish(std::mem::replace(&mut curve, new()));
            } else {
                curve.is_changed |= bezier[0] != last[3];
                bezier[0] = last[3];
            }
        }
        curve.beziers.push(bezier);
    }
    finish(curve);
    match parts {
        0 => report.dots += 1,
        1 => {}
        _ => report.broken += 1,
    }
}

impl NoteSource {
    /// Returns `true` if the source is circles on a layer.
    fn is_circle_on(&self, layer: &str) -> bool {
        self.kind == NoteKind::Circle && self.is_of(layer)
    }
}
