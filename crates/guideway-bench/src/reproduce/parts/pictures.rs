//! The pictures of chapter 5, drawn by the thesis' own method.

use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use guideway_render::{Frame, FrameSize, RenderError, View};
use guideway_scene::Scene;

use super::views::{MAGNIFICATIONS, magnified};
use crate::Dataset;
use crate::reproduce::lab::{Deadline, Lab};
use crate::reproduce::names::{GRID, GRID_HARD};
use crate::reproduce::run::{Picture, Results};
use crate::words::count;

/// How a figure is drawn: a part of the dataset so large that it fills the picture.
struct Figure {
    number: &'static str,
    shows: &'static str,
    dataset: Dataset,
    method: &'static str,
    magnification: f64,
    size_px: [u32; 2],
    enlarged: u32,
}

/// Draws every picture of the page.
pub(crate) fn pictures(lab: &Lab<'_>, _: Deadline, out: &mut Results) -> Result<(), RenderError> {
    for figure in figures() {
        lab.tell(&format!("picture of figure {}", figure.number));
        let paths = lab.plan.view_paths(figure.dataset);
        let scene = lab.scene(figure.dataset, paths);
        let size = FrameSize::new(figure.size_px[0], figure.size_px[1])?;
        let view = magnified(size, &scene, figure.magnification)?;
        if let Some((method, frame)) = draw(lab, figure.method, &scene, &view)? {
            let (shows, dataset) = (figure.shows, figure.dataset.name());
            let percent = figure.magnification * 100.0;
            out.pictures.push(Picture {
                figure: figure.number.to_owned(),
                caption: format!(
                    "{shows}{dataset} at {percent:.0} %, {} paths, by {method}",
                    count(paths as u64)
                ),
                size_px: figure.size_px,
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
    let edges = |number, shows, method, size_px, enlarged| Figure {
        shows,
        method,
        magnification: MAGNIFICATIONS[3],
        size_px,
        enlarged,
        ..whole(number, Dataset::D1)
    };
    let mut figures = vec![whole("5.1", Dataset::D1), whole("5.2", Dataset::D2)];
    figures.extend(zoomed);
    for (number, size_px, enlarged) in [("5.6", [480, 270], 1), ("5.7", [48, 27], 10)] {
        figures.push(edges(number, "smooth: ", GRID, size_px, enlarged));
        figures.push(edges(number, "not smooth: ", GRID_HARD, size_px, enlarged));
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

/// The file of a picture, with one channel if it has no colours.
fn png(frame: &Frame) -> Vec<u8> {
    let is_grey = |&[r, g, b, a]: &[u8; 4]| r == g && g == b && a == 255;
    let (color, bytes): (_, Vec<u8>) = if frame.pixels().iter().all(is_grey) {
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
    fn pictures_keep_their_pixels_grey_or_not() {
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
