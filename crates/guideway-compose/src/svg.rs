//! Writes a picture as SVG: the same layers, order, colors and widths, as exact curves.

use std::io::{self, Write};
use std::path::Path;

use guideway_formats::svg::{Stroke, SvgWriter};
use guideway_formats::{SaveError, replace_file};
use guideway_scene::{MethodInfo, Report, Shading, View};

use crate::backdrop::VisibleBackdrop;
use crate::decorations::PlacedDecorations;
use crate::vector::{width_px, write_draw_list, write_paths};
use crate::{ComposeError, Picture, Rendered};

/// Name of the format, as a method of the report.
const NAME: &str = "svg";

impl Picture {
    /// Writes the picture as an SVG file, atomically.
    ///
    /// # Errors
    /// When the style has density shading, the view is out of range, swept areas are requested and
    /// no path has one, or the file cannot be written.
    pub fn save_svg(&self, path: impl AsRef<Path>) -> Result<Rendered, ComposeError> {
        let output = path.as_ref();
        if self.style.shading != Shading::Color {
            return Err(ComposeError::DensityInSvg);
        }
        let view = self.view()?;
        let backdrop = self.backdrop.visible(&self.scene, &view, &self.budget)?;
        let decorations = self.place_decorations(&view);
        let drawn = replace_file(output, |file| {
            let written = self.write_svg(file, &view, &backdrop, &decorations);
            written.map_err(|problem| SaveError {
                path: output.to_owned(),
                problem,
            })
        })?;
        let mut report = Report::of(NAME, &self.scene, drawn);
        report.notes.extend(decorations.notes);
        Ok(Rendered {
            view,
            report,
            method: MethodInfo {
                name: NAME,
                summary: "Exact curves, rasterized by the program that shows them",
                device: "none".to_owned(),
            },
            swept: backdrop.into_report(),
            prepare_ms: 0.0,
            render_ms: 0.0,
            write_ms: 0.0,
        })
    }

    /// Writes all layers. Returns the number of paths in the view.
    fn write_svg(
        &self,
        out: &mut impl Write,
        view: &View,
        backdrop: &VisibleBackdrop<'_>,
        decorations: &PlacedDecorations,
    ) -> io::Result<u64> {
        let (scene, style, size) = (&self.scene, &self.style, view.size());
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
        if style.background.a > 0 {
            page.rect([0.0, 0.0, width, height], style.background.to_u32())?;
        }
        backdrop.write(&decorations.grid, view, style, &mut page)?;
        let drawn = write_paths(scene, view, style, &mut page)?;
        for marks in [&self.overlay, &decorations.marks] {
            write_draw_list(marks, "marks", &mut page)?;
        }
        for (list, label) in &decorations.margin {
            write_draw_list(list, label, &mut page)?;
        }
        page.finish()?;
        Ok(drawn)
    }
}
