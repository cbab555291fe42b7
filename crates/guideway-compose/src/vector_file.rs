//! Writes a picture as SVG or PDF: the same layers, order, colors and widths, as exact curves;
//! density shading as an image.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use guideway_formats::svg::{Stroke, SvgWriter};
use guideway_formats::{SaveError, replace_file};
use guideway_scene::{MethodInfo, Report, View};
use guideway_spline::Point;

use crate::backdrop::VisibleBackdrop;
use crate::decorations::{PlacedDecorations, density_legend};
use crate::page::Page;
use crate::pdf::PdfPage;
use crate::render::join;
use crate::vector::{width_px, write_draw_list, write_faded_paths};
use crate::{ComposeError, Picture, Rendered};

/// A format of vector graphics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VectorFormat {
    /// Scalable Vector Graphics, with texts as letters.
    Svg,
    /// Portable Document Format, with texts as outlines.
    Pdf,
}

impl VectorFormat {
    /// Name of the format, as a method of the report.
    fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Pdf => "pdf",
        }
    }
}

impl Picture {
    /// Writes the picture as an SVG file, atomically.
    ///
    /// # Errors
    /// See [`Picture::save_vector`].
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<Rendered, ComposeError> {
        self.save_vector(VectorFormat::Svg, path)
    }

    /// Writes the picture as a file of vector graphics, atomically.
    ///
    /// # Errors
    /// When the view is out of range, swept areas are requested and no path has one, or the file
    /// cannot be written.
    pub fn save_vector(
        &self,
        format: VectorFormat,
        path: impl AsRef<Path>,
    ) -> Result<Rendered, ComposeError> {
        let output = path.as_ref();
        let fail = |problem| SaveError {
            path: output.to_owned(),
            problem,
        };
        // Before the file is begun: an error of the picture leaves none.
        let sheet = self.sheet()?;
        let parts = prepare(&sheet)?;
        let drawn = replace_file(output, |file| {
            self.write_parts(format, &parts, file).map_err(fail)
        })?;
        Ok(report(format, parts, drawn))
    }

    /// Writes the picture as vector graphics to a stream. `fail` converts the errors of the stream.
    ///
    /// # Errors
    /// See [`Picture::save_vector`].
    pub fn write_vector(
        &self,
        format: VectorFormat,
        out: &mut impl Write,
        fail: impl FnOnce(io::Error) -> ComposeError,
    ) -> Result<Rendered, ComposeError> {
        let sheet = self.sheet()?;
        let parts = prepare(&sheet)?;
        let drawn = self.write_parts(format, &parts, out).map_err(fail)?;
        Ok(report(format, parts, drawn))
    }

