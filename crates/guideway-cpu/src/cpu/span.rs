use guideway_spline::Point;

/// Samples along each side of a pixel.
pub(super) const SAMPLES: usize = 16;
/// Pixels along each side of a tile.
pub(super) const TILE_PX: usize = 16;
/// Samples along each side of a tile.
const TILE_SAMPLES: f32 = (TILE_PX * SAMPLES) as f32;

/// How far a sample may lie outside and still count as covered, in samples: a ten-thousandth of a pixel.
/// It makes a border through a row of samples cover that row, as it does in exact arithmetic.
const SLACK: f32 = 1.0 / 512.0;
/// Adding this rounds a small number to the nearest integer, in the low bits of the sum.
const ROUND: f32 = (1 << 23) as f32;

/// A line with round caps, in samples from a tile's upper left corner.
pub(super) struct Capsule {
    /// The end of lesser y.
    upper: Point<f32>,
    /// From there to the other end.
    along: Point<f32>,
    per_row: f32,
    /// Where the left and the right border leave the upper cap.
    left_y: f32,
    right_y: f32,
    radius: f32,
}

/// For each row of samples of one row of pixels, the first sample covered and the one after the last.
pub(super) struct Spans {
    pub(super) first: [u32; SAMPLES],
    pub(super) end: [u32; SAMPLES],
}

impl Capsule {
    /// The capsule around the line from `a` to `b`, all in pixels from the tile's upper left corner.
    #[inline(always)]
    pub(super) fn new(a: Point<f32>, b: Point<f32>, radius_px: f32) -> Self {
        // Level lines go right, so that both cases agree on which end each border leaves.
        let (upper, lower) = if (a.y, a.x) <= (b.y, b.x) {
            (a, b)
        } else {
            (b, a)
        };
        let scale = SAMPLES as f32;
        let (upper, radius) = (upper * scale, radius_px * scale);
        let along = lower * scale - upper;
        let length = along.dot(along).sqrt();
        let lean = if length > 0.0 {
            radius * along.x / length
        } else {
            0.0
        };
        Self {
            upper,
            along,
            per_row: 1.0 / along.y.max(1e-20),
            left_y: upper.y + lean + SLACK,
            right_y: upper.y - lean - SLACK,
            radius,
        }
    }

    /// Rows of the tile's pixels that it may touch.
    #[inline(always)]
    pub(super) fn pixel_rows(&self) -> std::ops::Range<usize> {
        let per_px = 1.0 / SAMPLES as f32;
        let top = (self.upper.y - self.radius) * per_px;
        let bottom = (self.upper.y + self.along.y + self.radius) * per_px;
        // A float below zero becomes 0: that is the clamp to the tile.
        top as usize..((bottom + 1.0) as usize).min(TILE_PX)
    }

    /// The samples covered in one row of the tile's pixels.
    ///
    /// A row of samples cuts the capsule in one interval, for it is convex. Its left end lies on the disc
    /// around one point of the line: an end of the line, or the point whose normal meets the row on the
    /// left border. The clamp finds which. So for the right.
    #[inline(always)]
    pub(super) fn spans(&self, pixel_row: usize) -> Spans {
        let mut spans = Spans {
            first: [0; SAMPLES],
            end: [0; SAMPLES],
        };
        let top = self.upper.y - self.radius - SLACK;
        let bottom = self.upper.y + self.along.y + self.radius + SLACK;
        let first_y = (pixel_row * SAMPLES) as f32 + 0.5;
        for i in 0..SAMPLES {
            let y = first_y + i as f32;
            let (left_x, left) = self.disc_at(y, self.left_y);
            let (right_x, right) = self.disc_at(y, self.right_y);
            let first = round(left_x - left - SLACK);
            let end = round(right_x + right + SLACK);
            spans.first[i] = first;
            spans.end[i] = if y >= top && y <= bottom { end } else { first };
        }
        spans
    }

    /// The centre's x and the half chord at `y` of the disc that holds the border there.
    #[inline(always)]
    fn disc_at(&self, y: f32, border_y: f32) -> (f32, f32) {
        let t = ((y - border_y) * self.per_row).clamp(0.0, 1.0);
        let off = (y - (self.upper.y + t * self.along.y)).abs();
        let square = (self.radius - off) * (self.radius + off);
        let half = if square > 0.0 { square } else { 0.0 }.sqrt();
        (self.upper.x + t * self.along.x, half)
    }
}

/// The nearest whole number of samples within the tile.
#[inline(always)]
fn round(x: f32) -> u32 {
    (x.clamp(0.0, TILE_SAMPLES) + ROUND).to_bits() - ROUND.to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between 0 and 1, the same on every run.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 7_u64;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    fn distance(p: Point<f64>, a: Point<f64>, b: Point<f64>) -> f64 {
        let along = b - a;
        let square = along.dot(along);
        let t = if square > 0.0 {
            ((p - a).dot(along) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        p.distance(a + along * t)
    }

    #[track_caller]
    fn check(a: Point<f32>, b: Point<f32>, radius: f32) {
        let capsule = Capsule::new(a, b, radius);
        let rows = capsule.pixel_rows();
        for y in 0..256 {
            let spans = rows.contains(&(y / 16)).then(|| capsule.spans(y / 16));
            for x in 0..256 {
                let at = Point::new(f64::from(x) + 0.5, y as f64 + 0.5) * (1.0 / 16.0);
                let beyond = distance(at, a.to_f64(), b.to_f64()) - f64::from(radius);
                let covered = spans
                    .as_ref()
                    .is_some_and(|s| (s.first[y % 16]..s.end[y % 16]).contains(&(x as u32)));
                // Within the slack, and a little rounding, either answer is right.
                if beyond.abs() > 5e-4 {
                    assert_eq!(covered, beyond < 0.0, "{a:?} {b:?} {radius} at {at:?}");
                }
            }
        }
    }

    #[test]
    fn spans_hold_the_samples_within_the_radius() {
        let mut next = numbers();
        for i in 0..300 {
            let mut point = || Point::new(next() * 32.0 - 8.0, next() * 32.0 - 8.0);
            let (a, b) = (point(), point());
            check(a, b, [0.01, 0.3, 0.75, 1.5, 6.0, 40.0][i % 6]);
        }
    }

    #[test]
    fn level_upright_and_vanishing_lines_are_no_exceptions() {
        let p = Point::new;
        for radius in [0.05, 0.75, 3.0] {
            check(p(3.1, 8.2), p(12.7, 8.2), radius);
            check(p(12.7, 8.2), p(3.1, 8.2), radius);
            check(p(3.1, 2.2), p(3.1, 12.9), radius);
            check(p(3.1, 2.2), p(3.1, 2.2), radius);
            check(p(3.1, 8.2), p(12.7, 8.200_01), radius);
            check(p(-300.0, 8.2), p(300.0, 8.3), radius);
        }
    }

    #[test]
    fn a_border_through_samples_covers_them() {
        let row = 8.0 + 1.0 / 32.0;
        let spans = Capsule::new(
            Point::new(-9.0, row + 1.0),
            Point::new(30.0, row + 1.0),
            1.0,
        )
        .spans(8);
        assert_eq!((spans.first[0], spans.end[0]), (0, 256));
    }
}
