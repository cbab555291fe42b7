//! [`Costs`]: time along each arc, and the headings at its ends.

use guideway_layout::{Layout, PathRef};
use guideway_spline::{segment_length, uniform};
use rayon::prelude::*;

use super::RouteOptions;
use crate::arcs::{Arc, Arcs, number};
use crate::heading::{End, Headings, least_turn_rad};

/// Parts per cubic whose speeds are limited by their curvature, each by that at its middle.
const PARTS: u32 = 8;

/// Error of lengths in meters.
const LENGTH_M: f64 = 1e-4;

/// Slowest speed in m/s: a limit of zero closes no path.
const SLOWEST: f64 = 1e-3;

/// The cost of an arc.
pub(super) struct Cost {
    pub(super) length_m: f64,
    pub(super) speed_m_s: f64,
    pub(super) drive_s: f64,
    rotation_speed_rad_s: f64,
    start: Heading,
    end: Heading,
    forbids: [bool; 2],
}

/// Headings at one end: none, one in most cases, or several.
enum Heading {
    One(f64),
    Several(Vec<f64>),
}

impl Heading {
    fn of(headings: Vec<f64>) -> Self {
        match headings[..] {
            [one] => Self::One(one),
            _ => Self::Several(headings),
        }
    }

    fn all(&self) -> &[f64] {
        match self {
            Self::One(heading) => std::slice::from_ref(heading),
            Self::Several(headings) => headings,
        }
    }
}

/// Costs of all arcs.
pub(super) struct Costs {
    pub(super) of_arc: Vec<Cost>,
    /// Least time per meter of the straight distance between the ends of an arc, in s/m.
    pub(super) least_s_per_m: f64,
    turn_angle_rad: f64,
}

impl Costs {
    pub(super) fn of(
        layout: &Layout,
        vehicle_type: Option<&str>,
        arcs: &Arcs,
        options: &RouteOptions,
    ) -> Self {
        let limits = Limits {
            layout,
            vehicle_type,
            own_speed: own_speed(layout, vehicle_type),
            options,
        };
        let of_arc: Vec<Cost> = arcs.all.par_iter().map(|&arc| limits.cost(arc)).collect();
        let per_m = arcs.all.iter().zip(&of_arc).map(|(arc, cost)| {
            let nodes = &layout.nodes;
            let chord_m = nodes
                .position_m(arc.from)
                .distance(nodes.position_m(arc.to));
            if chord_m > 0.0 {
                cost.drive_s / chord_m
            } else {
                f64::INFINITY
            }
        });
        let least = per_m.fold(f64::INFINITY, f64::min);
        Self {
            least_s_per_m: if least.is_finite() { least } else { 0.0 },
            of_arc,
            turn_angle_rad: options.turn_angle_rad,
        }
    }

    /// Angle and time of the turn between two arcs; `None` if rotation is forbidden there.
    pub(super) fn turn(&self, from: u32, to: u32) -> Option<(f64, f64)> {
        let (from, to) = (&self.of_arc[from as usize], &self.of_arc[to as usize]);
        let angle_rad = least_turn_rad(from.end.all(), to.start.all());
        if angle_rad <= self.turn_angle_rad {
            return Some((0.0, 0.0));
        }
        let speed = from.rotation_speed_rad_s.min(to.rotation_speed_rad_s);
        let is_rigid = from.forbids[1] && to.forbids[0];
        (!is_rigid).then_some((angle_rad, angle_rad / speed))
    }
}

fn own_speed(layout: &Layout, vehicle_type: Option<&str>) -> Option<f64> {
    let own = layout
        .vehicle_types
        .iter()
        .find(|t| Some(t.id.as_str()) == vehicle_type)?;
    own.attributes.value(0, "maxSpeed")?.number()
}

struct Limits<'a> {
    layout: &'a Layout,
    vehicle_type: Option<&'a str>,
    own_speed: Option<f64>,
    options: &'a RouteOptions,
}

impl Limits<'_> {
    fn cost(&self, arc: Arc) -> Cost {
        let get = |name| number(self.layout, arc.path, self.vehicle_type, name);
        let reverse = get("maxReverseSpeed").filter(|_| arc.is_backward);
        let on_path = reverse.or_else(|| get("maxSpeed"));
        let speed = match (on_path, self.own_speed) {
            (Some(a), Some(b)) => a.min(b),
            (Some(speed), None) | (None, Some(speed)) => speed,
            (None, None) => self.options.speed_m_s,
        };
        let speed = if speed.is_finite() {
            speed.max(SLOWEST)
        } else {
            self.options.speed_m_s
        };
        let rotation = get("maxRotationSpeed").filter(|speed| *speed > 0.0);
        let headings = Headings {
            layout: self.layout,
            vehicle_type: self.vehicle_type,
        };
        let (length_m, drive_s) = self.drive(self.layout.paths.get(arc.path as usize), speed);
        Cost {
            length_m,
            speed_m_s: speed,
            drive_s,
            rotation_speed_rad_s: rotation.unwrap_or(self.options.rotation_speed_rad_s),
            start: Heading::of(headings.of(arc, End::Start)),
            end: Heading::of(headings.of(arc, End::End)),
            forbids: [End::Start, End::End].map(|end| headings.forbids(arc, end)),
        }
    }

    /// Length of a path and the time along it.
    fn drive(&self, path: PathRef<'_>, speed: f64) -> (f64, f64) {
        let (mut length_m, mut time_s) = (0.0, 0.0);
        for segment in path.runs().flat_map(|run| run.segments()) {
            let own_m = segment_length(&segment, LENGTH_M);
            length_m += own_m;
            let Some(limit) = self.options.lateral_acceleration_m_s2 else {
                time_s += own_m / speed;
                continue;
            };
            for part in 0..PARTS {
                let t = (f64::from(part) + 0.5) / f64::from(PARTS);
                let curvature = uniform::curvature(&segment, t).abs();
                let in_bend = (limit / curvature).sqrt();
                let speed = if in_bend.is_finite() {
                    speed.min(in_bend).max(SLOWEST)
                } else {
                    speed
                };
                time_s += own_m / f64::from(PARTS) / speed;
            }
        }
        (length_m, time_s)
    }
}
