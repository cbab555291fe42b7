//! Places an image on the floor and resamples it for a strip of a view.

use std::borrow::Cow;
use std::io;
use std::path::Path;
use std::sync::Arc;

use guideway_formats::ReadOptions;
use guideway_formats::raster::{self, ImagePlacement, Raster};
use guideway_formats::ros_map::OccupancyGrid;
use guideway_png::encode_png;
use guideway_scene::{Frame, Rgba, Strip, View};
use guideway_spline::{Affine, Bounds, Point};

use super::map_colors;
use super::mip_levels::{MipLevel, levels, unpremultiply};
use crate::ImageError;
use crate::blend::over;
use crate::page::{Page, PageImage};

/// An image that lies on the floor.
pub struct Image {
    /// The image and its smaller copies, the largest first; at least one.
    levels: Arc<[MipLevel]>,
    /// True if light and dark are exchanged.
    is_negative: bool,
    /// Maps pixels of the image, y down, to meters.
    world_from_image: Affine,
    px_per_m: f64,
    rotation_rad: f64,
    /// The bytes of a PNG file, for SVG; `None` for an image from another source.
    png: Option<Vec<u8>>,
}

/// Least mean of each color of paper.
const PAPER: u8 = 170;

/// A color with its lightness exchanged: white becomes black, red stays.
fn negative([r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let ends = i16::from(r.max(g).max(b)) + i16::from(r.min(g).min(b));
    let exchanged = |c: u8| (i16::from(c) + 255 - ends) as u8;
    [exchanged(r), exchanged(g), exchanged(b), a]
}

impl Image {
    /// Places an image.
    pub fn new(image: Raster, placement: &ImagePlacement) -> Self {
        Self {
            levels: levels(&image).into(),
            is_negative: false,
            world_from_image: placement.world_from_image(image.height),
            px_per_m: placement.px_per_m,
            rotation_rad: placement.rotate_deg.to_radians(),
            png: image.png,
        }
    }

    /// Reads a PNG, JPEG, PBM, PGM or PPM image of at most 67 million pixels.
    ///
    /// # Errors
    /// When the file cannot be read, is damaged, or has too many pixels.
    pub fn read(path: &Path, placement: &ImagePlacement) -> Result<Self, ImageError> {
        let image = raster::read_file(path, &ReadOptions::default())?;
        Ok(Self::new(image, placement))
    }

    /// The image of a ROS map: walls dark, free cells white, unknown ones a translucent gray.
    pub fn from_map(grid: &OccupancyGrid) -> Self {
        Self::new(map_colors::image_of(grid), &grid.placement)
    }

    /// Returns `true` if the image is mostly light, as a drawing on paper is.
    pub fn is_paper(&self) -> bool {
        let mean = self
            .levels
            .last()
            .and_then(|level| level.straight_pixels().next());
        mean.is_some_and(|[r, g, b, a]| a > 127 && r.min(g).min(b) > PAPER)
    }

    /// The same image with light and dark exchanged, for a dark background: hues stay, and the
    /// pixels are shared.
    pub fn negative(&self) -> Self {
        Self {
            levels: Arc::clone(&self.levels),
            is_negative: !self.is_negative,
            png: None,
            ..*self
        }
    }

    fn shown(&self, color: [u8; 4]) -> [u8; 4] {
        match self.is_negative {
            true => negative(color),
            false => color,
        }
    }

    /// The bytes of a PNG file with the pixels of the image.
    ///
    /// # Errors
    /// When the memory does not take them.
    pub fn png(&self) -> io::Result<Cow<'_, [u8]>> {
        match &self.png {
            Some(png) => Ok(Cow::Borrowed(png)),
            None => Ok(Cow::Owned(encode_png(self.size_px(), self.pixels())?)),
        }
    }

    /// Width and height in pixels.
    fn size(&self) -> Point<f64> {
        Point::new(self.levels[0].width as f64, self.levels[0].height as f64)
    }

    /// Bounding box in meters.
    pub fn bounds(&self) -> Bounds<f64> {
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

    /// Draws the image over `background` into a frame of the strip's size.
    pub(super) fn draw(&self, strip: &Strip, background: Rgba, frame: &mut Frame) {
        let view = strip.view();
        // The level whose pixels are nearest in size to those of the picture: its pixels are means
        // of what a pixel of the picture covers.
        let image_px_per_px = self.px_per_m / view.px_per_m();
        let index = (image_px_per_px.log2().round().max(0.0) as usize).min(self.levels.len() - 1);
        let (level, whole) = (&self.levels[index], &self.levels[0]);
        let level_scale = Point::new(
            level.width as f64 / whole.width as f64,
            level.height as f64 / whole.height as f64,
        );
        let below = background.to_u32().to_be_bytes();
        let origin = self.world_from_image.origin;
        let unrotate = Affine::rotation(-self.rotation_rad, Point::default());
        let width = view.size().width() as usize;
        let rows = frame.pixels_mut().chunks_exact_mut(width);
        for (row, pixels) in strip.rows().zip(rows) {
            for (column, pixel) in pixels.iter_mut().enumerate() {
                let at = Point::new(column as f64 + 0.5, f64::from(row) + 0.5);
                let from_corner =
                    unrotate.apply(view.world_from_pixel(at) - origin) * self.px_per_m;
                let sample = level.sample(
                    from_corner.x * level_scale.x,
                    -from_corner.y * level_scale.y,
                );
                *pixel = over(self.shown(unpremultiply(sample)), below);
            }
        }
    }

    /// Writes the image as an element of a page.
    pub(super) fn write(&self, view: &View, page: &mut impl Page) -> io::Result<()> {
        let size = self.size();
        let on_page = |x: f64, y: f64| {
            view.pixel_from_world(
                self.world_from_image
                    .apply(Point::new(x * size.x, y * size.y)),
            )
        };
        let corner = on_page(0.0, 0.0);
        let (right, down) = (on_page(1.0, 0.0) - corner, on_page(0.0, 1.0) - corner);
        page.image([right.x, right.y, down.x, down.y, corner.x, corner.y], self)
    }
}

impl PageImage for Image {
    fn png(&self) -> io::Result<Cow<'_, [u8]>> {
        self.png()
    }

    fn size_px(&self) -> [u32; 2] {
        [self.levels[0].width as u32, self.levels[0].height as u32]
    }

    fn pixels(&self) -> impl Iterator<Item = [u8; 4]> {
        let pixels = self.levels[0].straight_pixels();
        pixels.map(|color| self.shown(color))
    }
}

