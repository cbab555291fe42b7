//! Writes a picture as SVG or PDF: the same layers, order, colors and widths, as exact curves.

use std::io::{self, Write};
use std::path::Path;

use guideway_formats::svg::{Stroke, SvgWriter};
use guideway_formats::{SaveError, replace_file};
use guideway_scene::{MethodInfo, Report, Shading, View};
use guideway_spline::Point;

use crate::backdrop::VisibleBackdrop;
use crate::decorations::PlacedDecorations;
use crate::page::Page;
use crate::pdf::PdfPage;
use crate::vector::{width_px, write_draw_list, write_paths};
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
    /// When the style has density shading, the view is out of range, swept areas are requested and
    /// no path has one, or the file cannot be written.
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
        let prepared = self.prepare_vector()?;
        let drawn = replace_file(output, |file| {
            self.write_prepared(format, &prepared, file).map_err(fail)
        })?;
        Ok(self.vector_report(format, prepared, drawn))
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
        let prepared = self.prepare_vector()?;
        let drawn = self.write_prepared(format, &prepared, out).map_err(fail)?;
        Ok(self.vector_report(format, prepared, drawn))
    }

    fn prepare_vector(&self) -> Result<Prepared<'_>, ComposeError> {
        if self.style.shading != Shading::Color {
            return Err(ComposeError::DensityInVector);
        }
        let view = self.view()?;
        Ok(Prepared {
            backdrop: self.backdrop.visible(&self.scene, &view, &self.budget)?,
            decorations: self.place_decorations(&view),
            view,
        })
    }

    fn vector_report(&self, format: VectorFormat, prepared: Prepared<'_>, drawn: u64) -> Rendered {
        let mut report = Report::of(format.name(), &self.scene, drawn);
        report.notes.extend(prepared.decorations.notes);
        Rendered {
            view: prepared.view,
            report,
            method: MethodInfo {
                name: format.name(),
                summary: "Exact curves, rasterized by the program that shows them",
                device: "none".to_owned(),
            },
            swept: prepared.backdrop.into_report(),
            prepare_ms: 0.0,
            render_ms: 0.0,
            write_ms: 0.0,
        }
    }

    fn write_prepared(
        &self,
        format: VectorFormat,
        prepared: &Prepared<'_>,
        out: &mut impl Write,
    ) -> io::Result<u64> {
        match format {
            VectorFormat::Svg => self.write_svg(out, prepared),
            VectorFormat::Pdf => {
                let mut page = PdfPage::new(prepared.view.size())?;
                let drawn = self.write_layers(prepared, &mut page)?;
                page.finish(self.decorations.title.as_deref(), out)?;
                Ok(drawn)
            }
        }
    }

    fn write_svg(&self, out: &mut impl Write, prepared: &Prepared<'_>) -> io::Result<u64> {
        let (scene, style, view) = (&self.scene, &self.style, &prepared.view);
        let size = view.size();
        let (width, height) = (f64::from(size.width()), f64::from(size.height()));
        // The stroke of the first path stands for all that equal it, which keeps the file small.
        let first = scene.draw_order().first();
        let common = first.map_or(Stroke::new(0xFF, 1.0), |&path| {
            Stroke::new(
                scene.color(path).to_u32(),
                width_px(scene, path, view, style),
            )
        });
        let attributes = format!(r#"width="{width}" height="{height}""#);
        let mut page = SvgWriter::begin(out, [0.0, 0.0, width, height], &attributes, &common)?;
        let drawn = self.write_layers(prepared, &mut page)?;
        page.finish()?;
        Ok(drawn)
    }

    /// Writes all layers. Returns the number of paths in the view.
    fn write_layers(&self, prepared: &Prepared<'_>, page: &mut impl Page) -> io::Result<u64> {
        let (scene, style, view) = (&self.scene, &self.style, &prepared.view);
        let decorations = &prepared.decorations;
        if style.background.a > 0 {
            let size = view.size();
            let end = Point::new(f64::from(size.width()), f64::from(size.height()));
            page.rectangle([Point::default(), end], style.background)?;
        }
        let below = [&decorations.grid, &decorations.zones];
        prepared.backdrop.write(below, view, style, page)?;
        let drawn = write_paths(scene, view, style, page)?;
        for marks in [&self.overlay, &decorations.marks] {
            write_draw_list(marks, "marks", page)?;
        }
        for (list, label) in &decorations.margin {
            write_draw_list(list, label, page)?;
        }
        Ok(drawn)
    }
}

/// The layers of a picture in its view, beside the paths.
struct Prepared<'p> {
    view: View,
    backdrop: VisibleBackdrop<'p>,
    decorations: PlacedDecorations,
}
