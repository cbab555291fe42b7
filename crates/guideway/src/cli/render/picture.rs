use std::sync::Arc;

use guideway::render::{
    Budget, Cancel, Frame, FrameSize, Method, MethodInfo, RenderError, Report, Shading, Style, View,
};
use guideway::scene::{Rgba, Scene, SceneOptions};
use guideway::spline::{Bounds, Point};

use super::below::Below;
use super::swept::SweptReport;
use super::{floor_plan, legend};
use crate::cli::{Failure, Output};

/// What a picture is to be like.
pub(crate) struct Wishes {
    pub(crate) size: FrameSize,
    /// The middle of the picture; everything's middle if unset.
    pub(crate) center_m: Option<Point<f64>>,
    /// Scale; such that everything is seen if unset.
    pub(crate) px_per_m: Option<f64>,
    pub(crate) scene: SceneOptions,
    pub(crate) style: Style,
    pub(crate) budget: Budget,
}

/// A picture with what became of every path.
pub(crate) struct Drawn<F = Frame> {
    pub(crate) frame: F,
    pub(crate) view: View,
    pub(crate) report: Report,
    pub(crate) method: MethodInfo,
    /// What became of the swept areas, if there are any.
    pub(crate) swept: Option<SweptReport>,
    pub(crate) prepare_ms: f64,
    pub(crate) render_ms: f64,
}

/// Draws a scene over what lies below it, showing that it is being drawn.
pub(crate) fn draw(
    method: &dyn Method,
    scene: &Arc<Scene>,
    below: &Below,
    wishes: &Wishes,
    out: &Output,
) -> Result<Drawn, Failure> {
    let view = view(scene, below, wishes)?;
    let activity = out.activity("preparing");
    let mut style = wishes.style;
    let seen = below.seen(scene, &view)?;
    let below = seen.draw(&view, style.background, &wishes.budget)?;
    if below.is_some() {
        style.background.a = 0;
    }
    let mut prepared = method.prepare(Arc::clone(scene), &wishes.budget)?;
    let prepare_ms = activity.finish();
    let activity = out.activity("drawing");
    let mut frame = Frame::new(view.size());
    let report = prepared.render(&view, &style, &Cancel::default(), &mut frame)?;
    if let Some(below) = &below {
        floor_plan::lay_over(below, &mut frame);
    }
    Ok(Drawn {
        frame,
        view,
        report,
        method: method.info(),
        swept: seen.report(),
        prepare_ms,
        render_ms: activity.finish(),
    })
}

/// Paths from which a picture that is mostly covered is a crowd.
const CROWD: u64 = 10_000;

impl Drawn {
    /// Notes what would show more, where a crowd of paths covers the picture.
    pub(super) fn advise(&mut self, style: &Style) {
        let Rgba { r, g, b, a } = style.background;
        let pixels = self.frame.pixels();
        let bare = pixels.iter().filter(|&&p| p == [r, g, b, a]).count();
        let is_crowd = self.report.drawn >= CROWD && bare * 2 < pixels.len();
        if is_crowd && style.shading == Shading::Color {
            let note =
                "paths cover most of the picture; `--shade density` shows how many lie where";
            self.report.notes.push(note.to_owned());
        }
    }

    /// Puts the legend into the picture, or notes that there is no room for it.
    pub(super) fn stamp_legend(&mut self, scene: &Scene) {
        let fits = scene
            .legend()
            .is_none_or(|l| legend::stamp(&mut self.frame, l));
        if !fits {
            let note = "the legend is larger than the picture, so it is only in this report";
            self.report.notes.push(note.to_owned());
        }
    }
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
