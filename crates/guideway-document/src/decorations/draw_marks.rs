//! Draws marks: arrows, node and station symbols as polygons, labels as text.

use std::f64::consts::TAU;

use guideway_scene::{DrawList, Rgba, TextLine};
use guideway_spline::{Bounds, Point};

use super::marks::{Arrow, Marks};
use super::style::{DecorationStyle, MarkKind};

/// Length of an arrow head, per unit of half its width.
const HEAD_LENGTH: f64 = 2.25;
/// Least half width of an arrow head, in points.
const MIN_HEAD_RADIUS_POINTS: f64 = 4.0;
/// Width of an arrow head, per unit of the width of its line.
const HEAD_WIDTH: f64 = 2.0;
/// Distance from an arrow's position to the base of its head, in points. It separates the two heads
/// of a two-way arrow.
const HEAD_OFFSET_POINTS: f64 = 2.0;
/// Least radius of the disc of a node, in points.
const MIN_NODE_RADIUS_POINTS: f64 = 3.75;
/// Radius of the disc of a node, per unit of half the width of lines: it shows on wide ones.
const NODE_RADIUS: f64 = 1.25;
/// Corners of the disc of a node.
const NODE_CORNERS: u32 = 16;
/// From the center of a station's square to its sides, in points.
const STATION_RADIUS_POINTS: f64 = 6.0;
/// Width of the rims of nodes and stations, in points.
const RIM_POINTS: f64 = 1.5;

/// Length of the dashes of a link and of the spaces between them, in points.
const DASH_POINTS: f64 = 4.0;
/// Half the width of a link, in points.
const LINK_RADIUS_POINTS: f64 = 0.6;
/// Most dashes of a link; a longer one, which leads far out of the view, is a line.
const MAX_DASHES: f64 = 500.0;

const SQUARE: [(f64, f64); 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];

impl Marks {
    /// Draws all marks. `map` maps the pixels of the view that the marks were placed for to the
    /// pixels to draw them at: the identity, or the way to a view that has moved since. Symbols
    /// keep their size; arrows stay wider than their lines.
    pub fn draw(
        &self,
        style: &DecorationStyle,
        map: impl Fn(Point<f64>) -> Point<f64>,
    ) -> DrawList {
        let mut list = DrawList::default();
        let point_px = style.px_per_point;
        for arrow in &self.arrows {
            draw_arrow(&mut list, arrow, style, &map);
        }
        let color = style.mark_color(MarkKind::Station);
        for link in &self.links {
            draw_dashes(&mut list, link.map(&map), color, point_px);
        }
        let disc = (0..NODE_CORNERS).map(|corner| {
            let angle = f64::from(corner) * TAU / f64::from(NODE_CORNERS);
            (angle.cos(), angle.sin())
        });
        let disc: Vec<_> = disc.collect();
        let least_px = MIN_NODE_RADIUS_POINTS * point_px;
        let node_px = (NODE_RADIUS * self.line_radius_px + RIM_POINTS * point_px).max(least_px);
        let station_px = STATION_RADIUS_POINTS * point_px;
        let symbols = [
            (MarkKind::Node, &self.nodes, &disc[..], node_px),
            (MarkKind::Station, &self.stations, &SQUARE[..], station_px),
        ];
        for (kind, positions, corners, radius_px) in symbols {
            // The paper within a rim: lines and names stand out against symbols.
            let layers = [
                (style.mark_color(kind), radius_px),
                (style.paper, radius_px - RIM_POINTS * point_px),
            ];
            for (color, radius_px) in layers {
                for &at_px in positions {
                    let center = map(at_px);
                    let corner = |&(x, y): &(f64, f64)| center + Point::new(x, y) * radius_px;
                    let corners: Vec<_> = corners.iter().map(corner).collect();
                    list.fill_polygon(color, &corners);
                }
            }
        }
        for label in &self.labels {
            list.texts.push(TextLine {
                text: label.text.clone(),
                left_middle_px: map(label.at_px),
                angle_rad: label.angle_rad,
                anchor: label.anchor,
                char_width_px: style.label_size().char_px,
                color: style.ink,
                halo: style.paper,
            });
        }
        list
    }
}

/// Draws a dashed line.
fn draw_dashes(list: &mut DrawList, [a, b]: [Point<f64>; 2], color: Rgba, point_px: f64) {
    let radius_px = LINK_RADIUS_POINTS * point_px;
    let count = (a.distance(b) / (2.0 * DASH_POINTS * point_px)).ceil();
    if !(1.0..=MAX_DASHES).contains(&count) {
        list.stroke_segment(color, [a, b], radius_px);
        return;
    }
    let step = (b - a) * (1.0 / count);
    for dash in 0..count as u32 {
        let start = a + step * f64::from(dash);
        list.stroke_segment(color, [start, start + step * 0.5], radius_px);
    }
}