#[cfg(test)]
mod tests {
    use guideway_formats::ros_map::{OCCUPIED, UNKNOWN};
    use guideway_formats::svg::{Stroke, SvgWriter};
    use guideway_scene::FrameSize;

    use super::*;
    use crate::save_png;

    fn placement(rotate_deg: f64) -> ImagePlacement {
        ImagePlacement {
            px_per_m: 1.0,
            rotate_deg,
            offset_m: Point::new(10.0, 20.0),
        }
    }

    /// 2 x 2 pixels of 1 m: red, green, blue, white from the upper left; lower left at (10, 20).
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
        save_png(&frame, &path).unwrap();
        Image::read(&path, &placement(rotate_deg)).unwrap()
    }

    fn color_at(image: &Image, x: f64, y: f64, px_per_m: f64) -> [u8; 4] {
        let size = FrameSize::new(1, 1).unwrap();
        let view = View::new(size, Point::new(x, y), px_per_m).unwrap();
        let mut frame = Frame::new(size);
        image.draw(&Strip::whole(&view), Rgba::BLACK, &mut frame);
        frame.pixels()[0]
    }

    #[test]
    fn offset_places_lower_left_corner() {
        let image = image(0.0);
        assert_eq!(image.bounds().min, Point::new(10.0, 20.0));
        assert_eq!(image.bounds().max, Point::new(12.0, 22.0));
        assert_eq!(color_at(&image, 10.5, 20.5, 8.0), [0, 0, 255, 255]);
        assert_eq!(color_at(&image, 10.5, 21.5, 8.0), [255, 0, 0, 255]);
        assert_eq!(color_at(&image, 11.5, 20.5, 8.0), [255; 4]);
        assert_eq!(color_at(&image, 9.9, 20.5, 8.0), [0, 0, 0, 255]);
    }

    #[test]
    fn negative_exchanges_light_and_dark_and_keeps_hues() {
        let image = image(0.0);
        assert!(!image.is_paper());
        let dark = image.negative();
        assert_eq!(color_at(&dark, 11.5, 20.5, 8.0), [0, 0, 0, 255], "white");
        assert_eq!(color_at(&dark, 10.5, 20.5, 8.0), [0, 0, 255, 255], "blue");
        assert_eq!(dark.pixels().next(), Some([255, 0, 0, 255]), "red");
        assert_eq!(negative([10, 20, 200, 7]), [55, 65, 245, 7]);
        let twice = dark.negative();
        assert_eq!(color_at(&twice, 11.5, 20.5, 8.0), [255; 4]);
        let white = Raster {
            width: 3,
            height: 1,
            pixels: vec![[255; 4], [0, 0, 0, 255], [255; 4]],
            has_alpha: false,
            png: None,
        };
        assert!(Image::new(white, &placement(0.0)).is_paper());
    }

    #[test]
    fn rotation_is_about_lower_left_corner() {
        let image = image(90.0);
        assert_eq!(color_at(&image, 9.5, 20.5, 8.0), [0, 0, 255, 255]);
        assert_eq!(color_at(&image, 9.5, 21.5, 8.0), [255; 4]);
        assert_eq!(color_at(&image, 8.5, 20.5, 8.0), [255, 0, 0, 255]);
    }

    #[test]
    fn reduced_image_is_its_mean() {
        let image = image(0.0);
        assert_eq!(color_at(&image, 11.0, 21.0, 0.5), [128, 128, 128, 255]);
    }

    #[test]
    fn map_lies_at_its_origin_turned_by_its_yaw() {
        let grid = OccupancyGrid {
            name: "map.yaml".into(),
            image: "map.pgm".into(),
            width: 2,
            height: 2,
            // Free and unknown above wall and free.
            cells: vec![0, UNKNOWN, OCCUPIED, 0],
            placement: placement(90.0),
        };
        let image = Image::from_map(&grid);
        let on_black = |x, y| color_at(&image, x, y, 8.0);
        assert_eq!(on_black(9.5, 20.5), [75, 85, 99, 255]);
        assert_eq!(on_black(9.5, 21.5), [255; 4]);
        assert_eq!(on_black(8.5, 20.5), [255; 4]);
        assert_eq!(on_black(8.5, 21.5), [32, 32, 32, 255]);
        let mut svg = Vec::new();
        let size = FrameSize::new(4, 4).unwrap();
        let view = View::new(size, Point::new(9.0, 21.0), 1.0).unwrap();
        let (frame, stroke) = ([0.0, 0.0, 4.0, 4.0], Stroke::new(0, 1.0));
        let mut page = SvgWriter::begin(&mut svg, frame, "", &stroke).unwrap();
        image.write(&view, &mut page).unwrap();
        page.finish().unwrap();
        assert!(
            String::from_utf8(svg)
                .unwrap()
                .contains("base64,iVBORw0KGgo")
        );
    }
}
