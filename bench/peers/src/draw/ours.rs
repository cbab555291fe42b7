use std::sync::Arc;

use anyhow::Result;
use guideway_bench::Motion;
use guideway_cpu::{Cpu, Oracle};
use guideway_layout::Layout;
use guideway_scene::{Budget, Cancel, Frame, Method, Style, View};
use guideway_scene::{LineRule, Scene, SceneOptions};

use super::{OWN_FRAMES, WIDTH_PX, time};

pub(crate) fn oracle(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<()> {
    let mut prepared = Oracle.prepare(scene(layout)?, &Budget::default())?;
    prepared.render(view, &style(), &Cancel::default(), frame)?;
    Ok(())
}

/// The first frame makes the scene ready; the others come nearer and go away again. The last one is the view that was asked for.
pub(super) fn draw(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    let mut prepared = None;
    time(OWN_FRAMES, |number| {
        let prepared = match &mut prepared {
            Some(prepared) => prepared,
            none => none.insert(Cpu.prepare(scene(layout)?, &Budget::default())?),
        };
        let view = Motion::Zoom.view(view, number)?;
        prepared.render(&view, &style(), &Cancel::default(), frame)?;
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