fn draw_arrow(
    list: &mut DrawList,
    arrow: &Arrow,
    style: &DecorationStyle,
    map: impl Fn(Point<f64>) -> Point<f64>,
) {
    let color = style.mark_color(MarkKind::Arrow);
    for head in arrow_heads(arrow, style.px_per_point, map) {
        list.fill_polygon(color, &head);
    }
}

/// Bounding box of the heads of an arrow, in pixels of the view that it was placed for.
pub(super) fn arrow_box(arrow: &Arrow, px_per_point: f64) -> Option<Bounds<f64>> {
    Bounds::of_points(arrow_heads(arrow, px_per_point, |at_px| at_px).flatten())
}

/// The triangles of an arrow, tip first: one, or two in opposite directions.
fn arrow_heads(
    arrow: &Arrow,
    px_per_point: f64,
    map: impl Fn(Point<f64>) -> Point<f64>,
) -> impl Iterator<Item = [Point<f64>; 3]> {
    let at = map(arrow.at_px);
    let scale = map(arrow.at_px + arrow.direction).distance(at);
    let line_radius = arrow.line_radius_px * scale;
    let radius = (HEAD_WIDTH * line_radius).max(MIN_HEAD_RADIUS_POINTS * px_per_point);
    let forward = arrow.direction;
    let directions = [Some(forward), arrow.is_two_way.then_some(forward * -1.0)];
    directions.into_iter().flatten().map(move |forward| {
        let side = Point::new(-forward.y, forward.x) * radius;
        let base = at + forward * (HEAD_OFFSET_POINTS * px_per_point);
        let tip = base + forward * (HEAD_LENGTH * radius);
        [tip, base + side, base - side]
    })
}

#[cfg(test)]
mod tests {
    use guideway_scene::Rgba;

    use super::super::labels::Label;
    use super::*;

    fn arrow(direction: Point<f64>, line_radius_px: f64) -> Arrow {
        Arrow {
            at_px: Point::new(10.0, 20.0),
            direction,
            is_two_way: false,
            line_radius_px,
        }
    }

    #[test]
    fn arrows_point_along_their_direction() {
        let one_way = arrow(Point::new(0.0, -1.0), 1.0);
        let two_way = Arrow {
            is_two_way: true,
            ..one_way
        };
        let marks = Marks {
            arrows: vec![one_way, two_way],
            nodes: vec![Point::new(1.0, 1.0)],
            ..Marks::default()
        };
        let style = DecorationStyle::new(Rgba::WHITE, 2.0);
        let list = marks.draw(&style, |at| at * 2.0);
        let colors: Vec<_> = list.fills.iter().map(|fill| fill.color).collect();
        assert_eq!(colors, [style.ink, style.node, style.paper]);
        let tips = list.fills[0].polygons.iter().map(|corners| corners[0].y);
        assert_eq!(tips.collect::<Vec<_>>(), [18.0, 18.0, 62.0]);
        // A disc of 3.75 points at twice the pixels, about (2, 2).
        assert_eq!(list.fills[1].polygons[0][0], Point::new(9.5, 2.0));
    }

    #[test]
    fn names_have_halos_of_paper() {
        let label = Label {
            text: "dock".into(),
            at_px: Point::new(5.0, 6.0),
            angle_rad: 0.0,
            anchor: 1.0,
        };
        let marks = Marks {
            labels: vec![label],
            ..Marks::default()
        };
        for background in [Rgba::WHITE, Rgba::opaque(24, 26, 30)] {
            let style = DecorationStyle::new(background, 1.0);
            let list = marks.draw(&style, |at| at);
            let text = &list.texts[0];
            assert_eq!((text.color, text.halo), (style.ink, background));
            assert!(text.halo_px() > 1.5 && text.anchor == 1.0);
        }
    }

    #[test]
    fn nodes_stand_out_from_wide_lines() {
        let radius_px = |line_radius_px: f64| {
            let marks = Marks {
                nodes: vec![Point::default()],
                line_radius_px,
                ..Marks::default()
            };
            let list = marks.draw(&DecorationStyle::new(Rgba::WHITE, 1.0), |at| at);
            list.fills[0].polygons[0][0].x
        };
        assert_eq!((radius_px(0.75), radius_px(6.0)), (3.75, 9.0));
    }

    #[test]
    fn arrow_heads_are_wider_than_their_lines() {
        for (line_radius_px, px_per_point, radius) in
            [(0.75, 1.0, 4.0), (6.0, 1.0, 12.0), (3.0, 2.0, 8.0)]
        {
            let marks = Marks {
                arrows: vec![arrow(Point::new(1.0, 0.0), line_radius_px)],
                ..Marks::default()
            };
            let list = marks.draw(&DecorationStyle::new(Rgba::WHITE, px_per_point), |at| at);
            let [tip, left, right] = list.fills[0].polygons[0][..] else {
                panic!("a head is a triangle");
            };
            assert_eq!((left.y - 20.0, right.y - 20.0), (radius, -radius));
            assert_eq!(tip.x - left.x, 2.25 * radius);
        }
    }
}
