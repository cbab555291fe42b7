//! From path data to runs.

use guideway_spline::{Affine, Point, Runs};
use svgtypes::{PathParser, PathSegment};

use crate::ellipse;

/// Draws lines and curves in user units, as control points in meters.
pub(super) struct Pen {
    pub(super) meters_from_user: Affine,
    pub(super) tolerance_m: f64,
    /// Largest absolute coordinate, in meters.
    pub(super) most_m: f64,
    pub(super) most_points: u64,
    pub(super) runs: Runs,
    start: Point<f64>,
    at: Point<f64>,
    /// The control point before the place of the pen, and the degree of its curve; smooth curves mirror it.
    handle: Option<(u8, Point<f64>)>,
    is_too_far: bool,
}

impl Pen {
    pub(super) fn new(
        meters_from_user: Affine,
        tolerance_m: f64,
        most_m: f64,
        most_points: u64,
    ) -> Self {
        let origin = Point::new(0.0, 0.0);
        Self {
            meters_from_user,
            tolerance_m,
            most_m,
            most_points,
            runs: Runs::default(),
            start: origin,
            at: origin,
            handle: None,
            is_too_far: false,
        }
    }

    /// Whether something was too far away to be drawn.
    pub(super) fn is_too_far(&self) -> bool {
        self.is_too_far
    }

    pub(super) fn move_to(&mut self, to: Point<f64>) {
        (self.start, self.at, self.handle) = (to, to, None);
    }

    pub(super) fn line_to(&mut self, to: Point<f64>) {
        let [from, end] = [self.at, to].map(|p| self.meters_from_user.apply(p));
        self.runs.push_line(from, end);
        self.go(to, None);
    }

    pub(super) fn close(&mut self) {
        if self.at != self.start {
            self.line_to(self.start);
        }
        self.handle = None;
    }

    fn cubic_to(&mut self, first: Point<f64>, second: Point<f64>, to: Point<f64>) {
        let bezier = [self.at, first, second, to].map(|p| self.meters_from_user.apply(p));
        self.runs.push_bezier(&bezier);
        self.go(to, Some((3, second)));
    }

    fn quadratic_to(&mut self, middle: Point<f64>, to: Point<f64>) {
        let bezier = [self.at, middle, to].map(|p| self.meters_from_user.apply(p));
        self.runs.push_quadratic(&bezier);
        self.go(to, Some((2, middle)));
    }

    fn go(&mut self, to: Point<f64>, handle: Option<(u8, Point<f64>)>) {
        (self.at, self.handle) = (to, handle);
    }

    /// The handle of a smooth curve: that of the last one of the same degree, mirrored.
    fn mirrored(&self, degree: u8) -> Point<f64> {
        match self.handle {
            Some((last, handle)) if last == degree => self.at * 2.0 - handle,
            _ => self.at,
        }
    }

    /// An arc of the ellipse that the unit circle becomes, counter-clockwise in a plane with y up.
    pub(super) fn arc(&mut self, ellipse: Affine, start: f64, sweep: f64) {
        let map = ellipse.then(self.meters_from_user);
        let (tolerance_m, most_m) = (self.tolerance_m, self.most_m);
        let drawn = ellipse::append_arc(map, start, sweep, tolerance_m, most_m, &mut self.runs);
        self.is_too_far |= !drawn;
    }

    /// Follows path data. Fails at the first command that is wrong, and then says where; what comes before it
    /// is drawn, as the standard says.
    pub(super) fn follow(&mut self, data: &str) -> Result<(), String> {
        for segment in PathParser::from(data) {
            let segment = segment.map_err(|error| error.to_string())?;
            self.segment(segment);
            if self.runs.points().len() as u64 > self.most_points {
                break;
            }
        }
        Ok(())
    }

