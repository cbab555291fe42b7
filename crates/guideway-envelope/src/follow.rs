use std::f64::consts::{PI, TAU};

use guideway_spline::Point;

use crate::Heading;
use crate::step::{Directions, Drive, Turns, halves, polygon_m};

type P = Point<f64>;

/// A piece of a curve not longer than this is a point: what turns there is a cusp or a kink.
const DOT_M: f64 = 1e-5;

/// Parts of a path that are farther from each other do not meet.
const GAP_M: f64 = 0.01;

/// A path turns back by half a turn within this at a cusp.
const CUSP_RAD: f64 = 1.0 * PI / 180.0;

/// What rounding makes of no gap, and of no turn.
const NOTHING_M: f64 = 1e-8;
const NOTHING_RAD: f64 = 1e-9;

/// How often a segment is halved at most to find its cusps.
const MOST_HALVINGS: u32 = 40;

/// Follows a curve and appends its pieces with their headings.
pub(crate) struct Follow<'s> {
    heading: Heading,
    steps: &'s mut Vec<Drive>,
    end: Option<P>,
    /// Where the vehicle heads there.
    last_heading: Option<f64>,
    /// Which way round it drives: what is added to the direction of the curve.
    offset: f64,
    /// The first of the last steps, all of them points, whose headings the next direction decides.
    waiting: usize,
    is_apart: bool,
}

impl<'s> Follow<'s> {
    pub(crate) fn new(heading: Heading, steps: &'s mut Vec<Drive>) -> Self {
        Self {
            heading,
            end: None,
            last_heading: None,
            offset: 0.0,
            waiting: steps.len(),
            is_apart: true,
            steps,
        }
    }

    /// Appends a Bezier curve, whose coordinates are rounded by this share of their size. One that is not finite is
    /// nowhere.
    pub(crate) fn segment(&mut self, points: &[P; 4], rounding: f64) {
        if !points.iter().all(|p| p.is_finite()) {
            self.end();
            (self.end, self.is_apart) = (None, true);
            return;
        }
        let start = points[0];
        match self.end {
            Some(end) if end.distance(start) > GAP_M => {
                self.end();
                self.is_apart = true;
            }
            // It crosses the gap.
            Some(end) if end.distance(start) > NOTHING_M => self.wait(&[end, end, start, start]),
            _ => {}
        }
        self.end = Some(points[3]);
        match self.heading {
            Heading::Fixed(heading) => self.push(*points, [heading; 2], Turns::Never),
            Heading::Tangential(_) => {
                let far = points
                    .iter()
                    .fold(0.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs()));
                self.piece(points, DOT_M.max(rounding * far), MOST_HALVINGS);
            }
        }
    }

    /// Ends a part of the path.
    pub(crate) fn end(&mut self) {
        match self.last_heading {
            Some(heading) => self.turn_waiting([heading; 2]),
            // There was no direction at all.
            None if self.heading.is_tangential() => self.steps.truncate(self.waiting),
            None => {}
        }
        self.last_heading = None;
        self.waiting = self.steps.len();
    }

    fn piece(&mut self, points: &[P; 4], dot_m: f64, halvings_left: u32) {
        if polygon_m(points) <= dot_m {
            return self.wait(points);
        }
        match Directions::of(points) {
            Some(directions) => self.along(points, directions),
            None if halvings_left > 0 => {
                for half in halves(points) {
                    self.piece(&half, dot_m, halvings_left - 1);
                }
            }
            None => self.wait(points),
        }
    }

    /// A piece with a direction: the vehicle first turns to it.
    fn along(&mut self, points: &[P; 4], directions: Directions) {
        let Heading::Tangential(own) = self.heading else {
            return;
        };
        let first = match self.last_heading {
            None => {
                self.offset = own;
                directions.first + own
            }
            Some(last) => {
                let mut jump = wrapped(directions.first + self.offset - last);
                if jump.abs() > PI - CUSP_RAD {
                    self.offset += PI;
                    jump = wrapped(jump + PI);
                }
                last + jump
            }
        };
        let last = self.last_heading.unwrap_or(first);
        if (last - first).abs() > NOTHING_RAD && self.waiting == self.steps.len() {
            self.wait(&[points[0]; 4]);
        }
        self.turn_waiting([last.min(first), last.max(first)]);
        let shift = first - directions.first;
        let headings = directions.range.map(|angle| angle + shift);
        self.push(*points, headings, Turns::WithTangent(self.offset));
        self.waiting = self.steps.len();
        self.last_heading = Some(directions.last + shift);
    }

    fn wait(&mut self, points: &[P; 4]) {
        let (headings, turns) = match self.heading {
            Heading::Fixed(heading) => ([heading; 2], Turns::Never),
            Heading::Tangential(_) => ([0.0; 2], Turns::OnTheSpot),
        };
        self.push(*points, headings, turns);
    }

    fn turn_waiting(&mut self, headings: [f64; 2]) {
        let waiting = self.steps[self.waiting..].iter_mut();
        waiting
            .filter(|step| step.turns == Turns::OnTheSpot)
            .for_each(|step| step.headings = headings);
    }

    fn push(&mut self, points: [P; 4], headings: [f64; 2], turns: Turns) {
        let is_apart = std::mem::take(&mut self.is_apart);
        self.steps.push(Drive {
            points,
            headings,
            turns,
            is_apart,
        });
    }
}

/// The same angle from minus to plus half a turn.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
