//! Writes density shading on a page of vector graphics, as an image: a count of paths per pixel is
//! no property of a curve.

use std::borrow::Cow;
use std::io;
use std::sync::Arc;

use guideway_cpu::Cpu;
use guideway_png::encode_png;
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, RenderError, Report, Rgba, Scene, Shading, Style,
    View,
};

use crate::page::{Page, PageImage};

/// Pixels of the image per pixel of the page, on each axis. Derived: a page of 96 pixels per inch
/// is printed with 384.
const DETAIL: u32 = 4;
/// Longest side of an image with detail, in pixels. Derived: 64 million pixels, as the largest
/// image that is read.
const MAX_SIDE_PX: u32 = 8192;

/// The pixels of density shading over nothing.
struct DensityImage(Frame);

impl PageImage for DensityImage {
    fn png(&self) -> io::Result<Cow<'_, [u8]>> {
        Ok(Cow::Owned(encode_png(self.size_px(), self.pixels())?))
    }

    fn size_px(&self) -> [u32; 2] {
        let size = self.0.size();
        [size.width(), size.height()]
    }

    fn pixels(&self) -> impl Iterator<Item = [u8; 4]> {
        self.0.pixels().iter().copied()
    }
}

/// A background that shows the layers below. Colors of density stand out from the paper, and a
/// method takes nothing at all for white: hence the least opacity of that paper.
pub(crate) fn see_through(style: &Style) -> Rgba {
    Rgba {
        a: u8::from(style.shading != Shading::Color).min(style.background.a),
        ..style.background
    }
}

/// Writes the density of a scene in a view. Returns the report with the meaning of its colors.
///
/// # Errors
/// When the image exceeds the memory budget, or the page cannot be written.
pub(crate) fn write_density(
    scene: &Scene,
    view: &View,
    style: &Style,
    page: &mut impl Page,
) -> io::Result<Report> {
    let (image, report) = draw(scene, view, style).map_err(io::Error::other)?;
    let size = view.size();
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    page.image([width, 0.0, 0.0, height, 0.0, 0.0], &image)?;
    Ok(report)
}

fn draw(scene: &Scene, view: &View, style: &Style) -> Result<(DensityImage, Report), RenderError> {
    let size = view.size();
    let side_px = size.width().max(size.height());
    let detail = (MAX_SIDE_PX / side_px).clamp(1, DETAIL);
    let factor = f64::from(detail);
    let size = FrameSize::new(size.width() * detail, size.height() * detail)?;
    let view = View::new(size, view.center_m(), view.px_per_m() * factor)?;
    let style = Style {
        line_rule: style.line_rule.scaled(factor),
        background: see_through(style),
        ..*style
    };
    let mut prepared = Cpu.prepare(Arc::new(scene.clone()), &Budget::default())?;
    let mut frame = Frame::new(size);
    let report = prepared.render(&view, &style, &Cancel::default(), &mut frame)?;
    Ok((DensityImage(frame), report))
}
