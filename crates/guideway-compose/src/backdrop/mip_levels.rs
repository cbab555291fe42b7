//! Mip levels of an image: copies of half the size each, so that a reduced image is a mean.
//!
//! Colors are premultiplied by their opacity, so that transparent pixels do not bleed into a mean.

use guideway_formats::raster::Raster;

/// One level: rows of premultiplied RGBA pixels, the top row first.
pub(super) struct MipLevel {
    pub(super) width: usize,
    pub(super) height: usize,
    pixels: Vec<[u8; 4]>,
}

/// Reduces an image down to one pixel; the first level is the image itself.
pub(super) fn levels(image: &Raster) -> Vec<MipLevel> {
    let mut levels = vec![MipLevel {
        width: image.width,
        height: image.height,
        pixels: image.pixels.iter().map(premultiply).collect(),
    }];
    while let Some(next) = levels.last().and_then(MipLevel::half) {
        levels.push(next);
    }
    levels
}

impl MipLevel {
    /// The next smaller level, whose pixels are means of 2 x 2; `None` for a single pixel.
    fn half(&self) -> Option<Self> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let (width, height) = (self.width.div_ceil(2), self.height.div_ceil(2));
        let mean = |x: usize, y: usize| {
            let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let four = corners.map(|(i, j)| self.pixel(2 * x as i64 + i, 2 * y as i64 + j));
            [0, 1, 2, 3].map(|c| {
                let sum: u32 = four.iter().map(|pixel| u32::from(pixel[c])).sum();
                (sum + 2).div_euclid(4) as u8
            })
        };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Some(Self {
            width,
            height,
            pixels: pixels.map(|(x, y)| mean(x, y)).collect(),
        })
    }

    /// All pixels with straight alpha, the top row first.
    pub(super) fn straight_pixels(&self) -> impl Iterator<Item = [u8; 4]> {
        let pixels = self.pixels.iter();
        pixels.map(|pixel| unpremultiply(pixel.map(f64::from)))
    }

    /// The pixel at a position, clamped to the border.
    fn pixel(&self, x: i64, y: i64) -> [u8; 4] {
        let x = x.clamp(0, self.width as i64 - 1) as usize;
        let y = y.clamp(0, self.height as i64 - 1) as usize;
        self.pixels[y * self.width + x]
    }

    /// The bilinear sample at a position in pixels, y down; transparent outside of the image.
    pub(super) fn sample(&self, x: f64, y: f64) -> [f64; 4] {
        if !(0.0..=self.width as f64).contains(&x) || !(0.0..=self.height as f64).contains(&y) {
            return [0.0; 4];
        }
        let (left, top) = ((x - 0.5).floor(), (y - 0.5).floor());
        let (s, t) = (x - 0.5 - left, y - 0.5 - top);
        let at = |i: i64, j: i64| self.pixel(left as i64 + i, top as i64 + j);
        let corners = [
            (at(0, 0), (1.0 - s) * (1.0 - t)),
            (at(1, 0), s * (1.0 - t)),
            (at(0, 1), (1.0 - s) * t),
            (at(1, 1), s * t),
        ];
        [0, 1, 2, 3].map(|c| {
            corners
                .iter()
                .map(|(p, share)| f64::from(p[c]) * share)
                .sum()
        })
    }
}

/// Converts a color of straight alpha to a premultiplied one.
fn premultiply(&[r, g, b, a]: &[u8; 4]) -> [u8; 4] {
    let premultiplied = |v: u8| (u32::from(v) * u32::from(a) + 127).div_euclid(255) as u8;
    [premultiplied(r), premultiplied(g), premultiplied(b), a]
}

/// Converts a premultiplied color to straight alpha.
pub(super) fn unpremultiply([r, g, b, alpha]: [f64; 4]) -> [u8; 4] {
    if alpha <= 0.0 {
        return [0; 4];
    }
    let whole = |v: f64| (v * 255.0 / alpha).round().min(255.0) as u8;
    [whole(r), whole(g), whole(b), alpha.round() as u8]
}
