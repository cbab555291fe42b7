//! Properties that hold on any device and for any of its limits. `tests/tests/device_methods.rs`
//! compares whole pictures with the oracle.

use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use guideway_layout::{Layout, NewPath, OwnStyle};
use guideway_scene::{
    Budget, Cancel, EditOutcome, Frame, FrameSize, LineRule, Method, Prepared, RenderError, Report,
    Scene, SceneOptions, Shading, Style, View, density::ToneMap,
};
use guideway_spline::{Point, Runs};

use super::frame::capacity::Capacity;
use super::frame::line_buffers::LineBuffers;
use super::prepared::PreparedTiles;
use super::*;
use crate::device::{Gpu, kernels_beyond};
use crate::testing::device_or_skip;
use crate::{DeviceError, GpuOptions};

mod bulk_edits;
mod colors;
mod edits;
mod exact_points;
mod gesture;
mod line_cache;
mod long_lists;
mod on_device;
mod work;

/// The method of all tests: compiling its shaders takes long.
static TILES: LazyLock<Result<Tiles, DeviceError>> =
    LazyLock::new(|| Tiles::new(Gpu::new()?, OPTIONS));

/// Stage names show how a frame was drawn.
const OPTIONS: TilesOptions = TilesOptions {
    reuses_frames: true,
    times_stages: true,
};

fn tiles() -> Option<Tiles> {
    device_or_skip(&TILES)
}

/// The method on a device with limits. Tests with the same limits share it.
fn limited(options: GpuOptions) -> Tiles {
    static DEVICES: Mutex<Vec<(GpuOptions, Arc<OnceLock<Tiles>>)>> = Mutex::new(Vec::new());
    let device = {
        let mut devices = DEVICES.lock().unwrap();
        let found = devices.iter().find(|(of, _)| *of == options);
        match found.map(|(_, device)| Arc::clone(device)) {
            Some(device) => device,
            None => {
                let device = Arc::default();
                devices.push((options, Arc::clone(&device)));
                device
            }
        }
    };
    let new = || Tiles::new(Gpu::with_options(options).unwrap(), OPTIONS).unwrap();
    device.get_or_init(new).clone()
}

/// Bent paths of two segments, each about `reach_m` long, spread over 100 m x 60 m.
fn layout(paths: u32, reach_m: f64) -> Layout {
    let mut layout = Layout::default();
    for path in 0..paths {
        let f = f64::from(path);
        let at = Point::new(
            (f * 0.618_034).fract() * 100.0,
            (f * 0.754_878).fract() * 60.0,
        );
        let turn = f * 2.399_963;
        let control: Vec<_> = (0..5)
            .map(|i| {
                let bend = turn + 0.5 * f64::from(i);
                at + Point::new(bend.cos(), bend.sin()) * (reach_m * f64::from(i) / 3.0)
            })
            .collect();
        let mut runs = Runs::default();
        runs.push(&control);
        add(&mut layout, &runs);
    }
    layout
}

fn add(layout: &mut Layout, runs: &Runs) -> usize {
    layout.paths.push(&NewPath {
        runs,
        ..NewPath::default()
    })
}

fn plain(paths: u32, reach_m: f64) -> Arc<Scene> {
    let layout = Arc::new(layout(paths, reach_m));
    Arc::new(Scene::new(layout, &SceneOptions::default()).unwrap())
}

