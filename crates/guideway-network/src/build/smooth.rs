//! Smooth: joins short lines that follow each other, and replaces their chains by curves.
//!
//! ```text
//!   o--o              short: the turn at an end times the length is at most 8 times the tolerance,
//!       `o-.           the height of the arc that the line replaces
//!           `o
//! ```

use std::collections::HashMap;

use guideway_spline::Point;
use guideway_spline::bezier::{
    Bezier, SAME_M, angle_rad, end_direction, is_line, reversed, start_direction,
};

use super::BuildReport;
use super::drawn::{Curve, Drawn};
use super::fit::fit;

/// Largest turn from line to line within a curve, in radians: 30 degrees. A chain with sharper
/// turns has corners.
const LARGEST_TURN_RAD: f64 = std::f64::consts::FRAC_PI_6;

pub(super) fn smooth(drawn: &mut Drawn, tolerance_m: f64, report: &mut BuildReport) {
    join_chains(drawn, tolerance_m);
    for curve in &mut drawn.curves {
        smooth_curve(curve, tolerance_m, report);
    }
}

/// Returns `true` if two cubics are lines of one chain, the second one after the first one.
fn follow(a: &Bezier, b: &Bezier, tolerance_m: f64) -> bool {
    let (Some(from), Some(to)) = (end_direction(a), start_direction(b)) else {
        return false;
    };
    let turn_rad = angle_rad(from, to);
    let shorter_m = a[0].distance(a[3]).min(b[0].distance(b[3]));
    turn_rad <= LARGEST_TURN_RAD
        && shorter_m * turn_rad <= 8.0 * tolerance_m
        && is_line(a)
        && is_line(b)
}

/// Joins curves whose ends meet at a place where no third one ends.
fn join_chains(drawn: &mut Drawn, tolerance_m: f64) {
    let curves = &drawn.curves;
    let mut places: HashMap<_, Vec<u32>> = HashMap::with_capacity(curves.len());
    let cell = |v: f64| (v / SAME_M).round() as i64;
    for end in 0..2 * curves.len() as u32 {
        let curve = &curves[end as usize / 2];
        let p = curve.end(end % 2);
        let ends = places
            .entry((cell(p.x), cell(p.y), curve.level))
            .or_default();
        if ends.len() < 3 {
            ends.push(end);
        }
    }
    let mut partner = vec![None; 2 * curves.len()];
    for ends in places.values() {
        let &[a, b] = ends.as_slice() else { continue };
        let (first, second) = (&curves[a as usize / 2], &curves[b as usize / 2]);
        // Both from the end of one line to the start of the other one.
        let last = outward(first, a);
        let next = reversed(&outward(second, b));
        if a / 2 != b / 2 && first.rule == second.rule && follow(&last, &next, tolerance_m) {
            partner[a as usize] = Some(b);
            partner[b as usize] = Some(a);
        }
    }
    let mut is_done = vec![false; curves.len()];
    let mut joined = Vec::with_capacity(curves.len());
    // Chains with two ends first; what remains are rings.
    for rings in [false, true] {
        for row in 0..curves.len() as u32 {
            let start = (0..2).find(|side| partner[(2 * row + side) as usize].is_none());
            let entry = if rings { Some(0) } else { start };
            if let (false, Some(side)) = (is_done[row as usize], entry) {
                joined.push(chain(curves, &partner, 2 * row + side, &mut is_done));
            }
        }
    }
    joined.sort_by_key(|curve| curve.source);
    drawn.curves = joined;
}

/// The cubic at an end of a curve, directed out of the curve.
fn outward(curve: &Curve, end: u32) -> Bezier {
    match end % 2 {
        0 => reversed(&curve.beziers[0]),
        _ => curve.beziers[curve.beziers.len() - 1],
    }
}

/// The chain that begins at an end of a curve.
fn chain(curves: &[Curve], partner: &[Option<u32>], mut entry: u32, is_done: &mut [bool]) -> Curve {
    let first = &curves[entry as usize / 2];
    let mut chain = Curve {
        beziers: Vec::new(),
        is_changed: true,
        ..*first
    };
    // As drawn, if it is one curve only.
    if partner[(entry ^ 1) as usize].is_none() {
        is_done[entry as usize / 2] = true;
        return first.clone();
    }
    loop {
        let row = entry as usize / 2;
        if std::mem::replace(&mut is_done[row], true) {
            return chain;
        }
        let beziers = &curves[row].beziers;
        match entry % 2 {
            0 => chain.beziers.extend(beziers),
            _ => chain.beziers.extend(beziers.iter().rev().map(reversed)),
        }
        match partner[(entry ^ 1) as usize] {
            Some(next) => entry = next,
            None => return chain,
        }
    }
}

/// Replaces the chains of lines within one curve.
fn smooth_curve(curve: &mut Curve, tolerance_m: f64, report: &mut BuildReport) {
    let old = std::mem::take(&mut curve.beziers);
    let mut start = 0;
    while start < old.len() {
        let follows = |end: &usize| follow(&old[*end - 1], &old[*end], tolerance_m);
        let end = (start + 1..old.len()).take_while(follows).last();
        let end = end.map_or(start + 1, |last| last + 1);
        let lines = &old[start..end];
        let mut fitted = Vec::new();
        if lines.len() > 2 {
            let directions = [
                direction_at(
                    start.checked_sub(1).map(|i| &old[i]),
                    &lines[0],
                    lines.get(1),
                ),
                -direction_at(
                    old.get(end).map(reversed).as_ref(),
                    &reversed(&lines[lines.len() - 1]),
                    Some(&reversed(&lines[lines.len() - 2])),
                ),
            ];
            let mut vertices: Vec<Point<f64>> = lines.iter().map(|line| line[0]).collect();
            vertices.push(lines[lines.len() - 1][3]);
            fit(&vertices, directions, tolerance_m, &mut fitted);
        }
        if !fitted.is_empty() && fitted.len() < lines.len() {
            report.smoothed_lines += lines.len() as u64;
            report.smoothed_curves += fitted.len() as u64;
            curve.is_changed = true;
            curve.beziers.append(&mut fitted);
        } else {
            curve.beziers.extend(lines);
        }
        start = end;
    }
}

/// Direction in which a chain begins: that of what comes before it, if it goes on smoothly, else
/// the one of an arc through its first two lines.
fn direction_at(before: Option<&Bezier>, first: &Bezier, second: Option<&Bezier>) -> Point<f64> {
    let own = start_direction(first).unwrap_or_default();
    if let Some(direction) = before.and_then(end_direction)
        && angle_rad(direction, own) <= LARGEST_TURN_RAD
    {
        return direction;
    }
    let Some(next) = second.and_then(start_direction) else {
        return own;
    };
    // An arc turns by as much again before its first chord as half of that between two chords.
    let half_rad = -0.5 * own.cross(next).atan2(own.dot(next));
    let (sin, cos) = half_rad.sin_cos();
    Point::new(own.x * cos - own.y * sin, own.x * sin + own.y * cos)
}
