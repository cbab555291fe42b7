use crate::{Bounds, Point};

/// Where a point of a box is along a curve that keeps neighbours together (Morton 1966). The longer side of the box
/// is divided into 65,535 steps; a point outside is taken to its border.
pub fn morton(point: Point<f64>, bounds: Bounds<f64>) -> u32 {
    let size = bounds.size();
    let per_m = f64::from(u16::MAX) / size.x.max(size.y).max(f64::MIN_POSITIVE);
    let place = (point - bounds.min) * per_m;
    // A float beyond the range becomes its nearest end.
    spread(place.x as u16) | spread(place.y as u16) << 1
}

/// A zero after each bit.
fn spread(value: u16) -> u32 {
    let mut bits = u32::from(value);
    for (shift, mask) in [
        (8, 0x00ff_00ff),
        (4, 0x0f0f_0f0f),
        (2, 0x3333_3333),
        (1, 0x5555_5555),
    ] {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread() {
        assert_eq!(spread(0), 0);
        assert_eq!(spread(0b1011), 0b100_0101);
        assert_eq!(spread(u16::MAX), 0x5555_5555);
    }
}
