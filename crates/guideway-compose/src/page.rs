//! A page of vector graphics: the elements that layers are written as, and SVG as one kind of page.

use std::borrow::Cow;
use std::io::{self, Write};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use guideway_formats::svg::{PathData, Stroke, SvgText, SvgWriter};
use guideway_scene::{Rgba, TextLine};
use guideway_spline::Point;

/// Step of coordinates, in pixels: far below what a viewer can show.
pub(crate) const STEP_PX: f64 = 1e-3;

/// Step of the coordinates of areas, which have many corners, in pixels.
const AREA_STEP_PX: f64 = 1e-2;

/// An image to write.
pub(crate) trait PageImage {
    /// The bytes of a PNG file.
    fn png(&self) -> io::Result<Cow<'_, [u8]>>;

    /// Width and height in pixels.
    fn size_px(&self) -> [u32; 2];

    /// Pixels, top first, with straight alpha.
    fn pixels(&self) -> impl Iterator<Item = [u8; 4]>;
}

/// Writes elements in paint order, in pixels of the picture, y down. Every method fails when the
/// output does.
pub(crate) trait Page {
    /// Segments of uniform cubic B-splines, stroked with round caps and joins. An identifier is not
    /// empty.
    fn path(
        &mut self,
        id: Option<&str>,
        segments: &[[Point<f64>; 4]],
        color: Rgba,
        width_px: f64,
    ) -> io::Result<()>;

    /// A filled rectangle, given two opposite corners.
    fn rectangle(&mut self, corners: [Point<f64>; 2], color: Rgba) -> io::Result<()>;

    /// Areas in one color, which is composited once where they overlap. Outer contours turn in one
    /// direction, holes in the other.
    fn areas(&mut self, label: &str, color: Rgba, areas: &[Vec<Vec<Point<f64>>>])
    -> io::Result<()>;

    /// A line of text with its halo.
    fn text(&mut self, text: &TextLine) -> io::Result<()>;

    /// An image. The matrix (a, b, c, d, e, f of SVG) maps the unit square, y down, to pixels.
    fn image(&mut self, matrix: [f64; 6], image: &impl PageImage) -> io::Result<()>;

    /// Begins a group with a label that lets what is below it shine through, from opacity 0 to 1.
    fn begin_group(&mut self, label: &str, opacity: f64) -> io::Result<()>;

    /// Ends the innermost group.
    fn end_group(&mut self) -> io::Result<()>;

    /// Begins a part with its own origin, given its upper left corner and its size in pixels.
    /// Nothing is drawn outside of it.
    fn begin_part(&mut self, corner_px: [u32; 2], size_px: [u32; 2]) -> io::Result<()>;

    /// Ends a part.
    fn end_part(&mut self) -> io::Result<()>;
}

impl<W: Write> Page for SvgWriter<'_, W> {
    fn path(
        &mut self,
        id: Option<&str>,
        segments: &[[Point<f64>; 4]],
        color: Rgba,
        width_px: f64,
    ) -> io::Result<()> {
        let mut data = PathData::new(STEP_PX);
        segments
            .iter()
            .for_each(|segment| data.push_segment(segment));
        let stroke = Stroke::new(color.to_u32(), width_px);
        SvgWriter::path(self, id.unwrap_or_default(), &data, &stroke)
    }

    fn rectangle(&mut self, [a, b]: [Point<f64>; 2], color: Rgba) -> io::Result<()> {
        self.rect([a.x, a.y, b.x - a.x, b.y - a.y], color.to_u32())
    }

    fn areas(
        &mut self,
        label: &str,
        color: Rgba,
        areas: &[Vec<Vec<Point<f64>>>],
    ) -> io::Result<()> {
        self.polygon_layer(label, color.to_u32(), AREA_STEP_PX, areas)
    }

    fn text(&mut self, text: &TextLine) -> io::Result<()> {
        let height = text.height_px();
        let middle = text.left_middle_px;
        // From the middle of a line to its baseline: half the height of a capital.
        let at = middle + Point::new(0.0, 0.35 * height);
        // A stroke is as wide on both sides of the outlines of letters.
        let halo = Stroke::new(text.halo.to_u32(), 2.0 * text.halo_px());
        // The last digits of an angle's sine differ between systems.
        let rounded = |px: f64| (px / STEP_PX).round() / (1.0 / STEP_PX);
        self.text_line(&SvgText {
            at: [rounded(at.x), rounded(at.y)],
            height,
            width: rounded(text.width_px()),
            turned: (
                text.angle_rad.to_degrees(),
                [rounded(middle.x), rounded(middle.y)],
            ),
            rgba: text.color.to_u32(),
            halo: (text.halo.a > 0).then_some(halo),
            text: &text.text,
        })
    }

    fn image(&mut self, matrix: [f64; 6], image: &impl PageImage) -> io::Result<()> {
        let data = STANDARD.encode(image.png()?);
        SvgWriter::image(self, matrix, &format!("data:image/png;base64,{data}"))
    }

    fn begin_group(&mut self, label: &str, opacity: f64) -> io::Result<()> {
        match opacity < 1.0 {
            true => self.begin_faded_group(opacity),
            false => SvgWriter::begin_group(self, label),
        }
    }

    fn end_group(&mut self) -> io::Result<()> {
        SvgWriter::end_group(self)
    }

    fn begin_part(&mut self, corner_px: [u32; 2], size_px: [u32; 2]) -> io::Result<()> {
        self.begin_viewport(corner_px, size_px)
    }

    fn end_part(&mut self) -> io::Result<()> {
        self.end_viewport()
    }
}
