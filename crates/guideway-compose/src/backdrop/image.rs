//! Places a PNG image on the floor and resamples it for a strip of a view.

use std::io::{self, Write};
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use guideway_formats::svg::SvgWriter;
use guideway_scene::{Frame, Rgba, Strip, View};
use guideway_spline::{Affine, Bounds, Point};

use super::mip_levels::{MipLevel, read_levels, unpremultiply};
use crate::blend::over;
use crate::{ImageError, ImageProblem};

/// An image that lies on the floor.
pub struct Image {
    /// The image and its smaller copies, the largest first; at least one.
    levels: Vec<MipLevel>,
    /// Maps pixels of the image, y down, to meters.
    world_from_image: Affine,
    px_per_m: f64,
    rotation_rad: f64,
    /// The bytes of the file, for SVG.
    png: Vec<u8>,
}

/// Scale, rotation and position of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImagePlacement {
    /// Pixels of the image per meter.
    pub px_per_m: f64,
    /// Counter-clockwise rotation about the lower left corner, in degrees.
    pub rotate_deg: f64,
    /// Position of the lower left corner, in meters.
    pub offset_m: Point<f64>,
}

impl Image {
    /// Reads a PNG image of at most 67 million pixels.
    ///
    /// # Errors
    /// When the file cannot be read, is not a valid PNG, or has too many pixels.
    pub fn read(path: &Path, placement: &ImagePlacement) -> Result<Self, ImageError> {
        let fail = |problem: ImageProblem| ImageError {
            path: path.to_owned(),
            problem,
        };
        let levels = read_levels(path).map_err(fail)?;
        let png = std::fs::read(path).map_err(|problem| fail(problem.into()))?;
        let ImagePlacement {
            px_per_m,
            rotate_deg,
            offset_m,
        } = *placement;
        let height_m = levels[0].height as f64 / px_per_m;
        let rotation_rad = rotate_deg.to_radians();
        let origin = Point::default();
        let world_from_image = Affine::scale(1.0 / px_per_m, -1.0 / px_per_m, origin)
            .then(Affine::translation(Point::new(0.0, height_m)))
            .then(Affine::rotation(rotation_rad, origin))
            .then(Affine::translation(offset_m));
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
                *pixel = over(unpremultiply(sample), below);
            }
        }
    }

    /// Writes the image as an SVG element that embeds the file.
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

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;
    use crate::save_png;

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
        let placement = ImagePlacement {
            px_per_m: 1.0,
            rotate_deg,
            offset_m: Point::new(10.0, 20.0),
        };
        Image::read(&path, &placement).unwrap()
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
}
