use std::sync::Arc;

use guideway::render::{
    Budget, Cancel, Frame, FrameSize, Method, MethodInfo, RenderError, Report, Shading, Style, View,
};
use guideway::scene::{Rgba, Scene, SceneOptions};
use guideway::spline::Point;

use super::legend;
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
pub(crate) struct Drawn {
    pub(crate) frame: Frame,
    pub(crate) view: View,
    pub(crate) report: Report,
    pub(crate) method: MethodInfo,
    pub(crate) prepare_ms: f64,
    pub(crate) render_ms: f64,
}

/// Draws a scene, showing that it is being drawn.
pub(crate) fn draw(
    method: &dyn Method,
    scene: &Arc<Scene>,
    wishes: &Wishes,
    out: &Output,
) -> Result<Drawn, Failure> {
    let view = view(scene, wishes)?;
    let activity = out.activity("preparing");
    let mut prepared = method.prepare(Arc::clone(scene), &wishes.budget)?;
    let prepare_ms = activity.finish();
    let activity = out.activity("drawing");
    let mut frame = Frame::new(view.size());
    let report = prepared.render(&view, &wishes.style, &Cancel::default(), &mut frame)?;
    Ok(Drawn {
        frame,
        view,
        report,
        method: method.info(),
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

fn view(scene: &Scene, wishes: &Wishes) -> Result<View, RenderError> {
    let all = View::fit(wishes.size, scene.bounds())?;
    View::new(
        wishes.size,
        wishes.center_m.unwrap_or(all.center_m()),
        wishes.px_per_m.unwrap_or(all.px_per_m()),
    )
}
