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

/// Whether symbols at these places would hide each other, a third of them or more, and what they are of.
pub(super) fn is_crowded(places_px: impl Iterator<Item = Point<f64>>, least_px: f64) -> bool {
    let mut apart = Apart::new(least_px);
    let mut count = [0_usize; 2];
    places_px.for_each(|at_px| count[usize::from(apart.take(at_px))] += 1);
    let [hidden, seen] = count;
    2 * hidden > seen
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
        assert!(!is_crowded(row(8.0), 8.0) && is_crowded(row(3.0), 8.0));
        let few = row(20.0).chain(row(20.0).take(10));
        assert!(!is_crowded(few, 8.0));
        assert!(!is_crowded(std::iter::empty(), 8.0));
    }
}
