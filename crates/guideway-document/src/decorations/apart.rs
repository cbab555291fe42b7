use std::collections::HashMap;

use guideway_spline::Point;

/// Places that are not too near to each other.
pub(super) struct Apart {
    least_px: f64,
    /// By cells as wide as the distance, so that what is too near is in a cell or beside it.
    cells: HashMap<(i64, i64), Vec<Point<f64>>>,
}

impl Apart {
    pub(super) fn new(least_px: f64) -> Self {
        Self {
            least_px,
            cells: HashMap::new(),
        }
    }

    /// Takes a place unless it is nearer than that to one that was taken.
    pub(super) fn take(&mut self, at_px: Point<f64>) -> bool {
        let cell = |v: f64| (v / self.least_px).floor() as i64;
        let (column, row) = (cell(at_px.x), cell(at_px.y));
        let beside = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (column + x, row + y)));
        let mut near = beside.filter_map(|cell| self.cells.get(&cell)).flatten();
        let is_free = near.all(|other| other.distance(at_px) >= self.least_px);
        if is_free {
            self.cells.entry((column, row)).or_default().push(at_px);
        }
        is_free
    }
}

/// Whether symbols at these places are so near to each other that they hide what they are of: of those that are to be told
/// apart, fewer than two thirds are twice as far from each other. Those at one place are of several levels, and count once.
pub(super) fn is_crowded(places_px: &[Point<f64>], least_px: f64) -> bool {
    let (mut near, mut far) = (Apart::new(least_px), Apart::new(2.0 * least_px));
    let places_px = places_px.iter().copied();
    let apart: Vec<_> = places_px.filter(|at_px| near.take(*at_px)).collect();
    let far_apart = apart.iter().filter(|at_px| far.take(**at_px)).count();
    3 * far_apart < 2 * apart.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step_px: f64) -> impl Iterator<Item = Point<f64>> {
        (0..30).map(move |i| Point::new(f64::from(i) * step_px, -1.0))
    }

    #[test]
    fn places_are_taken_if_none_is_near() {
        let mut apart = Apart::new(8.0);
        let taken: Vec<bool> = row(3.0).map(|at| apart.take(at)).collect();
        // One in three, wherever cells begin.
        assert!(taken.chunks(3).all(|three| three == [true, false, false]));
    }

    #[test]
    fn a_crowd_is_told_from_a_few() {
        let is_crowded = |places: Vec<_>, least_px| is_crowded(&places, least_px);
        assert!(!is_crowded(row(16.0).collect(), 8.0) && is_crowded(row(12.0).collect(), 8.0));
        let with_few_near = row(20.0).chain(row(20.0).take(10).map(|at| at + Point::new(9.0, 0.0)));
        assert!(!is_crowded(with_few_near.collect(), 8.0));
        let on_two_levels = row(20.0).chain(row(20.0));
        assert!(!is_crowded(on_two_levels.collect(), 8.0));
        assert!(!is_crowded(Vec::new(), 8.0));
    }
}
