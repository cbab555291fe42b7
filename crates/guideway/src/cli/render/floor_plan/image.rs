use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use guideway::formats::svg::SvgWriter;
use guideway::render::{Frame, Strip, View};
use guideway::scene::Rgba;
use guideway::spline::{Affine, Bounds, Point};

use crate::cli::Failure;
use crate::cli::input::Input;

/// Most pixels of an image: with all its smaller copies it then takes 360 MB.
const MOST_PIXELS: u64 = 1 << 26;

/// An image on the floor.
pub(crate) struct Image {
    /// The image, and copies of half the size each, down to one pixel: colors times opacity.
    levels: Vec<Level>,
    /// From pixels of the image, y down, to meters.
    world_from_image: Affine,
    px_per_m: f64,
    rotation_rad: f64,
    /// The file itself.
    png: Vec<u8>,
}

struct Level {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 4]>,
}

impl Image {
    pub(super) fn read(input: &Input) -> Result<Self, Failure> {
        let name = input.path.display();
        let Some(px_per_m) = input.px_per_m else {
            return Err(Failure::arguments(
                format!("{name}: how large the image is on the floor is not said"),
                "Say how many of its pixels are a meter, and where its lower left corner is, such as \
                 `hall.png@px-per-m=20,offset=-3,-2`",
            ));
        };
        if input.scale.is_some() {
            return Err(Failure::arguments(
                format!("{name}: an image is scaled by px-per-m alone"),
                "Leave scale out",
            ));
        }
        let first = decode(&input.path).map_err(|problem| Failure {
            code: "image",
            message: format!("{name}: cannot read the image: {problem}"),
            remedy: "Save it again as PNG with at most 67 million pixels".into(),
        })?;
        let height_m = first.height as f64 / px_per_m;
        let rotation_rad = input.rotate_deg.unwrap_or(0.0).to_radians();
        let origin = Point::default();
        let world_from_image = Affine::scale(1.0 / px_per_m, -1.0 / px_per_m, origin)
            .then(Affine::translation(Point::new(0.0, height_m)))
            .then(Affine::rotation(rotation_rad, origin))
            .then(Affine::translation(input.offset_m.unwrap_or_default()));
        let png = std::fs::read(&input.path).map_err(|problem| Failure {
            code: "image",
            message: format!("{name}: cannot read the image: {problem}"),
            remedy: "Check that you may read the file".into(),
        })?;
        let mut levels = vec![first];
        while let Some(next) = levels.last().and_then(Level::half) {
            levels.push(next);
        }
        Ok(Self {
            levels,
            world_from_image,
            px_per_m,
            rotation_rad,
            png,
        })
    }

    /// Width and height in pixels.
    fn size(&self) -> Point<f64> {
        Point::new(self.levels[0].width as f64, self.levels[0].height as f64)
    }

    pub(super) fn bounds(&self) -> Bounds<f64> {
        let size = self.size();
        let corner = |x: f64, y: f64| {
            let at = self
                .world_from_image
                .apply(Point::new(x * size.x, y * size.y));
            Bounds { min: at, max: at }
        };
        let others = [corner(1.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0)];
        others.into_iter().fold(corner(0.0, 0.0), Bounds::union)
    }

    pub(super) fn draw(&self, strip: &Strip, background: Rgba, frame: &mut Frame) {
        let view = strip.view();
        // A pixel of the picture is the mean of what it covers of the image: a copy of about its size has it.
        let image_px_per_px = self.px_per_m / view.px_per_m();
        let index = (image_px_per_px.log2().round().max(0.0) as usize).min(self.levels.len() - 1);
        let (level, whole) = (&self.levels[index], &self.levels[0]);
        let shrunk = Point::new(
            level.width as f64 / whole.width as f64,
            level.height as f64 / whole.height as f64,
        );
        let below = background.to_u32().to_be_bytes();
        let origin = self.world_from_image.origin;
        let back = Affine::rotation(-self.rotation_rad, Point::default());
        let width = view.size().width() as usize;
        let rows = frame.pixels_mut().chunks_exact_mut(width);
        for (row, pixels) in strip.rows().zip(rows) {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let at = Point::new(column as f64 + 0.5, f64::from(row) + 0.5);
                let from_corner = back.apply(view.world_from_pixel(at) - origin) * self.px_per_m;
                let sample = level.sample(from_corner.x * shrunk.x, -from_corner.y * shrunk.y);
                *pixel = super::over(straight(sample), below);
            }
        }
    }

    pub(super) fn write(
        &self,
        view: &View,
        page: &mut SvgWriter<'_, impl Write>,
    ) -> io::Result<()> {
        let size = self.size();
        let on_page = |x: f64, y: f64| {
            view.pixel_from_world(
                self.world_from_image
                    .apply(Point::new(x * size.x, y * size.y)),
            )
        };
        let corner = on_page(0.0, 0.0);
        let (right, down) = (on_page(1.0, 0.0) - corner, on_page(0.0, 1.0) - corner);
        let data = format!("data:image/png;base64,{}", STANDARD.encode(&self.png));
        page.image(
            [right.x, right.y, down.x, down.y, corner.x, corner.y],
            &data,
        )
    }
}

