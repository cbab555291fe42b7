//! Headings of vehicles at the ends of arcs, and the turns between arcs that rotation rules allow.

use std::f64::consts::{PI, TAU};

use guideway_layout::{Layout, Value};
use guideway_spline::bezier::{end_direction, start_direction};
use guideway_spline::{Point, uniform};

use crate::arcs::{Arc, number, value};

/// Orientations of one path that are considered.
const MAX_ORIENTATIONS: usize = 8;

/// An end of an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum End {
    /// The end at which vehicles enter the arc.
    Start,
    /// The end at which vehicles leave the arc.
    End,
}

/// Headings and rotation rules of one vehicle type.
#[derive(Clone, Copy)]
pub(crate) struct Headings<'a> {
    pub(crate) layout: &'a Layout,
    pub(crate) vehicle_type: Option<&'a str>,
}

impl Headings<'_> {
    /// Direction of travel at an end of an arc; `None` for a path without length.
    fn travel(&self, arc: Arc, end: End) -> Option<Point<f64>> {
        let path = self.layout.paths.get(arc.path as usize);
        let is_first = (end == End::Start) != arc.is_backward;
        let segments = path.runs().flat_map(|run| run.segments());
        let mut curves = segments.map(|segment| uniform::to_bezier(&segment));
        let along = if is_first {
            curves.find_map(|curve| start_direction(&curve))
        } else {
            curves.rev().find_map(|curve| end_direction(&curve))
        }?;
        Some(if arc.is_backward { -along } else { along })
    }

    /// Returns `true` if the orientation of vehicles on an arc is stated.
    pub(crate) fn is_stated(&self, arc: Arc) -> bool {
        let has = |name| value(self.layout, arc.path, self.vehicle_type, name).is_some();
        has("vehicleOrientation") || has("vehicleOrientations")
    }

    /// Headings in radians that a vehicle may have at an end of an arc; empty when any will do.
    pub(crate) fn of(&self, arc: Arc, end: End) -> Vec<f64> {
        let Some(travel) = self.travel(arc, end) else {
            return Vec::new();
        };
        let travel_rad = travel.y.atan2(travel.x);
        let get = |name| value(self.layout, arc.path, self.vehicle_type, name);
        let orientations = match (
            number(
                self.layout,
                arc.path,
                self.vehicle_type,
                "vehicleOrientation",
            ),
            get("vehicleOrientations"),
        ) {
            (Some(orientation), _) => vec![orientation],
            (None, Some(Value::Json(list))) => numbers(list),
            _ => Vec::new(),
        };
        if get("orientationType") == Some(Value::Text("GLOBAL")) && !orientations.is_empty() {
            return orientations;
        }
        // Without an orientation, vehicles drive ahead; against the path also backward.
        let ahead = if orientations.is_empty() {
            vec![0.0]
        } else {
            orientations
        };
        let backward = ahead.iter().filter(|_| arc.is_backward).map(|o| o + PI);
        ahead
            .iter()
            .copied()
            .chain(backward)
            .map(|o| travel_rad + o)
            .collect()
    }

    /// The least turn in radians from the end of an arc to the start of the next one.
    pub(crate) fn turn_rad(&self, from: Arc, to: Arc) -> f64 {
        let (before, after) = (self.of(from, End::End), self.of(to, End::Start));
        least_turn_rad(&before, &after)
    }

    /// Returns `true` if no rotation is permitted at an end of an arc.
    pub(crate) fn forbids(&self, arc: Arc, end: End) -> bool {
        let is_start = (end == End::Start) != arc.is_backward;
        let name = match is_start {
            true => "rotationAtStartNodeAllowed",
            false => "rotationAtEndNodeAllowed",
        };
        value(self.layout, arc.path, self.vehicle_type, name) == Some(Value::Text("NONE"))
    }

    /// Returns `true` if vehicles must not rotate between two arcs.
    pub(crate) fn is_rigid(&self, from: Arc, to: Arc) -> bool {
        self.forbids(from, End::End) && self.forbids(to, End::Start)
    }
}

/// The least turn between two lists of headings; 0 if one is empty.
pub(crate) fn least_turn_rad(before: &[f64], after: &[f64]) -> f64 {
    let turns = before.iter().flat_map(|a| {
        after.iter().map(move |b| {
            let turn = (b - a).rem_euclid(TAU);
            turn.min(TAU - turn)
        })
    });
    let least = turns.fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// The numbers of a JSON list.
fn numbers(list: &str) -> Vec<f64> {
    let inner = list.trim().trim_start_matches('[').trim_end_matches(']');
    let numbers = inner.split(',').filter_map(|part| part.trim().parse().ok());
    numbers.take(MAX_ORIENTATIONS).collect()
}
