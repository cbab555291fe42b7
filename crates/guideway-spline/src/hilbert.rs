use crate::{Bounds, Point};

/// Where a point of a box is along a curve that fills the plane without a jump, so that what is near each other along it
/// is so in the plane too (Hilbert 1891). The longer side of the box is divided into 65,535 steps; a point outside is
/// taken to its border.
#[inline]
pub fn hilbert(point: Point<f64>, bounds: Bounds<f64>) -> u32 {
    let size = bounds.size();
    let per_m = f64::from(u16::MAX) / size.x.max(size.y).max(f64::MIN_POSITIVE);
    let place = (point - bounds.min) * per_m;
    // A float beyond the range becomes its nearest end.
    along(place.x as u16, place.y as u16)
}

/// The number of a cell of the square of 65,536 cells a side.
#[inline]
fn along(x: u16, y: u16) -> u32 {
    let (mut along, mut step) = (0, 0);
    for shift in (0..u16::BITS).step_by(BITS as usize).rev() {
        let [right, upper] = [x, y].map(|v| v >> shift & (SIDE - 1));
        let cell = step & TURNS | right << BITS | upper;
        step = STEPS[usize::from(cell)];
        along = along << (2 * BITS) | u32::from(step & !TURNS);
    }
    along
}

/// Bits of each coordinate that are looked at together.
const BITS: u32 = 4;
const SIDE: u16 = 1 << BITS;
/// Which bits of a step say how a square is turned: whether both axes are reversed, and whether they are exchanged.
const TURNS: u16 = 3 << (2 * BITS);

/// For each cell of a square of so many a side, with how that is turned above its place: where the cell is along the curve, below how
/// the square within it is turned.
static STEPS: [u16; 4 << (2 * BITS)] = {
    let mut steps = [0; 4 << (2 * BITS)];
    let mut i = 0;
    while i < steps.len() {
        let (turn, x, y) = (i >> (2 * BITS), i >> BITS, i);
        steps[i] = step(turn as u8, x as u8, y as u8);
        i += 1;
    }
    steps
};

const fn step(mut turn: u8, x: u8, y: u8) -> u16 {
    let mut along: u8 = 0;
    let mut bit = BITS;
    while bit > 0 {
        bit -= 1;
        let (mut right, mut upper) = (x >> bit & 1, y >> bit & 1);
        if turn & 1 == 1 {
            (right, upper) = (upper, right);
        }
        (right, upper) = (right ^ turn >> 1, upper ^ turn >> 1);
        // The curve goes up, to the right and down again. Its lower quarters are turned, the right one about.
        along = along << 2 | ((3 * right) ^ upper);
        if upper == 0 {
            turn ^= 1 | right << 1;
        }
    }
    (turn as u16) << (2 * BITS) | along as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_passes_every_cell_once_from_neighbor_to_neighbor() {
        // The first cells along the curve are those of a small square in its corner.
        const SIDE: u16 = 256;
        let cells = (0..SIDE).flat_map(|x| (0..SIDE).map(move |y| (along(x, y), x, y)));
        let mut cells: Vec<_> = cells.collect();
        cells.sort_unstable();
        for (number, cell) in (0..).zip(&cells) {
            assert_eq!(cell.0, number);
        }
        for [a, b] in cells.array_windows() {
            assert_eq!(a.1.abs_diff(b.1) + a.2.abs_diff(b.2), 1, "{a:?} {b:?}");
        }
    }

    #[test]
    fn points_outside_are_taken_to_the_border() {
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
