//! Guideway: method `cpu` in a zoom, and `oracle` as the reference.

use std::sync::Arc;

use anyhow::Result;
use guideway_bench::Motion;
use guideway_cpu::{Cpu, Oracle};
use guideway_layout::Layout;
use guideway_scene::{Budget, Cancel, Frame, LineRule, Method, Scene, SceneOptions, Style, View};

use super::shared::{WIDTH_PX, time};

/// Frames of a zoom in and out, which ends at the requested view.
const ZOOM_FRAMES: usize = 65;

/// Renders the reference picture.
pub(crate) fn oracle(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<()> {
    let mut prepared = Oracle.prepare(scene(layout)?, &Budget::default())?;
    prepared.render(view, &style(), &Cancel::default(), frame)?;
    Ok(())
}

/// Renders a zoom in and out. The first frame includes the preparation of the scene; the last one
/// shows the requested view.
pub(super) fn draw(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    let mut prepared = None;
    time(ZOOM_FRAMES, |number| {
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
