use std::sync::Arc;
use std::time::Instant;

use guideway::formats::Progress;
use guideway::render::{
    Budget, Cancel, DrawList, Frame, FrameSize, Method, MethodInfo, RenderError, Report, Shading,
    Style, View, elapsed_ms,
};
use guideway::scene::{Rgba, Scene, SceneOptions};
use guideway::spline::{Bounds, Point};

use super::below::Below;
use super::sheet::Laid;
use super::swept::SweptReport;
use super::{floor_plan, legend};
use crate::cli::Failure;

/// What a picture is to be like.
pub(crate) struct Wishes {
    pub(crate) size: FrameSize,
    /// The middle of the picture; everything's middle if unset.
    pub(crate) center_m: Option<Point<f64>>,
    /// Scale; such that everything is seen if unset.
    pub(crate) px_per_m: Option<f64>,
    pub(crate) scene: SceneOptions,
    pub(crate) style: Style,
    /// Whether the picture shows what its colors mean.
    pub(crate) has_legend: bool,
    pub(crate) budget: Budget,
    /// What lies over the paths.
    pub(crate) marks: DrawList,
}

/// What became of every path of a picture.
pub(crate) struct Drawn {
    pub(crate) view: View,
    pub(crate) report: Report,
    pub(crate) method: MethodInfo,
    /// What became of the swept areas, if there are any.
    pub(crate) swept: Option<SweptReport>,
    pub(crate) prepare_ms: f64,
    pub(crate) render_ms: f64,
    pub(crate) write_ms: f64,
}

/// Takes the next rows of a picture, from the top.
pub(crate) type Take<'a> = &'a mut dyn FnMut(&Frame) -> Result<(), Failure>;

/// Draws a scene over what lies below it, and hands on the picture strip by strip. `progress` is told of rows.
pub(crate) fn draw(
    method: &dyn Method,
    scene: &Arc<Scene>,
    below: &Below,
    wishes: &Wishes,
    progress: &dyn Progress,
    take: Take<'_>,
) -> Result<Drawn, Failure> {
    let started = Instant::now();
    let view = view(scene, below, wishes)?;
    let seen = below.seen(scene, &view)?;
    let mut ground = seen.ground(method, wishes, &view)?;
    let mut style = wishes.style;
    if ground.is_some() {
        style.background.a = 0;
    }
    let mut prepared = method.prepare(Arc::clone(scene), &wishes.budget)?;
    let prepare_ms = elapsed_ms(started);

    let (legend, has_no_room) = legend::wished(scene, wishes);
    let marks = Laid::new(&wishes.marks, &view);
    let stamp = Laid::new(&legend, &view);
    let mut report = None::<Report>;
    let (mut render_ms, mut write_ms, mut bare_pixels) = (0.0, 0.0, 0);
    let size = FrameSize::new(1, 1)?;
    let (mut frame, mut below_it) = (Frame::new(size), Frame::new(size));
    for strip in view.strips(prepared.strip_pixels()) {
        if progress.cancelled() {
            return Err(RenderError::Cancelled.into());
        }
        let started = Instant::now();
        let of_strip = prepared.render_strip(&strip, &style, &Cancel::default(), &mut frame)?;
        if let Some(ground) = &mut ground {
            ground.draw(&strip, wishes.style.background, &mut below_it)?;
            floor_plan::lay_over(&below_it, &mut frame);
        }
        marks.onto(&strip, &mut frame);
        bare_pixels += bare(&frame, wishes.style.background);
        stamp.onto(&strip, &mut frame);
        match &mut report {
            Some(report) => report.join(of_strip),
            none => *none = Some(of_strip),
        }
        render_ms += elapsed_ms(started);
        let started = Instant::now();
        take(&frame)?;
        write_ms += elapsed_ms(started);
        progress.advance(strip.rows().end.into(), view.size().height().into());
    }
    let mut report = report.unwrap_or_default();
    report
        .notes
        .extend(crowded(&report, bare_pixels, &view, &wishes.style));
    report.notes.extend(has_no_room);
    Ok(Drawn {
        view,
        report,
        method: method.info(),
        swept: seen.report(),
        prepare_ms,
        render_ms,
        write_ms,
    })
}

/// Pixels that show nothing.
fn bare(frame: &Frame, background: Rgba) -> usize {
    let bare = background.to_u32().to_be_bytes();
    frame
        .pixels()
        .iter()
        .filter(|&&pixel| pixel == bare)
        .count()
}

/// What would show more, where a crowd of paths covers most of the picture.
fn crowded(report: &Report, bare_pixels: usize, view: &View, style: &Style) -> Option<String> {
    const CROWD: u64 = 10_000;
    let is_crowd = report.drawn >= CROWD && bare_pixels * 2 < view.size().pixels();
    let note = "paths cover most of the picture; `--shade density` shows how many lie where";
    (is_crowd && style.shading == Shading::Color).then(|| note.to_owned())
}

/// The view that is wished for; unless said otherwise it shows everything, what lies below too.
pub(super) fn view(scene: &Scene, below: &Below, wishes: &Wishes) -> Result<View, RenderError> {
    if let (Some(center_m), Some(px_per_m)) = (wishes.center_m, wishes.px_per_m) {
        return View::new(wishes.size, center_m, px_per_m);
    }
    let bounds = [scene.bounds(), below.bounds(scene)];
    let bounds = bounds.into_iter().flatten().reduce(Bounds::union);
    let all = View::fit(wishes.size, bounds)?;
    View::new(
        wishes.size,
        wishes.center_m.unwrap_or(all.center_m()),
        wishes.px_per_m.unwrap_or(all.px_per_m()),
    )
}

#[cfg(test)]
mod tests;
