//! What must hold on any device, and for any limits that it has. Whole pictures are compared with the
//! oracle's in `tests/tests/device_methods.rs`.

use std::sync::{Arc, LazyLock};

use guideway_layout::{Layout, NewPath, OwnStyle};
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, Prepared, Report, Shading, Style, View,
    density::ToneMap,
};
use guideway_scene::{LineRule, Scene, SceneOptions};
use guideway_spline::{Point, Runs};

use super::room::{Room, Size};
use super::*;
use crate::GpuOptions;
use crate::testing::here;

mod colors;
mod crowds;
mod edits;
mod levels;
mod twins;
mod work;

/// The method of all tests here, for its shaders take long to compile; none where there is no device.
static TILES: LazyLock<Result<Tiles, String>> = LazyLock::new(|| Tiles::new(Gpu::new()?, OPTIONS));

/// Tests see by its stages how a frame was drawn.
const OPTIONS: TilesOptions = TilesOptions {
    keeps: true,
    times_stages: true,
};

fn tiles() -> Option<Tiles> {
    here(&TILES)
}

fn limited(options: GpuOptions) -> Tiles {
    Tiles::new(Gpu::with_options(options).unwrap(), OPTIONS).unwrap()
}

/// With the kernels of graphics hardware: a processor may have others.
fn as_hardware() -> Tiles {
    limited(GpuOptions {
        as_hardware: true,
        ..GpuOptions::default()
    })
}

/// Bent paths of two segments, each `reach_m` long, over 100 m x 60 m.
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

/// Adds a path.
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

/// Each path with a color, some with a width, a few translucent.
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
fn the_limits_of_a_device_change_no_bit() {
    let Some(tiles) = tiles() else { return };
    let small = limited(GpuOptions {
        storage_binding_bytes: Some(64 << 10),
        ..GpuOptions::default()
    });
    let narrow = limited(GpuOptions {
        workgroups_per_dimension: Some(12),
        ..GpuOptions::default()
    });
    let checked = limited(GpuOptions {
        has_checked_shaders: true,
        ..GpuOptions::default()
    });
    let apart = limited(GpuOptions {
        without_lanes: true,
        ..GpuOptions::default()
    });
    let shared = limited(GpuOptions {
        longest_alone: Some(60),
        ..GpuOptions::default()
    });
    let hardware = as_hardware();
    for (scene, shading) in [
        (plain(3000, 8.0), Shading::Color),
        (mixed(3000, 8.0), Shading::Color),
        (colors::opaque(layout(3000, 8.0)), Shading::Color),
        (plain(3000, 8.0), Shading::Density(ToneMap::Log)),
    ] {
        let style = style(shading);
        let (expected, report) = picture(&mut prepared(&tiles, &scene), &all(), &style);
        assert_eq!(report.bands, 1);
        for (name, device, has_bands) in [
            ("small", &small, true),
            ("narrow", &narrow, false),
            ("checked", &checked, false),
            ("apart", &apart, false),
            ("shared", &shared, false),
            ("hardware", &hardware, false),
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
fn a_small_budget_draws_the_same_in_more_windows() {
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
fn strokes_whose_ends_cannot_be_told_are_refused_by_name() {
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
    // All is below a stroke of a million pixels, and one of three million is too much.
    let (frame, _) = picture(&mut prepared, &all(), &wide(5e5));
    let first = frame.pixels()[0];
    assert!(frame.pixels().iter().all(|&pixel| pixel == first) && first != [0xff; 4]);
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let refused = prepared.render(&all(), &wide(1.5e6), &Cancel::default(), &mut frame);
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("pixels far"), "{refused}");
}

#[test]
fn a_change_that_was_broken_off_is_made_good_before_anything_is_drawn() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(300, 2.0);
    let mut torn = prepared(&tiles, &scene);
    let style = Style::default();
    let (expected, _) = picture(&mut torn, &all(), &style);
    (torn.store, torn.places, torn.is_torn) = (None, None, true);
    let (drawn, report) = picture(&mut torn, &all(), &style);
    assert!(drawn == expected && report.drawn > 0);
}

#[test]
fn a_picture_moved_by_whole_pixels_is_that_of_the_view() {
    let Some(tiles) = tiles() else { return };
    for scene in [plain(2000, 4.0), mixed(2000, 4.0)] {
        let style = Style::default();
        let mut kept = prepared(&tiles, &scene);
        picture(&mut kept, &all(), &style);
        let mut moves = 0;
        for [x_px, y_px] in [
            [5.0, 0.0],
            [12.0, -20.0],
            [-40.0, 3.0],
            [-40.0, 130.0],
            [0.5, 0.0],
        ] {
            let moved = view([50.0 + x_px / 2.0, 30.0 + y_px / 2.0], 2.0);
            let (frame, report) = picture(&mut kept, &moved, &style);
            let (expected, _) = picture(&mut prepared(&tiles, &scene), &moved, &style);
            // Rounding differs by the place in the picture: a sample here and there.
            let worst = frame.pixels().iter().zip(expected.pixels()).map(|(a, b)| {
                let channels = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
                channels.max().unwrap_or(0)
            });
            assert!(worst.max().unwrap_or(0) <= 8, "{x_px} {y_px}");
            moves += usize::from(report.stages.iter().any(|stage| stage.name == "move"));
        }
        // Not the one out of sight of the one before, nor the one by half a pixel.
        assert_eq!(moves, 4);
    }
}
