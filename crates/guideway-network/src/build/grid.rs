//! [`Grid`]: points by square cells, to find those near another point.

use std::collections::HashMap;

use guideway_spline::Point;

/// Points in square cells; each cell is a linked list.
pub(super) struct Grid {
    cell_m: f64,
    heads: HashMap<(i64, i64), u32>,
    points: Vec<Point<f64>>,
    next: Vec<u32>,
}

/// End of a linked list.
const NONE: u32 = u32::MAX;

impl Grid {
    /// An empty grid for searches within `reach_m`.
    pub(super) fn new(reach_m: f64, points: usize) -> Self {
        Self {
            cell_m: reach_m,
            heads: HashMap::with_capacity(points),
            points: Vec::with_capacity(points),
            next: Vec::with_capacity(points),
        }
    }

    fn cell(&self, p: Point<f64>) -> (i64, i64) {
        let index = |v: f64| (v / self.cell_m).floor() as i64;
        (index(p.x), index(p.y))
    }

    /// Adds a point, whose row is the number of points before.
    pub(super) fn add(&mut self, point: Point<f64>) {
        let row = self.points.len() as u32;
        let cell = self.cell(point);
        let before = self.heads.insert(cell, row).unwrap_or(NONE);
        self.points.push(point);
        self.next.push(before);
    }

    /// Rows and distances of the points within the reach of the grid.
    pub(super) fn near(&self, to: Point<f64>) -> impl Iterator<Item = (u32, f64)> {
        let (x, y) = self.cell(to);
        let cells = (-1..=1).flat_map(move |dx| {
            (-1..=1).map(move |dy| (x.saturating_add(dx), y.saturating_add(dy)))
        });
        let rows = cells.flat_map(move |cell| {
            let mut row = self.heads.get(&cell).copied().unwrap_or(NONE);
            std::iter::from_fn(move || {
                let found = (row != NONE).then_some(row)?;
                row = self.next[found as usize];
                Some(found)
            })
        });
        let with_distance = rows.map(move |row| (row, self.points[row as usize].distance(to)));
        with_distance.filter(|(_, distance_m)| *distance_m <= self.cell_m)
    }
}
