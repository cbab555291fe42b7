//! Renders a picture strip by strip: paths over the backdrop, marks and margin texts over both.

use std::path::Path;
use std::sync::Arc;

use guideway_formats::Progress;
use guideway_layout::clock::Instant;
use guideway_scene::{
    Cancel, Frame, FrameSize, Method, MethodInfo, RenderError, Report, View, elapsed_ms,
};

use crate::backdrop::SweptReport;
use crate::crowd::Covered;
use crate::decorations::density_legend;
use crate::density_image::see_through;
use crate::levels::copy;
use crate::overlay::PreparedOverlay;
use crate::{ComposeError, Picture, blend, save_png_by};

/// Outcome of a picture: the view, the account of all paths and the time per step.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The view that the picture shows; of levels side by side, that of the first one.
    pub view: View,
    /// Number of paths drawn, culled, hidden and refused, and notes for the user.
    pub report: Report,
    /// The render method; `svg` for SVG.
    pub method: MethodInfo,
    /// Number of paths with a swept area; `None` if none were requested.
    pub swept: Option<SweptReport>,
    /// Time to prepare scenes and backdrop.
    pub prepare_ms: f64,
    /// Time to render all strips.
    pub render_ms: f64,
    /// Time that the sink took.
    pub write_ms: f64,
}

/// Progress that is neither shown nor cancelled.
pub struct NoProgress;

impl Progress for NoProgress {}

/// Receives the rows of a picture, top first, a strip per call.
pub type StripSink<'a> = &'a mut dyn FnMut(&Frame) -> Result<(), ComposeError>;

impl Picture {
    /// Renders the picture with a method and hands it to `sink` strip by strip. Reports finished
    /// rows to `progress` and stops when it is cancelled.
    ///
    /// # Errors
    /// When a layer cannot be rendered, the memory budget does not suffice, swept areas are
    /// requested and no path has one, `progress` is cancelled, or `sink` fails.
    pub fn render(
        &self,
        method: &dyn Method,
        progress: &dyn Progress,
        sink: StripSink<'_>,
    ) -> Result<Rendered, ComposeError> {
        if !self.levels.is_empty() {
            return self.render_levels(method, progress, sink);
        }
        let started = Instant::now();
        let view = self.view()?;
        let visible = self.backdrop.visible(&self.scene, &view, &self.budget)?;
        let decorations = self.place_decorations(&view);
        let below = [&decorations.grid, &decorations.zones];
        let backdrop = visible.prepare(below, method, &self.budget, &self.style, &view)?;
        // Faded paths lie on the background, though there is nothing else below them.
        let is_below = self.opacity < 1.0 || !backdrop.is_empty();
        let mut backdrop = is_below.then_some(backdrop);
        let mut style = self.style;
        if backdrop.is_some() {
            style.background = see_through(&style);
        }
        let mut prepared = method.prepare(Arc::clone(&self.scene), &self.budget)?;
        let prepare_ms = elapsed_ms(started);

        let background = self.style.background;
        let marks = [&self.overlay, &decorations.marks];
        let marks = marks.map(|list| PreparedOverlay::new(list, &view));
        let margin = decorations.margin.iter();
        let margin: Vec<_> = margin
            .map(|(list, _)| PreparedOverlay::new(list, &view))
            .collect();
        let mut density = None::<PreparedOverlay>;
        let mut report = None::<Report>;
        let (mut render_ms, mut write_ms) = (0.0, 0.0);
        let mut covered = Covered::default();
        let size = FrameSize::new(1, 1)?;
        let (mut frame, mut below) = (Frame::new(size), Frame::new(size));
        for strip in view.strips(prepared.strip_pixels()) {
            if progress.cancelled() {
                return Err(RenderError::Cancelled.into());
            }
            let started = Instant::now();
            let of_strip = prepared.render_strip(&strip, &style, &Cancel::default(), &mut frame)?;
            covered.add(&frame, style.background);
            if let Some(backdrop) = &mut backdrop {
                backdrop.render(&strip, background, &mut below)?;
                blend::fade(&mut frame, self.opacity);
                blend::composite_over(&below, &mut frame);
            }
            for marks in &marks {
                marks.draw(&strip, &mut frame);
            }
            if let (Some(corner), Some(colors)) = (decorations.density_corner, &of_strip.density)
                && density.is_none()
            {
                let place = (&self.decorations, view.size());
                let list = density_legend(colors, corner, place, &self.decoration_style());
                density = list.map(|list| PreparedOverlay::new(&list, &view));
            }
            for list in margin.iter().chain(&density) {
                list.draw(&strip, &mut frame);
            }
            match &mut report {
                Some(report) => report.join(of_strip),
                none => *none = Some(of_strip),
            }
            render_ms += elapsed_ms(started);
            let started = Instant::now();
            sink(&frame)?;
            write_ms += elapsed_ms(started);
            progress.advance(strip.rows().end.into(), view.size().height().into());
        }
        let mut report = report.unwrap_or_default();
        let hint = covered.density_hint(&report, &style);
        report.notes.extend(hint);
        report.notes.extend(decorations.notes);
        Ok(Rendered {
            view,
            report,
            method: method.info(),
            swept: visible.into_report(),
            prepare_ms,
            render_ms,
            write_ms,
        })
    }

