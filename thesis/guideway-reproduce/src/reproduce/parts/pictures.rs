//! The pictures of chapter 5, drawn by the thesis' own method.

use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use guideway_scene::Scene;
use guideway_scene::{Frame, FrameSize, RenderError, View};

use super::views::{MAGNIFICATIONS, magnified};
use crate::reproduce::lab::{Deadline, Lab};
use crate::reproduce::names::{GRID, GRID_HARD};
use crate::reproduce::run::{Picture, Results};
use guideway_bench::Dataset;
use guideway_bench::format::count;

/// How a figure is drawn: a part of the dataset so large that it fills the picture.
struct Figure {
    number: &'static str,
    shows: &'static str,
    dataset: Dataset,
    method: &'static str,
    magnification: f64,
    size_px: [u32; 2],
    /// Times that each pixel is enlarged; the picture then shows only its middle.
    enlarged: u32,
}

impl Figure {
    /// What it shows, but not by which method.
    fn caption(&self, paths: usize) -> String {
        let (shows, dataset) = (self.shows, self.dataset.name());
        let (percent, paths) = (self.magnification * 100.0, count(paths as u64));
        format!("{shows}{dataset} at {percent:.0} %, {paths} paths")
    }

    /// What is seen, and in how many pixels.
    fn view(&self, scene: &Scene) -> Result<View, RenderError> {
        let [width, height] = self.size_px;
        let whole = magnified(FrameSize::new(width, height)?, scene, self.magnification)?;
        let shown = FrameSize::new(width / self.enlarged, height / self.enlarged)?;
        View::new(shown, whole.center_m(), whole.px_per_m())
    }
}

/// Draws every picture of the page.
pub(crate) fn pictures(lab: &Lab<'_>, _: Deadline, out: &mut Results) -> Result<(), RenderError> {
    for figure in figures() {
        let paths = lab.plan.view_paths(figure.dataset);
        let caption = figure.caption(paths);
        let is_it = |p: &Picture| p.figure == figure.number && p.caption.starts_with(&caption);
        if out.pictures.iter().any(is_it) {
            continue;
        }
        lab.tell(&format!("picture of figure {}", figure.number));
        let scene = lab.scene(figure.dataset, paths);
        let view = figure.view(&scene)?;
        if let Some((method, frame)) = draw(lab, figure.method, &scene, &view)? {
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

/// The picture and the method that drew it. Where the one wanted is not to be measured or does not run, it is
/// another, unless the edges are the point of the picture.
fn draw(
    lab: &Lab<'_>,
    wanted: &str,
    scene: &Arc<Scene>,
    view: &View,
) -> Result<Option<(String, Frame)>, RenderError> {
    let methods = lab.plan.methods.iter().map(String::as_str);
    let is_asked_for = methods.clone().any(|spec| spec.starts_with(GRID));
    let own = is_asked_for.then_some(wanted);
    for spec in own
        .into_iter()
        .chain(methods.filter(|_| wanted != GRID_HARD))
    {
        if let Ok(frame) = lab.picture(spec, scene, view)? {
            return Ok(Some((spec.to_owned(), frame)));
        }
    }
    Ok(None)
}

/// The file of a picture, with one channel if it has no colors.
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
    fn pictures_keep_their_pixels_gray_or_not() {
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
