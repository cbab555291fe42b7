use guideway_spline::Point;

use super::Marks;

/// What a shape stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// Which way vehicles go.
    Arrow,
    /// A node.
    Node,
    /// A station.
    Station,
}

/// Length of an arrow's head, as a multiple of half its width.
const HEAD_LENGTH: f64 = 2.25;
/// Least half of the width of an arrow's head.
const HEAD_RADIUS: f64 = 4.0;
/// Width of an arrow's head, as a multiple of that of its line.
const HEAD_WIDTH: f64 = 2.0;
/// How far ahead of its place a head begins, so that the arrows of two opposite paths are not one over the other.
const AHEAD: f64 = 2.0;
/// From the middle of a node's diamond to its corners.
const NODE: f64 = 4.0;
/// From the middle of a station's square to its sides.
const STATION: f64 = 6.0;

impl Marks {
    /// Draws the convex shapes of all arrows and symbols, from the lowest. `place` says where a pixel of the view is
    /// drawn; there the shapes are `scale` times as large as on a screen of one pixel a point, and arrows wider than
    /// their lines.
    pub fn draw_shapes(
        &self,
        scale: f64,
        place: impl Fn(Point<f64>) -> Point<f64>,
        mut draw: impl FnMut(MarkKind, &[Point<f64>]),
    ) {
        for arrow in &self.arrows {
            let at = place(arrow.at_px);
            let drawn_from_px = place(arrow.at_px + arrow.direction).distance(at);
            let line_radius = arrow.line_radius_px * drawn_from_px;
            let radius = (HEAD_WIDTH * line_radius).max(HEAD_RADIUS * scale);
            let signs = if arrow.is_two_way {
                &[1.0, -1.0][..]
            } else {
                &[1.0]
            };
            for sign in signs {
                let ahead = arrow.direction * *sign;
                let side = Point::new(-ahead.y, ahead.x) * radius;
                let base = at + ahead * (AHEAD * scale);
                let tip = base + ahead * (HEAD_LENGTH * radius);
                draw(MarkKind::Arrow, &[tip, base + side, base - side]);
            }
        }
        let mut symbols = |kind, places: &[Point<f64>], corners: [(f64, f64); 4], size: f64| {
            for &at in places {
                let corner = |(x, y)| place(at) + Point::new(x, y) * (size * scale);
                draw(kind, &corners.map(corner));
            }
        };
        let diamond = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
        let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        symbols(MarkKind::Node, &self.nodes, diamond, NODE);
        symbols(MarkKind::Station, &self.stations, square, STATION);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decorations::Arrow;

    #[test]
    fn arrows_point_where_vehicles_go() {
        let arrow = |is_two_way| Arrow {
            at_px: Point::new(10.0, 20.0),
            direction: Point::new(0.0, -1.0),
            is_two_way,
            line_radius_px: 1.0,
        };
        let marks = Marks {
            arrows: vec![arrow(false), arrow(true)],
            nodes: vec![Point::new(1.0, 1.0)],
            ..Marks::default()
        };
        let mut shapes = Vec::new();
        let place = |at: Point<f64>| at * 2.0;
        marks.draw_shapes(2.0, place, |kind, corners| {
            shapes.push((kind, corners.to_vec()));
        });
        let kinds: Vec<MarkKind> = shapes.iter().map(|(kind, _)| *kind).collect();
        assert_eq!(
            kinds,
            [
                MarkKind::Arrow,
                MarkKind::Arrow,
                MarkKind::Arrow,
                MarkKind::Node
            ]
        );
        let tips = shapes[..3].iter().map(|(_, corners)| corners[0].y);
        assert_eq!(tips.collect::<Vec<_>>(), [18.0, 18.0, 62.0]);
        assert_eq!(shapes[3].1[0], Point::new(2.0, -6.0));
    }

    #[test]
    fn arrows_are_wider_than_their_lines() {
        for (line_radius_px, scale, radius) in [(0.75, 1.0, 4.0), (6.0, 1.0, 12.0), (3.0, 2.0, 8.0)]
        {
            let arrow = Arrow {
                at_px: Point::new(10.0, 20.0),
                direction: Point::new(1.0, 0.0),
                is_two_way: false,
                line_radius_px,
            };
            let marks = Marks {
                arrows: vec![arrow],
                ..Marks::default()
            };
            marks.draw_shapes(
                scale,
                |at| at,
                |_, corners| {
                    assert_eq!(
                        (corners[1].y - 20.0, corners[2].y - 20.0),
                        (radius, -radius)
                    );
                    assert_eq!(corners[0].x - corners[1].x, 2.25 * radius);
                },
            );
        }
    }
}
