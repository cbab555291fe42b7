use std::sync::Arc;

use anyhow::Result;
use guideway_cpu::{Cpu, Oracle};
use guideway_layout::Layout;
use guideway_render::{Budget, Cancel, Frame, Method, Style, View};
use guideway_scene::{LineRule, Scene, SceneOptions};

use super::{OWN_FRAMES, WIDTH_PX, time};

pub(crate) fn oracle(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<()> {
    let mut prepared = Oracle.prepare(scene(layout)?, &Budget::default())?;
    prepared.render(view, &style(), &Cancel::default(), frame)?;
    Ok(())
}

/// The first frame makes the scene ready; the others show a little more or less of the world each.
pub(super) fn draw(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    let mut prepared = None;
    time(OWN_FRAMES, |number| {
        let prepared = match &mut prepared {
            Some(prepared) => prepared,
            none => none.insert(Cpu.prepare(scene(layout)?, &Budget::default())?),
        };
        // The last one is the view that was asked for.
        let zoom = 1.0 + 0.001 * (OWN_FRAMES - 1 - number) as f64;
        let view = View::new(view.size(), view.center_m(), view.px_per_m() * zoom)?;
        let report = prepared.render(&view, &style(), &Cancel::default(), frame)?;
        eprintln!(
            "{report}: {:.1?}, {} lines, {} bytes",
            report.stages, report.lines, report.peak_bytes
        );
        Ok(())
    })
}

fn scene(layout: &Arc<Layout>) -> Result<Arc<Scene>> {
    let scene = Scene::new(Arc::clone(layout), &SceneOptions::default())?;
    Ok(Arc::new(scene))
}

fn style() -> Style {
    let line_rule = LineRule::World {
        width_m: 0.0,
        min_px: WIDTH_PX,
        max_px: WIDTH_PX,
    };
    Style {
        line_rule,
        ..Style::default()
    }
}
