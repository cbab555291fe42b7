//! Crossings of two cubics: halves both until they are straight, then corrects by Newton's method.

use crate::Point;
use crate::bezier::{Bezier, bounds, derivative, is_line, line, point, split};

/// Distance of a control point from its chord below which a part counts as straight, in meters.
const FLAT_M: f64 = 1e-5;

/// Most halvings of one curve.
const MAX_DEPTH: u32 = 40;

/// Steps of Newton's method: each one doubles the digits, and the first guess has five.
const NEWTON_STEPS: u32 = 4;

/// Most crossings of two cubics that are not one curve: Bezout's theorem.
const MAX_FOUND: usize = 9;

/// Most pairs of parts that are compared. Two curves that lie on each other need more.
const MAX_STEPS: u32 = 4096;

/// A place where two curves cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Parameters on both curves.
    pub at: [f64; 2],
    /// The place, in meters: that on the first curve.
    pub position_m: Point<f64>,
}

/// The curves lie on each other, so that they have no single crossings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlap;

/// Appends the places where two curves cross or touch.
///
/// # Errors
/// [`Overlap`] if the curves share a part.
pub fn intersect(a: &Bezier, b: &Bezier, found: &mut Vec<Meeting>) -> Result<(), Overlap> {
    if is_line(a) && is_line(b) {
        found.extend(lines_meet(a, b));
        return Ok(());
    }
    let first = found.len();
    let mut search = Search {
        steps_left: MAX_STEPS,
        first,
        found,
    };
    search.visit(a, (0.0, 1.0), b, (0.0, 1.0), MAX_DEPTH)?;
    found[first..]
        .iter_mut()
        .for_each(|meeting| correct(meeting, a, b));
    Ok(())
}

/// Newton's method for a(s) = b(t). Keeps the meeting where it leads away, as beside a touch.
fn correct(meeting: &mut Meeting, a: &Bezier, b: &Bezier) {
    let gap = |[s, t]: [f64; 2]| point(b, t) - point(a, s);
    let mut at = meeting.at;
    for _ in 0..NEWTON_STEPS {
        let (u, v, offset) = (derivative(a, at[0]), derivative(b, at[1]), gap(at));
        let turn = u.cross(v);
        let step = [offset.cross(v) / turn, offset.cross(u) / turn];
        let next = [0, 1].map(|i| (at[i] + step[i]).clamp(0.0, 1.0));
        // A step that leads away ends the search; NaN compares as false.
        let is_nearer = gap(next).norm() < offset.norm();
        if !is_nearer {
            break;
        }
        at = next;
    }
    *meeting = Meeting {
        at,
        position_m: point(a, at[0]),
    };
}

/// The crossing of the chords of two curves.
fn lines_meet(a: &Bezier, b: &Bezier) -> Option<Meeting> {
    let (u, v, offset) = (a[3] - a[0], b[3] - b[0], b[0] - a[0]);
    let turn = u.cross(v);
    // Parallel lines have no single crossing; their ends are junctions.
    if turn.abs() <= 1e-12 * u.norm() * v.norm() {
        return None;
    }
    let (s, t) = (offset.cross(v) / turn, offset.cross(u) / turn);
    let inside = |t: f64| (-1e-12..=1.0 + 1e-12).contains(&t);
    (inside(s) && inside(t)).then(|| Meeting {
        at: [s.clamp(0.0, 1.0), t.clamp(0.0, 1.0)],
        position_m: a[0].lerp(a[3], s),
    })
}

struct Search<'f> {
    steps_left: u32,
    /// Meetings before this one belong to other pairs.
    first: usize,
    found: &'f mut Vec<Meeting>,
}

