//! What lies below a layout: the paths of another file in a pale color, or an image.

mod image;

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::sync::Arc;

use guideway::formats::svg::{Outline, Page, Stroke};
use guideway::render::{Budget, Cancel, Frame, Prepared, Strip, Style, View};
use guideway::scene::{LineRule, Rgba, Scene, SceneOptions};
use guideway::spline::Bounds;

use self::image::Image;
use super::vector;
use crate::cli::input::{self, Input};
use crate::cli::{Failure, Output};

/// The color of all paths of a floor plan.
const PALE: Rgba = Rgba::opaque(0xC2, 0xCA, 0xD3);

/// How wide they are: walls and shelves are outlines.
const LINES: LineRule = LineRule::World {
    width_m: 0.02,
    min_px: 1.0,
    max_px: 2.0,
};

const PNG: &[u8] = b"\x89PNG";

#[derive(Clone)]
pub(crate) enum FloorPlan {
    Paths(Arc<Scene>),
    Image(Arc<Image>),
}

/// A floor plan that is ready to be drawn.
pub(crate) enum Floor {
    Paths(Box<dyn Prepared>),
    Image(Arc<Image>),
}

impl FloorPlan {
    /// Reads a floor plan; its content tells which of the two it is.
    pub(crate) fn read(input: &Input, out: &Output) -> Result<Self, Failure> {
        if is_png(&input.path) {
            return Ok(Self::Image(Arc::new(Image::read(input)?)));
        }
        let (mut layout, _) = input::read_all(std::slice::from_ref(input), out)?;
        let rows = layout.paths.len();
        layout.paths.set_color_rgba(vec![PALE.to_u32(); rows]);
        layout.paths.set_width_m(vec![f32::NAN; rows]);
        let scene = Scene::new(Arc::new(layout), &SceneOptions::default())?;
        Ok(Self::Paths(Arc::new(scene)))
    }

    pub(crate) fn bounds(&self) -> Option<Bounds<f64>> {
        match self {
            Self::Paths(scene) => scene.bounds(),
            Self::Image(image) => Some(image.bounds()),
        }
    }

    /// Makes it ready to be drawn.
    pub(crate) fn prepare(&self, budget: &Budget) -> Result<Floor, Failure> {
        Ok(match self {
            Self::Paths(scene) => {
                Floor::Paths(guideway::method("cpu")?.prepare(Arc::clone(scene), budget)?)
            }
            Self::Image(image) => Floor::Image(Arc::clone(image)),
        })
    }

    /// Writes it below what follows on a page.
    pub(super) fn write(&self, view: &View, page: &mut Page<'_, impl Write>) -> io::Result<()> {
        match self {
            Self::Image(image) => image.write(view, page),
            Self::Paths(scene) => {
                page.begin_group("floor plan")?;
                for &path in scene.draw_order() {
                    let width_px = 2.0 * LINES.radius_px(None, view.px_per_m());
                    let outline: Outline = vector::outline(scene, path, view, width_px);
                    page.path("", &outline, &Stroke::of(PALE.to_u32(), width_px))?;
                }
                page.end_group()
            }
        }
    }
}

impl Floor {
    /// Draws it alone, into a picture of the strip's size.
    pub(crate) fn draw(
        &mut self,
        strip: &Strip,
        background: Rgba,
        frame: &mut Frame,
    ) -> Result<(), Failure> {
        match self {
            Self::Paths(prepared) => {
                let style = Style {
                    line_rule: LINES,
                    background,
                    ..Style::default()
                };
                prepared.render_strip(strip, &style, &Cancel::default(), frame)?;
            }
            Self::Image(image) => image.draw(strip, background, frame),
        }
        Ok(())
    }
}

/// What cannot be read is for the reader to say.
fn is_png(path: &Path) -> bool {
    let mut first = [0; PNG.len()];
    path.is_file()
        && File::open(path).is_ok_and(|mut file| file.read_exact(&mut first).is_ok())
        && first == PNG
}

/// Puts a picture over another of the same size, both with straight alpha.
pub(super) fn lay_over(below: &Frame, frame: &mut Frame) {
    for (pixel, &below) in frame.pixels_mut().iter_mut().zip(below.pixels()) {
        *pixel = over(*pixel, below);
    }
}

/// A color over another, both with straight alpha (Porter and Duff 1984).
pub(super) fn over(above: [u8; 4], below: [u8; 4]) -> [u8; 4] {
    if above[3] == 255 || below[3] == 0 {
        return above;
    }
    let [a, b] = [above[3], below[3]].map(|alpha| f64::from(alpha) / 255.0);
    let shines = b * (1.0 - a);
    let alpha = a + shines;
    let mix = |i: usize| (f64::from(above[i]) * a + f64::from(below[i]) * shines) / alpha;
    [mix(0), mix(1), mix(2), alpha * 255.0].map(|v| v.round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_below_shows_through() {
        assert_eq!(over([1, 2, 3, 255], [9, 9, 9, 255]), [1, 2, 3, 255]);
        assert_eq!(over([1, 2, 3, 0], [9, 8, 7, 255]), [9, 8, 7, 255]);
        assert_eq!(
            over([0, 0, 0, 51], [255, 255, 255, 255]),
            [204, 204, 204, 255]
        );
        assert_eq!(over([5, 5, 5, 0], [9, 9, 9, 0]), [5, 5, 5, 0]);
    }
}
