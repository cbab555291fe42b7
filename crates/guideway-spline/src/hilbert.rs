//! Hilbert curve: maps a point of a box to its index along a curve that fills the box.
//!
//! Points with near indices are near each other in the plane, so sorting by the index groups
//! neighbors. Source: Hilbert 1891. A table resolves four bits of each coordinate per step.
//!
//! ```text
//! order 1     order 2            Each step replaces a cell by the order-1 curve. The lower left
//!             5---6   9--10      copy swaps its axes, the lower right copy swaps and reverses
//!             |   |   |   |      them, and the upper copies keep the orientation.
//! 1---2       4   7---8  11
//! |   |       |           |
//! 0   3       3---2  13--12
//!                 |   |
//!             0---1  14--15
//! ```

use crate::{Bounds, Point};

/// Index of a point along the Hilbert curve of a square grid over `bounds`.
///
/// 65,535 steps divide the longer side of the box. A point outside of it counts as the nearest
/// point of its border.
#[inline]
pub fn hilbert(point: Point<f64>, bounds: Bounds<f64>) -> u32 {
    let size = bounds.size();
    let steps_per_m = f64::from(u16::MAX) / size.x.max(size.y).max(f64::MIN_POSITIVE);
    let cell = (point - bounds.min) * steps_per_m;
    // `as` saturates: a coordinate outside of the range is clamped to it.
    cell_index(cell.x as u16, cell.y as u16)
}

/// Index of a cell of the grid of 65,536 x 65,536 cells.
#[inline]
fn cell_index(x: u16, y: u16) -> u32 {
    let (mut index, mut transition) = (0, 0);
    for shift in (0..u16::BITS).step_by(BITS as usize).rev() {
        let [column, row] = [x, y].map(|v| v >> shift & (SIDE - 1));
        let key = transition & ORIENTATION | column << BITS | row;
        transition = TRANSITIONS[usize::from(key)];
        index = index << (2 * BITS) | u32::from(transition & !ORIENTATION);
    }
    index
}

/// Bits of each coordinate that one table lookup resolves.
const BITS: u32 = 4;
/// Cells per side of the block that one table lookup resolves.
const SIDE: u16 = 1 << BITS;
/// Mask of the orientation in a transition: bit 0 swaps the axes, bit 1 reverses both.
const ORIENTATION: u16 = 3 << (2 * BITS);

/// State machine of the curve. Key: orientation, column, row. Value: orientation inside of that
/// cell, index of the cell along the curve through the block.
static TRANSITIONS: [u16; 4 << (2 * BITS)] = {
    let mut transitions = [0; 4 << (2 * BITS)];
    let mut i = 0;
    while i < transitions.len() {
        let (orientation, column, row) = (i >> (2 * BITS), i >> BITS, i);
        transitions[i] = transition(orientation as u8, column as u8, row as u8);
        i += 1;
    }
    transitions
};

const fn transition(mut orientation: u8, column: u8, row: u8) -> u16 {
    let mut index: u8 = 0;
    let mut bit = BITS;
    while bit > 0 {
        bit -= 1;
        let (mut right, mut upper) = (column >> bit & 1, row >> bit & 1);
        if orientation & 1 == 1 {
            (right, upper) = (upper, right);
        }
        (right, upper) = (right ^ orientation >> 1, upper ^ orientation >> 1);
        // The order-1 curve visits (0, 0), (0, 1), (1, 1), (1, 0).
        index = index << 2 | ((3 * right) ^ upper);
        if upper == 0 {
            orientation ^= 1 | right << 1;
        }
    }
    (orientation as u16) << (2 * BITS) | index as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curve_visits_every_cell_once_and_steps_to_neighbors() {
        // The first indices are those of a small square in the corner of the grid.
        const SIDE: u16 = 256;
        let cells = (0..SIDE).flat_map(|x| (0..SIDE).map(move |y| (cell_index(x, y), x, y)));
        let mut cells: Vec<_> = cells.collect();
        cells.sort_unstable();
        for (index, cell) in (0..).zip(&cells) {
            assert_eq!(cell.0, index);
        }
        for [a, b] in cells.array_windows() {
            assert_eq!(a.1.abs_diff(b.1) + a.2.abs_diff(b.2), 1, "{a:?} {b:?}");
        }
    }

    #[test]
    fn clamps_points_outside_to_the_border() {
        let bounds = Bounds {
            min: Point::new(-1.0, 2.0),
            max: Point::new(9.0, 7.0),
        };
        assert_eq!(hilbert(bounds.min, bounds), 0);
        assert_eq!(hilbert(Point::new(-5.0, -5.0), bounds), 0);
        let corner = hilbert(Point::new(9.0, 2.0), bounds);
        assert_eq!(corner, u32::MAX);
        assert_eq!(hilbert(Point::new(1e9, -1e9), bounds), corner);
    }
}