    /// Renders the levels into a frame that holds the whole picture, and hands it to `sink`.
    ///
    /// # Errors
    /// See [`Picture::render`].
    fn render_levels(
        &self,
        method: &dyn Method,
        progress: &dyn Progress,
        sink: StripSink<'_>,
    ) -> Result<Rendered, ComposeError> {
        let size = self.viewport.size;
        let needed_bytes = 4 * size.pixels() as u64;
        if needed_bytes > self.budget.memory_bytes {
            let error = RenderError::Budget {
                method: method.info().name,
                what: "levels side by side",
                needed_bytes,
                budget_bytes: self.budget.memory_bytes,
            };
            return Err(error.into());
        }
        let mut frame = Frame::new(size);
        let background = self.style.background.to_u32().to_be_bytes();
        frame.pixels_mut().fill(background);
        let pictures = self.of_levels()?;
        let mut all = Vec::new();
        for (i, (picture, corner)) in pictures.iter().enumerate() {
            let progress = OfLevel {
                all: progress,
                done: i as u64,
                levels: pictures.len() as u64,
            };
            let (of_level, rendered) = picture.render_frame(method, &progress)?;
            copy(&of_level, &mut frame, *corner);
            all.push(rendered);
        }
        let started = Instant::now();
        sink(&frame)?;
        let mut joined = join(all);
        joined.write_ms = elapsed_ms(started);
        Ok(joined)
    }

    /// Renders the picture into one frame.
    ///
    /// # Errors
    /// See [`Picture::render`].
    pub fn render_frame(
        &self,
        method: &dyn Method,
        progress: &dyn Progress,
    ) -> Result<(Frame, Rendered), ComposeError> {
        let mut frame = Frame::new(self.viewport.size);
        let mut rows = frame.pixels_mut().iter_mut();
        let rendered = self.render(method, progress, &mut |strip: &Frame| {
            let pixels = rows.by_ref().zip(strip.pixels());
            pixels.for_each(|(pixel, rendered)| *pixel = *rendered);
            Ok(())
        })?;
        Ok((frame, rendered))
    }

    /// Renders the picture into a PNG file, atomically, in memory that does not grow with the
    /// picture.
    ///
    /// # Errors
    /// See [`Picture::render`]; also when the file cannot be written.
    pub fn save_png(
        &self,
        method: &dyn Method,
        path: impl AsRef<Path>,
        progress: &dyn Progress,
    ) -> Result<Rendered, ComposeError> {
        let header = self.png_header()?;
        save_png_by(path, self.viewport.size, &header, |sink| {
            self.render(method, progress, sink)
        })
    }
}

/// Progress of one of several levels.
struct OfLevel<'p> {
    all: &'p dyn Progress,
    done: u64,
    levels: u64,
}

impl Progress for OfLevel<'_> {
    fn advance(&self, done: u64, total: u64) {
        self.all
            .advance(self.done * total + done, self.levels * total);
    }

    fn cancelled(&self) -> bool {
        self.all.cancelled()
    }
}

/// The account of a picture of levels: what is hidden is on no level.
///
/// # Panics
/// Without a level.
pub(crate) fn join(levels: Vec<Rendered>) -> Rendered {
    let joined = levels.into_iter().reduce(|mut all, level| {
        let (report, other) = (&mut all.report, level.report);
        report.drawn += other.drawn;
        report.culled += other.culled;
        report.notes.extend(other.notes);
        all.prepare_ms += level.prepare_ms;
        all.render_ms += level.render_ms;
        all
    });
    let mut all = joined.expect("a picture of levels has one");
    let report = &mut all.report;
    let shown = report.drawn + report.culled + report.refused;
    report.hidden = report.total.saturating_sub(shown);
    report.notes.dedup();
    all
}

#[cfg(test)]
#[path = "render_tests.rs"]
mod tests;
