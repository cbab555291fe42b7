//! Compositing of colors and frames with straight alpha: `over` of Porter and Duff (1984).

use guideway_scene::{Frame, Rgba};

/// Composites every pixel of `frame` over the pixel of `below` at the same position, in place.
pub(crate) fn composite_over(below: &Frame, frame: &mut Frame) {
    for (pixel, &below) in frame.pixels_mut().iter_mut().zip(below.pixels()) {
        *pixel = over(*pixel, below);
    }
}

/// Makes every pixel of a frame more translucent, from opacity 0 to 1.
pub(crate) fn fade(frame: &mut Frame, opacity: f64) {
    if opacity >= 1.0 {
        return;
    }
    for pixel in frame.pixels_mut() {
        let color = Rgba::from_u32(u32::from_be_bytes(*pixel));
        *pixel = color.faded(opacity).to_u32().to_be_bytes();
    }
}

/// Composites a color over another.
pub(crate) fn over(above: [u8; 4], below: [u8; 4]) -> [u8; 4] {
    if above[3] == 255 || below[3] == 0 {
        return above;
    }
    let [a, b] = [above[3], below[3]].map(|alpha| f64::from(alpha) / 255.0);
    let below_share = b * (1.0 - a);
    let alpha = a + below_share;
    let mix = |i: usize| (f64::from(above[i]) * a + f64::from(below[i]) * below_share) / alpha;
    [mix(0), mix(1), mix(2), alpha * 255.0].map(|v| v.round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn over_mixes_by_alpha() {
        assert_eq!(over([1, 2, 3, 255], [9, 9, 9, 255]), [1, 2, 3, 255]);
        assert_eq!(over([1, 2, 3, 0], [9, 8, 7, 255]), [9, 8, 7, 255]);
        assert_eq!(
            over([0, 0, 0, 51], [255, 255, 255, 255]),
            [204, 204, 204, 255]
        );
        assert_eq!(over([5, 5, 5, 0], [9, 9, 9, 0]), [5, 5, 5, 0]);
    }
}