/// A color for each path, a width for some; a few are translucent.
fn mixed(paths: u32, reach_m: f64) -> Arc<Scene> {
    let mut layout = layout(paths, reach_m);
    for path in 0..paths {
        let opacity = if path % 7 == 0 { 0x90 } else { 0xff };
        let style = OwnStyle {
            width_m: (path % 3 == 0).then_some(0.4),
            color_rgba: Some(path.wrapping_mul(0x9e37_79b9) & 0xffff_ff00 | opacity),
        };
        layout.paths.set_own_style(path as usize, style);
    }
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

fn prepared(tiles: &Tiles, scene: &Arc<Scene>) -> PreparedTiles {
    PreparedTiles::new(Arc::clone(&tiles.0), Arc::clone(scene), &Budget::default()).unwrap()
}

fn view(center: [f64; 2], px_per_m: f64) -> View {
    let size = FrameSize::new(210, 130).unwrap();
    View::new(size, Point::new(center[0], center[1]), px_per_m).unwrap()
}

fn all() -> View {
    view([50.0, 30.0], 2.0)
}

fn style(shading: Shading) -> Style {
    Style {
        shading,
        ..Style::default()
    }
}

fn picture(prepared: &mut dyn Prepared, view: &View, style: &Style) -> (Frame, Report) {
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let report = prepared.render(view, style, &Cancel::default(), &mut frame);
    let report = report.unwrap();
    assert!(report.accounts_for_all(), "{report}");
    (frame, report)
}

#[test]
fn device_limits_do_not_change_the_picture() {
    let Some(tiles) = tiles() else { return };
    let small = limited(GpuOptions {
        storage_binding_bytes: Some(32 << 10),
        ..GpuOptions::default()
    });
    let narrow = limited(GpuOptions {
        workgroups_per_dimension: Some(12),
        ..GpuOptions::default()
    });
    let checked = limited(GpuOptions {
        checks_shaders: true,
        ..GpuOptions::default()
    });
    let without_subgroups = limited(GpuOptions {
        without_subgroups: true,
        ..GpuOptions::default()
    });
    let split = limited(GpuOptions {
        max_unsplit_list: Some(30),
        ..GpuOptions::default()
    });
    let integrated = limited(GpuOptions::INTEGRATED);
    for (scene, shading) in [
        (plain(700, 8.0), Shading::Color),
        (mixed(700, 8.0), Shading::Color),
        (plain(700, 8.0), Shading::Density(ToneMap::Log)),
    ] {
        let style = style(shading);
        let (expected, report) = picture(&mut prepared(&tiles, &scene), &all(), &style);
        assert_eq!(report.bands, 1);
        for (name, device, has_bands) in [
            ("small", &small, true),
            ("narrow", &narrow, false),
            ("checked", &checked, false),
            ("without subgroups", &without_subgroups, false),
            ("split", &split, false),
            ("integrated", &integrated, false),
        ] {
            let mut prepared = prepared(device, &scene);
            for _ in 0..2 {
                let (frame, report) = picture(&mut prepared, &all(), &style);
                assert!(frame.pixels() == expected.pixels(), "{name} {shading:?}");
                assert_eq!(report.bands > 1, has_bands, "{name} {shading:?}");
            }
        }
    }
}

#[test]
fn an_integrated_chip_has_the_threads_and_the_memory_of_every_workgroup() {
    let Some(tiles) = tiles() else { return };
    let _ = limited(GpuOptions::INTEGRATED);
    // These compile the kernels that wait for their first use.
    tiles.0.counting_kernels().unwrap();
    tiles.0.mapping_kernels().unwrap();
    tiles.0.presenting_kernel().unwrap();
    assert_eq!(kernels_beyond(256, 32 << 10), []);
    let beyond = |threads, bytes| kernels_beyond(threads, bytes).len();
    assert!(beyond(255, 32 << 10) > 0 && beyond(256, 2 << 10) > 0);
}

#[test]
fn small_budget_draws_the_same_picture_in_more_windows() {
    let Some(tiles) = tiles() else { return };
    let scene = mixed(3000, 8.0);
    let (expected, report) = picture(&mut prepared(&tiles, &scene), &all(), &Style::default());
    let budget = Budget {
        memory_bytes: report.peak_bytes / 2,
        ..Budget::default()
    };
    let mut prepared = tiles.prepare(Arc::clone(&scene), &budget).unwrap();
    let (frame, report) = picture(prepared.as_mut(), &all(), &Style::default());
    assert!(frame.pixels() == expected.pixels());
    assert!(
        report.bands > 1 && report.peak_bytes <= budget.memory_bytes,
        "{report:?}"
    );
}

#[test]
fn rejects_strokes_too_wide_for_the_line_format() {
    let Some(tiles) = tiles() else { return };
    let mut prepared = prepared(&tiles, &plain(30, 3.0));
    let wide = |width_m| Style {
        line_rule: LineRule::World {
            width_m,
            min_px: 0.0,
            max_px: f64::INFINITY,
        },
        ..Style::default()
    };
    // A stroke of a million pixels covers everything; three million exceed the limit.
    let (frame, _) = picture(&mut prepared, &all(), &wide(5e5));
    let first = frame.pixels()[0];
    assert!(frame.pixels().iter().all(|&pixel| pixel == first) && first != [0xff; 4]);
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let refused = prepared.render(&all(), &wide(1.5e6), &Cancel::default(), &mut frame);
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("pixels far"), "{refused}");
}

#[test]
fn uploads_the_scene_again_after_a_failed_edit() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(300, 2.0);
    let mut failed = prepared(&tiles, &scene);
    let style = Style::default();
    let (expected, _) = picture(&mut failed, &all(), &style);
    failed.scene.buffers = None;
    failed.scene.path_strokes = None;
    failed.scene.is_incomplete = true;
    let (drawn, report) = picture(&mut failed, &all(), &style);
    assert!(drawn == expected && report.drawn > 0);
}

#[test]
fn scrolled_picture_equals_the_drawn_one() {
    let Some(tiles) = tiles() else { return };
    for scene in [plain(2000, 4.0), mixed(2000, 4.0)] {
        let style = Style::default();
        let mut cached = prepared(&tiles, &scene);
        picture(&mut cached, &all(), &style);
        let mut scrolls = 0;
        for [x_px, y_px] in [
            [5.0, 0.0],
            [12.0, -20.0],
            [-40.0, 3.0],
            [-40.0, 130.0],
            [0.5, 0.0],
        ] {
            let moved = view([50.0 + x_px / 2.0, 30.0 + y_px / 2.0], 2.0);
            let (frame, report) = picture(&mut cached, &moved, &style);
            let (expected, _) = picture(&mut prepared(&tiles, &scene), &moved, &style);
            // Rounding depends on the place in the picture: single samples differ.
            let worst = frame.pixels().iter().zip(expected.pixels()).map(|(a, b)| {
                let channels = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
                channels.max().unwrap_or(0)
            });
            assert!(worst.max().unwrap_or(0) <= 8, "{x_px} {y_px}");
            scrolls += usize::from(report.stages.iter().any(|stage| stage.name == "scroll"));
        }
        // All but the one by half a pixel.
        assert_eq!(scrolls, 4);
    }
}