impl Search<'_> {
    /// Compares the parts of two curves between parameters.
    fn visit(
        &mut self,
        a: &Bezier,
        (a0, a1): (f64, f64),
        b: &Bezier,
        (b0, b1): (f64, f64),
        depth_left: u32,
    ) -> Result<(), Overlap> {
        if !bounds(a).inflated(1e-12).intersects(bounds(b)) {
            return Ok(());
        }
        self.steps_left = self.steps_left.checked_sub(1).ok_or(Overlap)?;
        let (flat_a, flat_b) = (is_flat(a), is_flat(b));
        if (flat_a && flat_b) || depth_left == 0 {
            if let Some(meeting) = lines_meet(a, b) {
                let [s, t] = meeting.at;
                return self.add(Meeting {
                    at: [a0 + (a1 - a0) * s, b0 + (b1 - b0) * t],
                    position_m: point(a, s),
                });
            }
            return Ok(());
        }
        let (am, bm) = (0.5 * (a0 + a1), 0.5 * (b0 + b1));
        // The longer of two bent parts is halved, so that boxes shrink evenly.
        let size = |c: &Bezier| bounds(c).size();
        let is_longer = size(a).x.max(size(a).y) >= size(b).x.max(size(b).y);
        if !flat_a && (flat_b || is_longer) {
            let [left, right] = split(a, 0.5);
            self.visit(&left, (a0, am), b, (b0, b1), depth_left - 1)?;
            self.visit(&right, (am, a1), b, (b0, b1), depth_left - 1)
        } else {
            let [left, right] = split(b, 0.5);
            self.visit(a, (a0, a1), &left, (b0, bm), depth_left - 1)?;
            self.visit(a, (a0, a1), &right, (bm, b1), depth_left - 1)
        }
    }

    /// Adds a meeting, unless the neighboring part has found it too.
    fn add(&mut self, meeting: Meeting) -> Result<(), Overlap> {
        let own = &self.found[self.first..];
        let is_known = own
            .iter()
            .any(|known| known.position_m.distance(meeting.position_m) < 10.0 * FLAT_M);
        if is_known {
            return Ok(());
        }
        if own.len() == MAX_FOUND {
            return Err(Overlap);
        }
        self.found.push(meeting);
        Ok(())
    }
}

/// Returns `true` if a curve is near its chord at equal parameters, so that parameters of the chord
/// are parameters of the curve.
fn is_flat(b: &Bezier) -> bool {
    let chord = line(b[0], b[3]);
    b[1].distance(chord[1]) <= FLAT_M && b[2].distance(chord[2]) <= FLAT_M
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(ax: f64, ay: f64, bx: f64, by: f64) -> Bezier {
        line(Point::new(ax, ay), Point::new(bx, by))
    }

    #[test]
    fn lines_cross_once_and_parallels_never() {
        let mut found = Vec::new();
        let level = between(0.0, 0.0, 10.0, 0.0);
        intersect(&level, &between(2.0, -2.0, 2.0, 2.0), &mut found).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].at, [0.2, 0.5]);
        intersect(&level, &between(0.0, 1.0, 10.0, 1.0), &mut found).unwrap();
        intersect(&level, &between(3.0, 0.0, 7.0, 0.0), &mut found).unwrap();
        intersect(&level, &between(2.0, 1.0, 2.0, 2.0), &mut found).unwrap();
        assert_eq!(found.len(), 1);
    }

    #[test]
    fn a_wave_crosses_a_line_three_times() {
        let wave = [(0.0, -1.0), (3.0, 8.0), (6.0, -8.0), (9.0, 1.0)];
        let wave = wave.map(|(x, y)| Point::new(x, y));
        let mut found = Vec::new();
        intersect(&wave, &between(-1.0, 0.0, 10.0, 0.0), &mut found).unwrap();
        assert_eq!(found.len(), 3, "{found:?}");
        for meeting in &found {
            assert!(meeting.position_m.y.abs() < 1e-12, "{meeting:?}");
            let on_wave = point(&wave, meeting.at[0]);
            assert!(on_wave.distance(meeting.position_m) < 1e-12);
        }
    }

    #[test]
    fn curves_on_each_other_are_told() {
        let bend = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (4.0, 5.0)];
        let bend = bend.map(|(x, y)| Point::new(x, y));
        let mut found = Vec::new();
        let [left, _] = split(&bend, 0.7);
        assert_eq!(intersect(&bend, &left, &mut found), Err(Overlap));
    }
}
