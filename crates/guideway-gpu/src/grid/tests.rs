//! The method on small scenes: what must hold on any device. Whole pictures are compared with the oracle's
//! in `tests/tests/device_methods.rs`.

use std::sync::{Arc, LazyLock};

use guideway_layout::{Layout, NewPath};
use guideway_render::{
    Budget, Cancel, Frame, FrameSize, Method, Prepared, RenderError, Report, Style, View,
};
use guideway_scene::{Scene, SceneOptions};
use guideway_spline::{Point, Runs};

use super::*;

/// The device of all tests here; none where there is none.
static GPU: LazyLock<Result<Arc<Gpu>, String>> = LazyLock::new(Gpu::new);

/// A device, unless the test has to be skipped.
fn gpu() -> Option<Arc<Gpu>> {
    match &*GPU {
        Ok(gpu) => Some(Arc::clone(gpu)),
        Err(why) => {
            let is_required =
                std::env::var_os("GUIDEWAY_REQUIRE_DEVICES").is_some_and(|v| v == "1");
            assert!(!is_required, "{why}");
            println!("SKIPPED: {why}");
            None
        }
    }
}

/// Wavy paths over about 100 m, many of which cross.
fn scene(paths: u32) -> Arc<Scene> {
    let mut layout = Layout::default();
    for path in 0..paths {
        let turn = f64::from(path) * 2.399_963;
        let control: Vec<_> = (0..9)
            .map(|i| {
                let along = 12.0 * f64::from(i) - 60.0;
                let aside = 20.0 * (0.9 * f64::from(i) + turn).sin();
                let (sin, cos) = turn.sin_cos();
                Point::new(along * cos - aside * sin, along * sin + aside * cos)
            })
            .collect();
        let mut runs = Runs::default();
        runs.push(&control);
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

fn view(width: u32, height: u32, px_per_m: f64) -> View {
    let size = FrameSize::new(width, height).unwrap();
    View::new(size, Point::new(3.0, -2.0), px_per_m).unwrap()
}

fn picture(prepared: &mut dyn Prepared, view: &View) -> Result<(Frame, Report), RenderError> {
    let mut frame = Frame::new(FrameSize::new(1, 1)?);
    let report = prepared.render(view, &Style::default(), &Cancel::default(), &mut frame)?;
    Ok((frame, report))
}

fn draw(gpu: &Arc<Gpu>, variant: &str, paths: u32, view: &View) -> Frame {
    let grid = Grid::new(Arc::clone(gpu), GridOptions::parse(variant).unwrap()).unwrap();
    let mut prepared = grid.prepare(scene(paths), &Budget::default()).unwrap();
    picture(prepared.as_mut(), view).unwrap().0
}

#[test]
fn a_first_picture() {
    let Some(gpu) = gpu() else { return };
    println!("{}", gpu.adapter_name());
    let frame = draw(&gpu, "", 30, &view(120, 90, 1.0));
    assert!(frame.pixels().iter().any(|&p| p != [255; 4]));
}