impl Level {
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

    /// The pixel nearest to a place.
    fn pixel(&self, x: i64, y: i64) -> [u8; 4] {
        let x = x.clamp(0, self.width as i64 - 1) as usize;
        let y = y.clamp(0, self.height as i64 - 1) as usize;
        self.pixels[y * self.width + x]
    }

    /// The color between the four pixels around a place; nothing outside of the image.
    fn sample(&self, x: f64, y: f64) -> [f64; 4] {
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

/// From a color times its opacity to straight alpha.
fn straight([r, g, b, alpha]: [f64; 4]) -> [u8; 4] {
    if alpha <= 0.0 {
        return [0; 4];
    }
    let whole = |v: f64| (v * 255.0 / alpha).round().min(255.0) as u8;
    [whole(r), whole(g), whole(b), alpha.round() as u8]
}

fn decode(path: &Path) -> Result<Level, String> {
    let file = File::open(path).map_err(|e| e.to_string())?;
    let limits = png::Limits {
        bytes: 4 * MOST_PIXELS as usize,
    };
    let mut decoder = png::Decoder::new_with_limits(BufReader::new(file), limits);
    decoder.set_transformations(
        png::Transformations::normalize_to_color8() | png::Transformations::ALPHA,
    );
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let (width, height) = (reader.info().width, reader.info().height);
    let count = u64::from(width) * u64::from(height);
    if count > MOST_PIXELS {
        return Err(format!("{width} x {height} pixels, {MOST_PIXELS} at most"));
    }
    let bytes = reader.output_buffer_size().ok_or("it is too large")?;
    let mut bytes = vec![0; bytes];
    let info = reader.next_frame(&mut bytes).map_err(|e| e.to_string())?;
    let pixel = |p: &[u8]| {
        let [r, g, b, a] = match *p {
            [gray, alpha] => [gray, gray, gray, alpha],
            [r, g, b, a] => [r, g, b, a],
            _ => [0; 4],
        };
        let part = |v: u8| (u32::from(v) * u32::from(a) + 127).div_euclid(255) as u8;
        [part(r), part(g), part(b), a]
    };
    let pixels = bytes[..info.buffer_size()].chunks_exact(info.color_type.samples());
    Ok(Level {
        width: width as usize,
        height: height as usize,
        pixels: pixels.map(pixel).collect(),
    })
}

#[cfg(test)]
mod tests {
    use guideway::render::FrameSize;

    use super::*;

    /// Two by two pixels of a meter each: red, green, blue and white from the upper left, at (10, 20).
    fn image(rotate_deg: f64) -> Image {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let mut frame = Frame::new(FrameSize::new(2, 2).unwrap());
        let colors = [
            [255, 0, 0, 255],
            [0, 255, 0, 255],
            [0, 0, 255, 255],
            [255; 4],
        ];
        frame.pixels_mut().copy_from_slice(&colors);
        guideway::save_png(&frame, &path).unwrap();
        let input = Input {
            path,
            px_per_m: Some(1.0),
            rotate_deg: Some(rotate_deg),
            offset_m: Some(Point::new(10.0, 20.0)),
            scale: None,
        };
        Image::read(&input).unwrap()
    }

    fn color_at(image: &Image, x: f64, y: f64) -> [u8; 4] {
        let size = FrameSize::new(1, 1).unwrap();
        let view = View::new(size, Point::new(x, y), 8.0).unwrap();
        let mut frame = Frame::new(size);
        image.draw(&Strip::whole(&view), Rgba::BLACK, &mut frame);
        frame.pixels()[0]
    }

    #[test]
    fn the_lower_left_corner_is_where_it_was_put() {
        let image = image(0.0);
        assert_eq!(image.bounds().min, Point::new(10.0, 20.0));
        assert_eq!(image.bounds().max, Point::new(12.0, 22.0));
        assert_eq!(color_at(&image, 10.5, 20.5), [0, 0, 255, 255]);
        assert_eq!(color_at(&image, 10.5, 21.5), [255, 0, 0, 255]);
        assert_eq!(color_at(&image, 11.5, 20.5), [255; 4]);
        assert_eq!(color_at(&image, 9.9, 20.5), [0, 0, 0, 255]);
    }

    #[test]
    fn it_turns_about_that_corner() {
        let image = image(90.0);
        // What was to the right is now above, what was above is to the left.
        assert_eq!(color_at(&image, 9.5, 20.5), [0, 0, 255, 255]);
        assert_eq!(color_at(&image, 9.5, 21.5), [255; 4]);
        assert_eq!(color_at(&image, 8.5, 20.5), [255, 0, 0, 255]);
    }

    #[test]
    fn from_afar_it_is_its_mean() {
        let image = image(0.0);
        let size = FrameSize::new(1, 1).unwrap();
        let view = View::new(size, Point::new(11.0, 21.0), 0.5).unwrap();
        let mut frame = Frame::new(size);
        image.draw(&Strip::whole(&view), Rgba::BLACK, &mut frame);
        assert_eq!(frame.pixels()[0], [128, 128, 128, 255]);
    }
}
