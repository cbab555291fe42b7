//! Declutters marks: keeps positions at a minimum distance, and detects crowds.

use std::collections::HashMap;

use guideway_spline::Point;

/// Positions that keep a minimum distance from each other.
pub(super) struct Declutter {
    min_px: f64,
    /// Positions by grid cell. A cell is as wide as the minimum distance, so that conflicts are in
    /// the same cell or a neighbor.
    cells: HashMap<(i64, i64), Vec<Point<f64>>>,
}

impl Declutter {
    pub(super) fn new(min_px: f64) -> Self {
        Self {
            min_px,
            cells: HashMap::new(),
        }
    }

    /// Places a position unless an earlier one is too near. Returns whether it was placed.
    pub(super) fn place(&mut self, at_px: Point<f64>) -> bool {
        let cell = |v: f64| (v / self.min_px).floor() as i64;
        let (column, row) = (cell(at_px.x), cell(at_px.y));
        let neighbors = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (column + x, row + y)));
        let mut near = neighbors.filter_map(|cell| self.cells.get(&cell)).flatten();
        let is_free = near.all(|other| other.distance(at_px) >= self.min_px);
        if is_free {
            self.cells.entry((column, row)).or_default().push(at_px);
        }
        is_free
    }
}

/// Returns `true` if symbols at these positions would hide the paths between them.
///
/// Of the positions at least `min_px` apart, fewer than 2/3 are also at least twice as far apart.
/// Coinciding positions, such as nodes of several levels, count once.
pub(super) fn is_crowded(positions_px: &[Point<f64>], min_px: f64) -> bool {
    let (mut near, mut far) = (Declutter::new(min_px), Declutter::new(2.0 * min_px));
    let positions_px = positions_px.iter().copied();
    let distinct: Vec<_> = positions_px.filter(|at| near.place(*at)).collect();
    let distant = distinct.iter().filter(|at| far.place(**at)).count();
    3 * distant < 2 * distinct.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step_px: f64) -> impl Iterator<Item = Point<f64>> {
        (0..30).map(move |i| Point::new(f64::from(i) * step_px, -1.0))
    }

    #[test]
    fn keeps_positions_at_the_minimum_distance() {
        let mut declutter = Declutter::new(8.0);
        let placed: Vec<bool> = row(3.0).map(|at| declutter.place(at)).collect();
        // One in three, independent of cell borders.
        assert!(placed.chunks(3).all(|three| three == [true, false, false]));
    }

    #[test]
    fn distinguishes_crowds_from_a_few_near_positions() {
        let is_crowded = |positions: Vec<_>, min_px| is_crowded(&positions, min_px);
        assert!(!is_crowded(row(16.0).collect(), 8.0) && is_crowded(row(12.0).collect(), 8.0));
        let with_few_near = row(20.0).chain(row(20.0).take(10).map(|at| at + Point::new(9.0, 0.0)));
        assert!(!is_crowded(with_few_near.collect(), 8.0));
        let on_two_levels = row(20.0).chain(row(20.0));
        assert!(!is_crowded(on_two_levels.collect(), 8.0));
        assert!(!is_crowded(Vec::new(), 8.0));
    }
}
