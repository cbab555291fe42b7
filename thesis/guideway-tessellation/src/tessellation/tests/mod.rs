//! Tests of the method's contract on the OpenGL device of the computer.

mod declarations;
mod limits;
mod pictures;

use std::sync::{Arc, OnceLock};

use guideway_layout::{Layout, NewPath};
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, LineRule, Method, RenderError, Report, Scene, SceneOptions,
    Style, View,
};
use guideway_spline::{Point, Runs};

use super::Tessellation;
use crate::device::GlDevice;
use crate::options::{Antialias, Commands, TessellationOptions};

/// The device of these tests, or `None` without one, unless `GUIDEWAY_REQUIRE_DEVICES` is 1.
fn device() -> Option<Arc<GlDevice>> {
    static DEVICE: OnceLock<Option<Arc<GlDevice>>> = OnceLock::new();
    let open = || match GlDevice::new() {
        Ok(device) => Some(device),
        Err(error) if std::env::var("GUIDEWAY_REQUIRE_DEVICES").is_ok_and(|v| v == "1") => {
            panic!("{error}")
        }
        Err(error) => {
            eprintln!("SKIPPED: {error}");
            None
        }
    };
    DEVICE.get_or_init(open).clone()
}

fn method(commands: Commands, antialias: Antialias) -> Option<Tessellation> {
    let options = TessellationOptions {
        commands,
        antialias,
    };
    Some(Tessellation::new(device()?, options))
}

/// Every variant on the device of these tests; empty without a device.
fn every_variant() -> Vec<Tessellation> {
    let both = [Antialias::None, Antialias::Multisample];
    let commands = both.map(|aa| [(Commands::PerPath, aa), (Commands::Compact, aa)]);
    let all = commands.into_iter().flatten();
    all.filter_map(|(commands, aa)| method(commands, aa))
        .collect()
}

/// A scene with one path per list of runs.
fn scene(paths: &[Runs]) -> Arc<Scene> {
    let mut layout = Layout::default();
    for (row, runs) in paths.iter().enumerate() {
        layout.paths.push(&NewPath {
            id: &format!("P{row}"),
            runs,
            ..NewPath::default()
        });
    }
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

/// Deterministic winding paths of one to three runs, in and around 100 x 100 m.
fn winding(count: u32) -> Vec<Runs> {
    let number = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65_536.0;
    let path = |row: u32| {
        let mut runs = Runs::default();
        for run in 0..1 + row % 3 {
            let seed = 1000 * row + 100 * run;
            let start = Point::new(130.0 * number(seed) - 15.0, 130.0 * number(seed + 1) - 15.0);
            let points: Vec<_> = (0..4 + row % 5)
                .scan(start, |at, i| {
                    let step = |n| 16.0 * number(seed + n + 2 * i) - 8.0;
                    *at = Point::new(at.x + step(2), at.y + step(3));
                    Some(*at)
                })
                .collect();
            runs.push(&points);
        }
        runs
    };
    (0..count).map(path).collect()
}

fn view(width: u32, height: u32) -> View {
    let size = FrameSize::new(width, height).unwrap();
    View::new(size, Point::new(50.0, 50.0), f64::from(height) / 100.0).unwrap()
}

fn one_pixel() -> Style {
    Style {
        line_rule: LineRule::World {
            width_m: 1.0,
            min_px: 1.0,
            max_px: 1.0,
        },
        ..Style::default()
    }
}

fn draw(
    method: &Tessellation,
    scene: &Arc<Scene>,
    view: &View,
    budget: &Budget,
) -> Result<(Frame, Report), RenderError> {
    let mut frame = Frame::new(FrameSize::new(1, 1)?);
    let mut prepared = method.prepare(Arc::clone(scene), budget)?;
    let report = prepared.render(view, &one_pixel(), &Cancel::default(), &mut frame)?;
    assert!(report.accounts_for_all(), "{report:?}");
    assert_eq!(frame.size(), view.size());
    Ok((frame, report))
}
