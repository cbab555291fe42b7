//! Builds runs from drawing commands and path data: user units in, control points in meters out.

use std::f64::consts::TAU;

use guideway_spline::{Affine, Point, Runs};
use svgtypes::{Error, PathParser, PathSegment};

use crate::ellipse;

/// Appends lines, curves and arcs at a current point.
pub(super) struct PathBuilder {
    meters_from_user: Affine,
    tolerance_m: f64,
    /// Largest absolute coordinate, in meters.
    max_m: f64,
    max_points: u64,
    pub(super) runs: Runs,
    /// First point of the current subpath.
    start: Point<f64>,
    current: Point<f64>,
    /// The last control point and the degree of its curve; smooth curves reflect it.
    last_control: Option<(u8, Point<f64>)>,
    is_out_of_range: bool,
}

impl PathBuilder {
    pub(super) fn new(
        meters_from_user: Affine,
        tolerance_m: f64,
        max_m: f64,
        max_points: u64,
    ) -> Self {
        let origin = Point::new(0.0, 0.0);
        Self {
            meters_from_user,
            tolerance_m,
            max_m,
            max_points,
            runs: Runs::default(),
            start: origin,
            current: origin,
            last_control: None,
            is_out_of_range: false,
        }
    }

    /// Tells if an arc was dropped because it exceeds the largest coordinate.
    pub(super) fn is_out_of_range(&self) -> bool {
        self.is_out_of_range
    }

    pub(super) fn move_to(&mut self, to: Point<f64>) {
        (self.start, self.current, self.last_control) = (to, to, None);
    }

    pub(super) fn line_to(&mut self, to: Point<f64>) {
        let [from, end] = [self.current, to].map(|p| self.meters_from_user.apply(p));
        self.runs.push_line(from, end);
        self.advance_to(to, None);
    }

    pub(super) fn close(&mut self) {
        if self.current != self.start {
            self.line_to(self.start);
        }
        self.last_control = None;
    }

    fn cubic_to(&mut self, first: Point<f64>, second: Point<f64>, to: Point<f64>) {
        let bezier = [self.current, first, second, to].map(|p| self.meters_from_user.apply(p));
        self.runs.push_bezier(&bezier);
        self.advance_to(to, Some((3, second)));
    }

    fn quadratic_to(&mut self, control: Point<f64>, to: Point<f64>) {
        let bezier = [self.current, control, to].map(|p| self.meters_from_user.apply(p));
        self.runs.push_quadratic(&bezier);
        self.advance_to(to, Some((2, control)));
    }

    fn advance_to(&mut self, to: Point<f64>, last_control: Option<(u8, Point<f64>)>) {
        (self.current, self.last_control) = (to, last_control);
    }

    /// The implied control point of a smooth curve: the last control point reflected in the current
    /// point if the last curve had the same degree, else the current point.
    fn reflected_control(&self, degree: u8) -> Point<f64> {
        match self.last_control {
            Some((last, control)) if last == degree => self.current * 2.0 - control,
            _ => self.current,
        }
    }

    /// Appends an arc of an ellipse, given as an affine map of the unit circle. Positive angles are
    /// counter-clockwise in a plane with y up.
    pub(super) fn arc(&mut self, ellipse: Affine, start: f64, sweep: f64) {
        let map = ellipse.then(self.meters_from_user);
        let (tolerance_m, max_m) = (self.tolerance_m, self.max_m);
        let drawn = ellipse::append_arc(map, start, sweep, tolerance_m, max_m, &mut self.runs);
        self.is_out_of_range |= !drawn;
    }

    /// Appends path data. Stops at the first malformed command and keeps those before it, as SVG
    /// requires.
    ///
    /// # Errors
    /// When a command is malformed.
    pub(super) fn push_path_data(&mut self, data: &str) -> Result<(), Error> {
        for segment in PathParser::from(data) {
            self.push_segment(segment?);
            if self.runs.points().len() as u64 > self.max_points {
                break;
            }
        }
        Ok(())
    }

