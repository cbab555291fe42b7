//! The route of a picture: a translucent band over its paths, with start and end marked.

use std::f64::consts::TAU;

use guideway_document::decorations::{DecorationStyle, Outline, path_outline};
use guideway_scene::{DrawList, Rgba, Scene, Style, TextLine, View};
use guideway_spline::{Bounds, Point};

use crate::vector::width_px;

/// Width that the band has beyond that of the path, on either side, in points.
const MARGIN_POINTS: f64 = 3.0;
/// Radius of the marks of start and end, in points.
const MARK_RADIUS_POINTS: f64 = 8.0;
/// Radius of the paper around them, in points.
const RING_RADIUS_POINTS: f64 = 10.5;
/// Corners of a disc. Derived: a disc of 20 pixels differs from it by less than 0.4 pixels.
const DISC_CORNERS: usize = 16;
const BAND: Rgba = Rgba::opaque(255, 120, 0);
const BAND_OPACITY: f64 = 0.55;
const START: Rgba = Rgba::opaque(0, 130, 60);
const END: Rgba = Rgba::opaque(200, 20, 30);
const LABEL_PAPER_OPACITY: f64 = 0.9;
/// From a mark to its name, in points.
const GAP_POINTS: f64 = 3.0;

/// A route to draw.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MarkedRoute {
    /// Rows of its paths in order; `true` where the vehicle drives from the end of the path to its
    /// start.
    pub paths: Vec<(u32, bool)>,
    /// Name of the start.
    pub from: String,
    /// Name of the goal.
    pub to: String,
}

/// A route in a view.
#[derive(Debug, Default)]
pub(super) struct DrawnRoute {
    /// Over the paths, below other marks.
    pub(super) band: DrawList,
    /// Start and goal with their names, over everything.
    pub(super) ends: DrawList,
    /// Boxes of start and goal and of their names, which other marks keep clear of.
    pub(super) occupied: Vec<Bounds<f64>>,
}

/// Draws a route. Paths that the scene does not have are left out.
pub(super) fn draw(
    route: &MarkedRoute,
    scene: &Scene,
    view: &View,
    paths: &Style,
    style: &DecorationStyle,
) -> DrawnRoute {
    let mut drawn = DrawnRoute::default();
    let layout = scene.layout();
    let rows = route.paths.iter().copied();
    let rows: Vec<_> = rows
        .filter(|&(row, _)| (row as usize) < layout.paths.len())
        .collect();
    let color = BAND.with_opacity(BAND_OPACITY);
    for &(row, _) in &rows {
        let margin_px = MARGIN_POINTS * style.px_per_point;
        let radius_px = width_px(scene, row, view, paths) / 2.0 + margin_px;
        if let Outline::Lines(lines) = path_outline(layout.paths.get(row as usize), view) {
            for line in &lines {
                band(&mut drawn.band, color, line, radius_px);
            }
        }
    }
    let end_of = |&(row, is_backward): &(u32, bool), is_last: bool| {
        let (start, end) = layout.paths.get(row as usize).ends()?;
        Some(if is_backward == is_last { start } else { end })
    };
    let start = rows.first().and_then(|path| end_of(path, false));
    let goal = rows.last().and_then(|path| end_of(path, true));
    for (at, name, color) in [(start, &route.from, START), (goal, &route.to, END)] {
        if let Some(at) = at {
            drawn.mark(at, name, color, view, style);
        }
    }
    drawn
}