    fn segment(&mut self, segment: PathSegment) {
        let from = if segment.is_abs() {
            Point::new(0.0, 0.0)
        } else {
            self.at
        };
        let place = |x: f64, y: f64| from + Point::new(x, y);
        match segment {
            PathSegment::MoveTo { x, y, .. } => self.move_to(place(x, y)),
            PathSegment::LineTo { x, y, .. } => self.line_to(place(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => {
                self.line_to(Point::new(from.x + x, self.at.y));
            }
            PathSegment::VerticalLineTo { y, .. } => {
                self.line_to(Point::new(self.at.x, from.y + y));
            }
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => self.cubic_to(place(x1, y1), place(x2, y2), place(x, y)),
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                self.cubic_to(self.mirrored(3), place(x2, y2), place(x, y));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                self.quadratic_to(place(x1, y1), place(x, y));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                self.quadratic_to(self.mirrored(2), place(x, y));
            }
            PathSegment::EllipticalArc {
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
                ..
            } => {
                let radii = [rx.abs(), ry.abs()];
                self.arc_to(radii, x_axis_rotation, large_arc, sweep, place(x, y));
            }
            PathSegment::ClosePath { .. } => self.close(),
        }
    }

    /// From end points to center and angles: SVG 2, appendix B.2.4.
    fn arc_to(
        &mut self,
        [rx, ry]: [f64; 2],
        rotation_degrees: f64,
        is_large: bool,
        is_sweep: bool,
        to: Point<f64>,
    ) {
        let from = self.at;
        if from == to {
            return;
        }
        if rx == 0.0 || ry == 0.0 {
            return self.line_to(to);
        }
        let (sin, cos) = rotation_degrees.to_radians().sin_cos();
        let half = (from - to) * 0.5;
        // Half of the chord, seen on the unit circle.
        let seen = Point::new(
            (cos * half.x + sin * half.y) / rx,
            (cos * half.y - sin * half.x) / ry,
        );
        // Radii that are too short for the chord are made as long as it needs.
        let scale = seen.norm().max(1.0);
        let seen = seen * (1.0 / scale);
        let rest = (1.0 / seen.dot(seen) - 1.0).max(0.0).sqrt();
        let side = if is_large == is_sweep { -1.0 } else { 1.0 };
        let center = Point::new(seen.y, -seen.x) * (rest * side);
        let [start, end] = [seen - center, -seen - center].map(|arm| arm.y.atan2(arm.x));
        let turn = end - start;
        let full = std::f64::consts::TAU;
        let sweep = match (is_sweep, turn > 0.0) {
            (true, false) => turn + full,
            (false, true) => turn - full,
            _ => turn,
        };
        let x = Point::new(cos, sin) * (rx * scale);
        let y = Point::new(-sin, cos) * (ry * scale);
        let origin = from.lerp(to, 0.5) + x * center.x + y * center.y;
        self.arc(Affine { x, y, origin }, start, sweep);
        self.go(to, None);
    }
}

#[cfg(test)]
mod tests {
    use guideway_spline::uniform;

    use super::*;

    fn follow(data: &str) -> Pen {
        let mut pen = Pen::new(Affine::IDENTITY, 1e-6, 1e9, 1_000_000);
        pen.follow(data).unwrap();
        pen
    }

    fn points(pen: &Pen) -> Vec<Point<f64>> {
        let segments = pen.runs.iter().flat_map(|run| run.array_windows::<4>());
        let at = |segment: &[Point<f64>; 4]| [0.0, 0.5, 1.0].map(|t| uniform::point(segment, t));
        segments.flat_map(at).collect()
    }

    #[test]
    fn arcs_go_round_the_side_that_the_flags_say() {
        // From (0, 0) to (2, 2) about (2, 0) or (0, 2), y down: of the same circle the short or the long way.
        for (flags, center, through) in [
            ("0 0", (2.0, 0.0), (2.0 - 2_f64.sqrt(), 2_f64.sqrt())),
            ("0 1", (0.0, 2.0), (2_f64.sqrt(), 2.0 - 2_f64.sqrt())),
            ("1 0", (0.0, 2.0), (-2_f64.sqrt(), 2.0 + 2_f64.sqrt())),
            ("1 1", (2.0, 0.0), (2.0 + 2_f64.sqrt(), -2_f64.sqrt())),
        ] {
            let pen = follow(&format!("M 0 0 A 2 2 0 {flags} 2 2"));
            let points = points(&pen);
            let [center, through] = [center, through].map(|(x, y)| Point::new(x, y));
            assert!(
                points
                    .iter()
                    .all(|p| (p.distance(center) - 2.0).abs() < 2e-6),
                "{flags}"
            );
            let nearest = points.iter().map(|p| p.distance(through));
            assert!(nearest.fold(f64::MAX, f64::min) < 0.2, "{flags}");
            assert!(points[0].norm() < 1e-12);
            assert!(points[points.len() - 1].distance(Point::new(2.0, 2.0)) < 1e-12);
        }
    }

    #[test]
    fn radii_that_are_too_short_grow() {
        let points = points(&follow("M 0 0 A 1 1 30 0 1 10 0"));
        let center = Point::new(5.0, 0.0);
        assert!(
            points
                .iter()
                .all(|p| (p.distance(center) - 5.0).abs() < 2e-6)
        );
    }

    #[test]
    fn smooth_curves_mirror_handles_of_their_own_kind() {
        let smooth = follow("M0 0 C 1 1 2 1 3 0 S 5 -1 6 0");
        let written = follow("M0 0 C 1 1 2 1 3 0 C 4 -1 5 -1 6 0");
        assert_eq!(smooth.runs, written.runs);
        let other = follow("M0 0 C 1 1 2 1 3 0 T 6 0");
        let line = follow("M0 0 C 1 1 2 1 3 0 Q 3 0 6 0");
        assert_eq!(other.runs, line.runs);
    }

    #[test]
    fn relative_commands_go_on_from_the_pen() {
        let relative = follow("m 1 1 l 2 0 h 3 v 1 z m 5 5 l 1 1");
        let absolute = follow("M 1 1 L 3 1 H 6 V 2 Z M 6 6 L 7 7");
        assert_eq!(relative.runs, absolute.runs);
    }
}
