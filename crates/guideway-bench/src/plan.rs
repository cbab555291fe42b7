//! A plan of any size, as the tools of a network meet it: streets whose ends miss each other by
//! millimeters, lines that cross them, and lines that end on them.

use guideway_layout::{Attributes, Layout, NewPath, Quantity};
use guideway_spline::{Point, Runs};

/// Length of a street from corner to corner, in meters.
const STREET_M: f64 = 10.0;

/// Largest gap of a plan at a corner, in meters: within the default distance of a weld.
const GAP_M: f64 = 0.003;

/// Columns of [`set_values`].
const COLUMNS: usize = 8;

/// A plan of a number of lines.
pub(crate) fn plan(lines: usize) -> Layout {
    let mut plan = Layout::default();
    let side = (lines as f64 / 2.0).sqrt().ceil().max(1.0) as usize;
    let mut runs = Runs::default();
    let mut add = |row: usize, [start, end]: [[f64; 2]; 2]| {
        if row < lines {
            runs.clear();
            // Each line ends elsewhere, by a third of the gap.
            let gap_m = GAP_M * (row % 3) as f64 / 3.0;
            let point = |[x, y]: [f64; 2]| Point::new(x + gap_m, y);
            runs.push_line(point(start), point(end));
            plan.paths.push(&NewPath {
                id: &format!("{row}"),
                runs: &runs,
                ..NewPath::default()
            });
        }
    };
    for cell in 0..lines.div_ceil(2) {
        let [x, y] = [cell % side, cell / side].map(|i| i as f64 * STREET_M);
        let middle = x + STREET_M / 2.0;
        add(2 * cell, [[x, y], [x + STREET_M, y]]);
        let second = match (cell % side + cell / side) % 4 {
            0 => [[middle, y - 2.0], [middle, y + 2.0]],
            1 => [[middle, y], [middle, y + 4.0]],
            _ => [[x, y], [x, y + STREET_M]],
        };
        add(2 * cell + 1, second);
    }
    plan
}

/// Sets eight values of each path.
pub(crate) fn set_values(attributes: &mut Attributes, paths: usize, value: f64) {
    for column in 0..COLUMNS {
        let name = format!("value{column}");
        for row in 0..paths {
            attributes.set_quantity(row, &name, value + column as f64, Quantity::Length);
        }
    }
}
