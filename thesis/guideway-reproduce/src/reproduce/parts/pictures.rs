//! Draws the pictures of chapter 5 with the grid of the thesis, and encodes them as PNG.

use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use guideway_scene::{Frame, FrameSize, RenderError, Scene, View};

use super::views::{MAGNIFICATIONS, magnified};
use crate::reproduce::deadline::Deadline;
use crate::reproduce::names::{GRID, GRID_HARD};
use crate::reproduce::run::{Picture, Results};
use crate::reproduce::session::Session;
use guideway_bench::Dataset;
use guideway_bench::format::count;

/// One picture of a figure: dataset, method and view.
struct Figure {
    number: &'static str,
    shows: &'static str,
    dataset: Dataset,
    method: &'static str,
    magnification: f64,
    size_px: [u32; 2],
    /// Enlargement of each pixel; an enlarged picture shows only the middle of the view.
    enlarged: u32,
}

impl Figure {
    /// The caption without the method.
    fn caption(&self, paths: usize) -> String {
        let (shows, dataset) = (self.shows, self.dataset.name());
        let (percent, paths) = (self.magnification * 100.0, count(paths as u64));
        format!("{shows}{dataset} at {percent:.0} %, {paths} paths")
    }

    /// The view, with the size before enlargement.
    fn view(&self, scene: &Scene) -> Result<View, RenderError> {
        let [width, height] = self.size_px;
        let whole = magnified(FrameSize::new(width, height)?, scene, self.magnification)?;
        let shown = FrameSize::new(width / self.enlarged, height / self.enlarged)?;
        View::new(shown, whole.center_m(), whole.px_per_m())
    }
}

/// Draws every picture of the page.
pub(crate) fn pictures(
    session: &Session<'_>,
    _: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    for figure in figures() {
        let paths = session.plan.view_paths(figure.dataset);
        let caption = figure.caption(paths);
        let is_it = |p: &Picture| p.figure == figure.number && p.caption.starts_with(&caption);
        if out.pictures.iter().any(is_it) {
            continue;
        }
        session.show_progress(&format!("picture of figure {}", figure.number));
        let scene = session.scene(figure.dataset, paths);
        let view = figure.view(&scene)?;
        if let Some((method, frame)) = draw(session, figure.method, &scene, &view)? {
            out.pictures.push(Picture {
                figure: figure.number.to_owned(),
                caption: format!("{caption}, by {method}"),
                size_px: [view.size().width(), view.size().height()],
                enlarged: figure.enlarged,
                png_base64: STANDARD.encode(png(&frame)),
            });
        }
    }
    Ok(())
}

fn figures() -> Vec<Figure> {
    let whole = |number, dataset| Figure {
        number,
        shows: "",
        dataset,
        method: GRID,
        magnification: MAGNIFICATIONS[0],
        size_px: [960, 540],
        enlarged: 1,
    };
    let zoomed = MAGNIFICATIONS.map(|magnification| Figure {
        magnification,
        size_px: [480, 270],
        ..whole("5.3", Dataset::D1)
    });
    let edges = |number, shows, method, enlarged| Figure {
        shows,
        method,
        magnification: MAGNIFICATIONS[3],
        size_px: [480, 270],
        enlarged,
        ..whole(number, Dataset::D1)
    };
    let mut figures = vec![whole("5.1", Dataset::D1), whole("5.2", Dataset::D2)];
    figures.extend(zoomed);
    for (number, enlarged) in [("5.6", 1), ("5.7", 10)] {
        figures.push(edges(number, "smooth: ", GRID, enlarged));
        figures.push(edges(number, "not smooth: ", GRID_HARD, enlarged));
    }
    figures
}

/// The picture and its method. Falls back to another method of the plan if the wanted one is not
/// planned or does not run, except for pictures of edges without anti-aliasing.
fn draw(
    session: &Session<'_>,
    wanted: &str,
    scene: &Arc<Scene>,
    view: &View,
) -> Result<Option<(String, Frame)>, RenderError> {
    let methods = session.plan.methods.iter().map(String::as_str);
    let has_grid = methods.clone().any(|spec| spec.starts_with(GRID));
    let first = has_grid.then_some(wanted);
    for spec in first
        .into_iter()
        .chain(methods.filter(|_| wanted != GRID_HARD))
    {
        if let Ok(frame) = session.picture(spec, scene, view)? {
            return Ok(Some((spec.to_owned(), frame)));
        }
    }
    Ok(None)
}

/// Encodes a picture as PNG, with one channel if it is gray and opaque.
fn png(frame: &Frame) -> Vec<u8> {
    let is_gray = |&[r, g, b, a]: &[u8; 4]| r == g && g == b && a == 255;
    let (color, bytes): (_, Vec<u8>) = if frame.pixels().iter().all(is_gray) {
        (
            png::ColorType::Grayscale,
            frame.pixels().iter().map(|p| p[0]).collect(),
        )
    } else {
        (png::ColorType::Rgba, frame.bytes().to_vec())
    };
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, frame.size().width(), frame.size().height());
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&bytes))
        .expect("memory takes every picture");
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figure_5_7_is_the_middle_of_figure_5_6() {
        let scene = Dataset::D1.scene(100);
        let views = |number| {
            let own = figures().into_iter().filter(move |f| f.number == number);
            let views = own.map(|figure| figure.view(&scene).unwrap());
            views.collect::<Vec<View>>()
        };
        let (whole, part) = (views("5.6"), views("5.7"));
        assert_eq!((whole.len(), part.len()), (2, 2));
        for (whole, part) in whole.iter().zip(&part) {
            assert_eq!(whole.center_m(), part.center_m());
            assert_eq!(whole.px_per_m(), part.px_per_m());
            assert_eq!((part.size().width(), part.size().height()), (48, 27));
        }
    }

    #[test]
    fn png_preserves_gray_and_colored_pixels() {
        for (pixel, channels) in [([9, 9, 9, 255], 1), ([9, 8, 9, 255], 4), ([9, 9, 9, 8], 4)] {
            let mut frame = Frame::new(FrameSize::new(3, 2).unwrap());
            frame.pixels_mut().fill(pixel);
            let file = png(&frame);
            let mut reader = png::Decoder::new(std::io::Cursor::new(file))
                .read_info()
                .unwrap();
            let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut bytes).unwrap();
            assert_eq!((info.width, info.height), (3, 2));
            assert_eq!(bytes, pixel[..channels].repeat(6));
        }
    }
}