impl DrawnRoute {
    /// Adds a mark with its name, on the side where the picture has room.
    fn mark(
        &mut self,
        at: Point<f64>,
        name: &str,
        color: Rgba,
        view: &View,
        style: &DecorationStyle,
    ) {
        let at = view.pixel_from_world(at);
        let (point_px, list) = (style.px_per_point, &mut self.ends);
        let ring_px = RING_RADIUS_POINTS * point_px;
        list.fill_polygon(style.paper, &disc(at, ring_px));
        list.fill_polygon(color, &disc(at, MARK_RADIUS_POINTS * point_px));
        let mut line = TextLine {
            text: guideway_document::text_format::single_line(name, 40),
            left_middle_px: at + Point::new(ring_px + GAP_POINTS * point_px, 0.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: style.line_px() * TextLine::CHAR_ASPECT,
            color,
            halo: style.paper.with_opacity(LABEL_PAPER_OPACITY),
        };
        let width_px = line.width_px();
        if line.left_middle_px.x + width_px > f64::from(view.size().width()) {
            line.left_middle_px.x = at.x - ring_px - GAP_POINTS * point_px - width_px;
        }
        let half = Point::new(0.0, style.line_px() / 2.0);
        self.occupied.push(Bounds {
            min: line.left_middle_px - half,
            max: line.left_middle_px + half + Point::new(width_px, 0.0),
        });
        let ring = Point::new(ring_px, ring_px);
        self.occupied.push(Bounds {
            min: at - ring,
            max: at + ring,
        });
        list.texts.push(line);
    }
}

/// A polyline of a radius, with round joins and caps.
fn band(list: &mut DrawList, color: Rgba, line: &[Point<f64>], radius_px: f64) {
    for pair in line.windows(2) {
        list.stroke_segment(color, [pair[0], pair[1]], radius_px);
    }
    for &at in line {
        list.fill_polygon(color, &disc(at, radius_px));
    }
}

fn disc(center: Point<f64>, radius_px: f64) -> Vec<Point<f64>> {
    let angle = |corner: usize| TAU * corner as f64 / DISC_CORNERS as f64;
    let corner = |angle: f64| center + Point::new(angle.cos(), angle.sin()) * radius_px;
    (0..DISC_CORNERS).map(|i| corner(angle(i))).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use guideway_layout::{Layout, NewPath};
    use guideway_scene::{FrameSize, SceneOptions};
    use guideway_spline::Runs;

    use super::*;

    #[test]
    fn band_follows_the_paths_and_marks_both_ends() {
        let mut layout = Layout::default();
        for (from, to) in [((0.0, 0.0), (10.0, 0.0)), ((10.0, 8.0), (10.0, 0.0))] {
            let mut runs = Runs::default();
            runs.push_line(Point::new(from.0, from.1), Point::new(to.0, to.1));
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
        }
        let scene = Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap();
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::fit(size, scene.bounds()).unwrap();
        let paths = Style::default();
        let style = DecorationStyle::for_picture(size, paths.background);
        let route = MarkedRoute {
            // The second path is driven from its end to its start, the third does not exist.
            paths: vec![(0, false), (1, true), (9, false)],
            from: "dock".into(),
            to: "rack".into(),
        };
        let drawn = draw(&route, &scene, &view, &paths, &style);
        let colors = |list: &DrawList| list.fills.iter().map(|fill| fill.color).collect::<Vec<_>>();
        assert_eq!(colors(&drawn.band), [BAND.with_opacity(BAND_OPACITY)]);
        assert_eq!(colors(&drawn.ends), [style.paper, START, style.paper, END]);
        let center = |fill: usize| {
            let corners = &drawn.ends.fills[fill].polygons[0];
            let sum = corners.iter().fold(Point::default(), |sum, p| sum + *p);
            view.world_from_pixel(sum * (1.0 / corners.len() as f64))
        };
        assert!(center(1).distance(Point::new(0.0, 0.0)) < 1e-6);
        assert!(center(3).distance(Point::new(10.0, 8.0)) < 1e-6);
        let texts: Vec<_> = drawn.ends.texts.iter().collect();
        assert_eq!(
            (texts[0].text.as_str(), texts[1].text.as_str()),
            ("dock", "rack")
        );
        // The goal is at the right border, so its name is on its left.
        let goal = view.pixel_from_world(Point::new(10.0, 8.0));
        assert!(texts[0].left_middle_px.x > view.pixel_from_world(Point::default()).x);
        let room_px = f64::from(view.size().width()) - goal.x;
        let is_left = texts[1].left_middle_px.x < goal.x;
        assert_eq!(is_left, room_px < texts[1].width_px() + 13.5, "{room_px}");
        assert_eq!(drawn.occupied.len(), 4);
    }
}
