//! The place of a picture in the layout: texts inside of a PNG file, and the world file beside it.

use guideway_scene::View;
use guideway_spline::Point;

/// Keywords and values of the text chunks of a PNG file (PNG, third edition, 11.3.3).
pub type PngTexts = Vec<(&'static str, String)>;

/// The texts that say what a picture shows: program, title, bounds in meters and scale.
pub(crate) fn png_texts(view: &View, title: Option<&str>) -> PngTexts {
    let bounds = view.world_bounds();
    let mut texts = vec![
        (
            "Software",
            format!("Guideway {}", env!("CARGO_PKG_VERSION")),
        ),
        (
            "guideway:bounds_m",
            format!(
                "{} {} {} {}",
                bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y
            ),
        ),
        ("guideway:px_per_m", view.px_per_m().to_string()),
    ];
    texts.extend(title.map(|title| ("Title", title.to_owned())));
    texts
}

/// The content of a world file, by which QGIS and other geographic information systems place an
/// image: six lines with the size of a pixel, two rotations, and the center of the upper left
/// pixel, in meters (Esri, "World files for raster datasets").
pub fn world_file(view: &View) -> String {
    let pixel_m = 1.0 / view.px_per_m();
    let corner = view.world_bounds();
    let center = Point::new(corner.min.x + 0.5 * pixel_m, corner.max.y - 0.5 * pixel_m);
    format!(
        "{pixel_m}\n0\n0\n{}\n{}\n{}\n",
        -pixel_m, center.x, center.y
    )
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    #[test]
    fn world_file_maps_pixels_to_their_points() {
        let size = FrameSize::new(40, 20).unwrap();
        let view = View::new(size, Point::new(100.0, -7.0), 8.0).unwrap();
        let text = world_file(&view);
        let numbers: Vec<f64> = text.lines().map(|line| line.parse().unwrap()).collect();
        let [a, d, b, e, c, f] = numbers[..] else {
            panic!("six lines: {text}");
        };
        for pixel in [
            Point::new(0.0, 0.0),
            Point::new(39.0, 19.0),
            Point::new(7.0, 11.0),
        ] {
            let world = Point::new(a * pixel.x + b * pixel.y + c, d * pixel.x + e * pixel.y + f);
            let back = view.pixel_from_world(world);
            let center = pixel + Point::new(0.5, 0.5);
            assert!(back.distance(center) < 1e-9, "{pixel:?}: {back:?}");
        }
    }
}