    fn push_segment(&mut self, segment: PathSegment) {
        let from = if segment.is_abs() {
            Point::new(0.0, 0.0)
        } else {
            self.current
        };
        let point = |x: f64, y: f64| from + Point::new(x, y);
        match segment {
            PathSegment::MoveTo { x, y, .. } => self.move_to(point(x, y)),
            PathSegment::LineTo { x, y, .. } => self.line_to(point(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => {
                self.line_to(Point::new(from.x + x, self.current.y));
            }
            PathSegment::VerticalLineTo { y, .. } => {
                self.line_to(Point::new(self.current.x, from.y + y));
            }
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => self.cubic_to(point(x1, y1), point(x2, y2), point(x, y)),
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                self.cubic_to(self.reflected_control(3), point(x2, y2), point(x, y));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                self.quadratic_to(point(x1, y1), point(x, y));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                self.quadratic_to(self.reflected_control(2), point(x, y));
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
                self.arc_to(radii, x_axis_rotation, large_arc, sweep, point(x, y));
            }
            PathSegment::ClosePath { .. } => self.close(),
        }
    }

    /// Appends an arc given by its end points: converts to center and angles.
    ///
    /// Source: SVG 2, appendix B.2.4.
    fn arc_to(
        &mut self,
        [rx, ry]: [f64; 2],
        rotation_degrees: f64,
        is_large: bool,
        is_sweep: bool,
        to: Point<f64>,
    ) {
        let from = self.current;
        if from == to {
            return;
        }
        if rx == 0.0 || ry == 0.0 {
            return self.line_to(to);
        }
        let (sin, cos) = rotation_degrees.to_radians().sin_cos();
        let half = (from - to) * 0.5;
        // Half of the chord in the coordinates of the unit circle.
        let half = Point::new(
            (cos * half.x + sin * half.y) / rx,
            (cos * half.y - sin * half.x) / ry,
        );
        // Radii too short for the chord grow until the chord is a diameter.
        let scale = half.norm().max(1.0);
        let half = half * (1.0 / scale);
        let offset = (1.0 / half.dot(half) - 1.0).max(0.0).sqrt();
        let side = if is_large == is_sweep { -1.0 } else { 1.0 };
        let center = Point::new(half.y, -half.x) * (offset * side);
        let [start, end] = [half - center, -half - center].map(|arm| arm.y.atan2(arm.x));
        let angle = end - start;
        let sweep = match (is_sweep, angle > 0.0) {
            (true, false) => angle + TAU,
            (false, true) => angle - TAU,
            _ => angle,
        };
        let x = Point::new(cos, sin) * (rx * scale);
        let y = Point::new(-sin, cos) * (ry * scale);
        let origin = from.lerp(to, 0.5) + x * center.x + y * center.y;
        self.arc(Affine { x, y, origin }, start, sweep);
        self.advance_to(to, None);
    }
}

#[cfg(test)]
mod tests {
    use guideway_spline::uniform;

    use super::*;

    fn build(data: &str) -> PathBuilder {
        let mut path = PathBuilder::new(Affine::IDENTITY, 1e-6, 1e9, 1_000_000);
        path.push_path_data(data).unwrap();
        path
    }

    fn points(path: &PathBuilder) -> Vec<Point<f64>> {
        let segments = path.runs.iter().flat_map(|run| run.array_windows::<4>());
        let at = |segment: &[Point<f64>; 4]| [0.0, 0.5, 1.0].map(|t| uniform::point(segment, t));
        segments.flat_map(at).collect()
    }

    #[test]
    fn arc_flags_select_the_center_and_the_direction() {
        // From (0, 0) to (2, 2) about (2, 0) or (0, 2), y down, the short or the long way.
        for (flags, center, through) in [
            ("0 0", (2.0, 0.0), (2.0 - 2_f64.sqrt(), 2_f64.sqrt())),
            ("0 1", (0.0, 2.0), (2_f64.sqrt(), 2.0 - 2_f64.sqrt())),
            ("1 0", (0.0, 2.0), (-2_f64.sqrt(), 2.0 + 2_f64.sqrt())),
            ("1 1", (2.0, 0.0), (2.0 + 2_f64.sqrt(), -2_f64.sqrt())),
        ] {
            let path = build(&format!("M 0 0 A 2 2 0 {flags} 2 2"));
            let points = points(&path);
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
    fn short_radii_grow_to_half_the_chord() {
        let points = points(&build("M 0 0 A 1 1 30 0 1 10 0"));
        let center = Point::new(5.0, 0.0);
        assert!(
            points
                .iter()
                .all(|p| (p.distance(center) - 5.0).abs() < 2e-6)
        );
    }

    #[test]
    fn smooth_curves_reflect_control_points_of_the_same_degree() {
        let smooth = build("M0 0 C 1 1 2 1 3 0 S 5 -1 6 0");
        let written = build("M0 0 C 1 1 2 1 3 0 C 4 -1 5 -1 6 0");
        assert_eq!(smooth.runs, written.runs);
        let other = build("M0 0 C 1 1 2 1 3 0 T 6 0");
        let line = build("M0 0 C 1 1 2 1 3 0 Q 3 0 6 0");
        assert_eq!(other.runs, line.runs);
    }

    #[test]
    fn relative_commands_start_at_the_current_point() {
        let relative = build("m 1 1 l 2 0 h 3 v 1 z m 5 5 l 1 1");
        let absolute = build("M 1 1 L 3 1 H 6 V 2 Z M 6 6 L 7 7");
        assert_eq!(relative.runs, absolute.runs);
    }
}
