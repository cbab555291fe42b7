//! Halos: the coverage of a line of text, grown by a radius in all directions.

use super::rasterize::LinePlace;
use super::shape::ShapedLine;

impl ShapedLine {
    /// Hands every pixel within `radius_px` of the letters and its coverage (0 to 1) to `blend`,
    /// once per pixel.
    ///
    /// Cost: the covered pixels times the area of the halo's disc.
    pub(crate) fn rasterize_halo(
        &self,
        place: &LinePlace,
        radius_px: f64,
        mut blend: impl FnMut(i64, i64, f32),
    ) {
        let mut inked = Vec::new();
        self.rasterize(place, |x, y, coverage| inked.push((x, y, coverage)));
        let reach = radius_px.ceil() as i64;
        let fold = |of: fn(&(i64, i64, f32)) -> i64, pick: fn(i64, i64) -> i64| {
            inked.iter().map(of).reduce(pick).unwrap_or(0)
        };
        let (left, top) = (
            fold(|p| p.0, i64::min) - reach,
            fold(|p| p.1, i64::min) - reach,
        );
        let width = (fold(|p| p.0, i64::max) + reach - left + 1) as usize;
        let height = (fold(|p| p.1, i64::max) + reach - top + 1) as usize;
        let mut grown = vec![0_f32; width * height];
        let disc = disc(radius_px, reach);
        for (x, y, coverage) in inked {
            for &(dx, dy, share) in &disc {
                let at = (y + dy - top) as usize * width + (x + dx - left) as usize;
                grown[at] = grown[at].max(coverage * share);
            }
        }
        for (at, &coverage) in grown.iter().enumerate().filter(|(_, of)| **of > 0.0) {
            blend(
                left + (at % width) as i64,
                top + (at / width) as i64,
                coverage,
            );
        }
    }
}

/// The pixels of a disc around a pixel, with the part of each that it covers.
fn disc(radius_px: f64, reach: i64) -> Vec<(i64, i64, f32)> {
    let offsets = (-reach..=reach).flat_map(|x| (-reach..=reach).map(move |y| (x, y)));
    let share = |(x, y): (i64, i64)| {
        let inside = radius_px + 0.5 - (x as f64).hypot(y as f64);
        (x, y, inside.clamp(0.0, 1.0) as f32)
    };
    offsets
        .map(share)
        .filter(|(.., share)| *share > 0.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use guideway_spline::Point;

    use super::*;

    #[test]
    fn halo_surrounds_the_letters_by_its_radius() {
        let line = ShapedLine::new("I");
        let place = LinePlace {
            left_middle: Point::new(50.0, 50.0),
            angle_rad: 0.0,
            size_px: 40.0,
            max_width_px: 1e9,
        };
        let bounds = |radius_px: f64| {
            let mut bounds = [i64::MAX, i64::MAX, i64::MIN, i64::MIN];
            line.rasterize_halo(&place, radius_px, |x, y, _| {
                let [left, top, right, bottom] = bounds;
                bounds = [left.min(x), top.min(y), right.max(x), bottom.max(y)];
            });
            bounds
        };
        let ([left, top, right, bottom], grown) = (bounds(0.0), bounds(5.0));
        assert_eq!(grown, [left - 5, top - 5, right + 5, bottom + 5]);
    }
}