    /// The pictures of all levels, or this one.
    fn sheet(&self) -> Result<Vec<Placed<'_>>, ComposeError> {
        if self.levels.is_empty() {
            return Ok(vec![Placed {
                picture: Cow::Borrowed(self),
                corner_px: [0, 0],
            }]);
        }
        let placed = |(picture, corner_px)| Placed {
            picture: Cow::Owned(picture),
            corner_px,
        };
        Ok(self.of_levels()?.into_iter().map(placed).collect())
    }

    /// Writes all parts. Returns the number of paths in the view of each.
    fn write_parts(
        &self,
        format: VectorFormat,
        parts: &[Prepared<'_>],
        out: &mut impl Write,
    ) -> io::Result<Vec<u64>> {
        match format {
            VectorFormat::Svg => self.write_svg(out, parts),
            VectorFormat::Pdf => {
                let mut page = PdfPage::new(self.viewport.size)?;
                let drawn = self.write_layers(parts, &mut page)?;
                page.finish(self.decorations.title.as_deref(), out)?;
                Ok(drawn)
            }
        }
    }

    fn write_svg(&self, out: &mut impl Write, parts: &[Prepared<'_>]) -> io::Result<Vec<u64>> {
        let size = self.viewport.size;
        let (width, height) = (f64::from(size.width()), f64::from(size.height()));
        // The stroke of the first path stands for all that equal it, which keeps the file small.
        let common = parts.first().and_then(Prepared::first_stroke);
        let common = common.unwrap_or(Stroke::new(0xFF, 1.0));
        let attributes = format!(r#"width="{width}" height="{height}""#);
        let mut page = SvgWriter::begin(out, [0.0, 0.0, width, height], &attributes, &common)?;
        let drawn = self.write_layers(parts, &mut page)?;
        page.finish()?;
        Ok(drawn)
    }

    fn write_layers(&self, parts: &[Prepared<'_>], page: &mut impl Page) -> io::Result<Vec<u64>> {
        let background = self.style.background;
        if background.a > 0 {
            let size = self.viewport.size;
            let end = Point::new(f64::from(size.width()), f64::from(size.height()));
            page.rectangle([Point::default(), end], background)?;
        }
        let mut drawn = Vec::with_capacity(parts.len());
        for part in parts {
            if self.levels.is_empty() {
                drawn.push(part.write(page)?);
                continue;
            }
            let size = part.view.size();
            let label = part.picture.decorations.title.as_deref();
            page.begin_group(label.unwrap_or_default(), 1.0)?;
            page.begin_part(part.corner_px, [size.width(), size.height()])?;
            drawn.push(part.write(page)?);
            page.end_part()?;
            page.end_group()?;
        }
        Ok(drawn)
    }
}

/// A picture and its upper left corner on a page.
struct Placed<'p> {
    picture: Cow<'p, Picture>,
    corner_px: [u32; 2],
}

/// A picture on a page: its layers in its view, beside the paths.
struct Prepared<'p> {
    picture: &'p Picture,
    /// Its upper left corner on the page.
    corner_px: [u32; 2],
    view: View,
    backdrop: VisibleBackdrop<'p>,
    decorations: PlacedDecorations,
}

fn prepare<'p>(sheet: &'p [Placed<'p>]) -> Result<Vec<Prepared<'p>>, ComposeError> {
    let prepare = |placed: &'p Placed<'p>| {
        let picture = &*placed.picture;
        let view = picture.view()?;
        Ok(Prepared {
            picture,
            corner_px: placed.corner_px,
            backdrop: picture
                .backdrop
                .visible(&picture.scene, &view, &picture.budget)?,
            decorations: picture.place_decorations(&view),
            view,
        })
    };
    sheet.iter().map(prepare).collect()
}

impl Prepared<'_> {
    fn first_stroke(&self) -> Option<Stroke> {
        let Picture { scene, style, .. } = self.picture;
        let path = *scene.draw_order().first()?;
        let width = width_px(scene, path, &self.view, style);
        Some(Stroke::new(scene.color(path).to_u32(), width))
    }

    /// Writes all layers over the background. Returns the number of paths in the view.
    fn write(&self, page: &mut impl Page) -> io::Result<u64> {
        let Picture { scene, style, .. } = self.picture;
        let (view, decorations) = (&self.view, &self.decorations);
        let below = [&decorations.grid, &decorations.zones];
        self.backdrop.write(below, view, style, page)?;
        let paths = write_faded_paths(scene, view, style, self.picture.opacity, page)?;
        for marks in [&self.picture.overlay, &decorations.marks] {
            write_draw_list(marks, "marks", page)?;
        }
        for (list, label) in &decorations.margin {
            write_draw_list(list, label, page)?;
        }
        if let (Some(corner), Some(colors)) = (decorations.density_corner, &paths.density) {
            let place = (&self.picture.decorations, view.size());
            let style = self.picture.decoration_style();
            let list = density_legend(colors, corner, place, &style);
            write_draw_list(&list.unwrap_or_default(), "legend", page)?;
        }
        Ok(paths.drawn)
    }
}

/// The account of all parts of a page.
fn report(format: VectorFormat, parts: Vec<Prepared<'_>>, drawn: Vec<u64>) -> Rendered {
    let of_part = |(part, drawn): (Prepared<'_>, u64)| {
        let mut report = Report::of(format.name(), &part.picture.scene, drawn);
        report.notes.extend(part.decorations.notes);
        Rendered {
            view: part.view,
            report,
            method: MethodInfo {
                name: format.name(),
                summary: "Exact curves, rasterized by the program that shows them",
                device: "none".to_owned(),
            },
            swept: part.backdrop.into_report(),
            prepare_ms: 0.0,
            render_ms: 0.0,
            write_ms: 0.0,
        }
    };
    let rendered: Vec<_> = parts.into_iter().zip(drawn).map(of_part).collect();
    join(rendered)
}
