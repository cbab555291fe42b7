use crate::{Bounds, Point};

/// Where a point of a box is along a curve that fills the plane without a jump, so that what is near each other along it
/// is so in the plane too (Hilbert 1891). The longer side of the box is divided into 65,535 steps; a point outside is
/// taken to its border.
pub fn hilbert(point: Point<f64>, bounds: Bounds<f64>) -> u32 {
    let size = bounds.size();
    let per_m = f64::from(u16::MAX) / size.x.max(size.y).max(f64::MIN_POSITIVE);
    let place = (point - bounds.min) * per_m;
    // A float beyond the range becomes its nearest end.
    along(place.x as u16, place.y as u16)
}

/// The number of a cell of the square of 65,536 cells a side.
fn along(mut x: u16, mut y: u16) -> u32 {
    (0..u16::BITS).rev().fold(0, |along, bit| {
        let [right, upper] = [x, y].map(|v| u32::from(v >> bit & 1));
        // The curve goes up, to the right and down again. Its lower quarters are turned, the right one about.
        if upper == 0 {
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
        along << 2 | ((3 * right) ^ upper)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_passes_every_cell_once_from_neighbour_to_neighbour() {
        // The first cells along the curve are those of a small square in its corner.
        const SIDE: u16 = 64;
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
