//! Tests of the method on small scenes, for any device. `tests/tests/device_methods.rs` compares
//! whole pictures with the oracle's.

use std::sync::{Arc, LazyLock};

use guideway_gpu::testing::device_or_skip;
use guideway_gpu::{DeviceError, Gpu, GpuOptions};
use guideway_layout::{Layout, NewPath};
use guideway_scene::{
    Budget, Cancel, Clock, Frame, FrameSize, LineRule, Method, Prepared, RenderError, Report,
    Scene, SceneOptions, Style, View,
};
use guideway_spline::{Point, Runs};

use super::*;

/// The device of these tests, or the reason why it is missing.
static GPU: LazyLock<Result<Arc<Gpu>, DeviceError>> = LazyLock::new(Gpu::new);

/// The device, or `None` when the test must be skipped.
fn gpu() -> Option<Arc<Gpu>> {
    device_or_skip(&GPU)
}

/// Wavy paths over about 100 m; many of them cross.
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

fn grid(gpu: &Arc<Gpu>, variant: &str) -> Grid {
    let options = GridOptions::parse(variant).unwrap();
    Grid::new(Arc::clone(gpu), options).unwrap()
}

fn draw(gpu: &Arc<Gpu>, variant: &str, view: &View) -> (Frame, Report) {
    let prepared = grid(gpu, variant).prepare(scene(30), &Budget::default());
    picture(prepared.unwrap().as_mut(), view).unwrap()
}

fn limited(options: GpuOptions) -> Arc<Gpu> {
    Gpu::with_options(options).unwrap()
}

/// A device with bindings so small that the lines of [`scene`] need many chunks.
fn small_bindings() -> Arc<Gpu> {
    limited(GpuOptions {
        storage_binding_bytes: Some(8 << 10),
        ..GpuOptions::default()
    })
}

#[test]
fn chunks_bands_passes_and_prefix_sums_keep_the_picture() {
    let Some(gpu) = gpu() else { return };
    let small = small_bindings();
    let narrow = limited(GpuOptions {
        workgroups_per_dimension: Some(3),
        ..GpuOptions::default()
    });
    let short = limited(GpuOptions {
        loops_per_thread: Some(1),
        ..GpuOptions::default()
    });
    let view = view(70, 60, 0.8);
    for rest in [
        "",
        "+radius",
        "+radius+aa=subpixel",
        "+radius+aa=none",
        "+radius+exit",
    ] {
        let (expected, report) = draw(&gpu, &format!("scan+cells=40{rest}"), &view);
        assert_eq!(report.bands, 1);
        assert!(report.accounts_for_all());
        for (prefix, device) in [
            ("naive", &gpu),
            ("scan", &gpu),
            ("naive", &small),
            ("scan", &small),
            ("naive", &narrow),
            ("scan", &narrow),
            ("naive", &short),
        ] {
            let (frame, other) = draw(device, &format!("{prefix}+cells=40{rest}"), &view);
            assert!(frame == expected, "{prefix}{rest}");
            assert_eq!(other.lines, report.lines);
            if Arc::ptr_eq(device, &small) {
                assert!(other.bands > 1, "{} bands", other.bands);
            }
        }
    }
}

#[test]
fn early_exit_and_cell_count_keep_the_picture() {
    let Some(gpu) = gpu() else { return };
    let view = view(70, 60, 0.8);
    let (expected, _) = draw(&gpu, "scan+radius+cells=40", &view);
    assert!(draw(&gpu, "scan+radius+exit+cells=40", &view).0 == expected);
    // From one cell, over more than a block of the scan, to dozens of cells per pixel.
    for cells in [1, 7, 23, 100, 333] {
        let (frame, _) = draw(&gpu, &format!("scan+radius+cells={cells}"), &view);
        assert!(frame == expected, "{cells} cells");
    }
}

#[test]
fn naive_prefix_sum_resumes_after_the_iteration_limit() {
    let Some(_) = gpu() else { return };
    let short = limited(GpuOptions {
        loops_per_thread: Some(1),
        ..GpuOptions::default()
    });
    let view = view(70, 60, 0.8);
    let (expected, _) = draw(&short, "scan+radius+cells=100", &view);
    assert!(draw(&short, "naive+radius+cells=100", &view).0 == expected);
}

#[test]
fn draws_and_reports_all_lines() {
    let Some(gpu) = gpu() else { return };
    let (frame, report) = draw(&gpu, "scan+radius", &view(70, 60, 0.8));
    let dark = frame.pixels().iter().filter(|p| p[0] < 128).count();
    assert!((400..3000).contains(&dark), "{dark} dark pixels");
    assert_eq!((report.total, report.drawn, report.culled), (30, 30, 0));
    assert_eq!(report.lines, 30 * 6 * 9);
    let stages: Vec<_> = report.stages.iter().map(|stage| stage.name).collect();
    assert_eq!(stages, ["test pixels", "read back"]);
}

#[test]
fn preparation_times_every_phase_and_counts_atomics() {
    let Some(gpu) = gpu() else { return };
    for gpu in [gpu, small_bindings()] {
        let prepared = grid(&gpu, "cells=40")
            .prepare(scene(30), &Budget::default())
            .unwrap();
        let preparation = prepared.preparation();
        let names: Vec<_> = preparation.stages.iter().map(|stage| stage.name).collect();
        assert_eq!(
            names,
            ["bound", "pack", "sample", "count", "prefix sum", "bin"]
        );
        assert!(preparation.peak_bytes > preparation.held_bytes);
        // One per segment, and two per line and cell.
        assert!(preparation.work.atomics >= Some(30 * 6 * (1 + 2 * 9)));
    }
}

#[test]
fn host_clock_times_a_device_without_timestamps() {
    let Some(gpu) = gpu() else { return };
    let silent = limited(GpuOptions {
        without_timestamps: true,
        ..GpuOptions::default()
    });
    let view = view(70, 60, 0.8);
    let (expected, _) = draw(&gpu, "scan", &view);
    let (frame, report) = draw(&silent, "scan", &view);
    assert!(frame == expected);
    assert!(report.stages.iter().all(|stage| stage.clock == Clock::Host));
    assert!(report.frame_ms() > 0.0);
}

#[test]
fn new_rejects_options_out_of_range() {
    let Some(gpu) = gpu() else { return };
    let options = GridOptions {
        samples: 1,
        ..GridOptions::default()
    };
    let error = Grid::new(gpu, options).err();
    assert_eq!(error, Some(OptionsError::Samples { samples: 1 }.into()));
}

#[test]
fn counts_work_exactly() {
    let Some(gpu) = gpu() else { return };
    for gpu in [gpu, small_bindings()] {
        // All pixels are inside the single cell of the grid, so each tests all lines.
        let view = view(20, 15, 4.0);
        let mut prepared = grid(&gpu, "cells=1")
            .prepare(scene(30), &Budget::default())
            .unwrap();
        // Wide enough to cover pixels fully.
        let style = Style {
            line_rule: LineRule::World {
                width_m: 3.0,
                min_px: 0.0,
                max_px: f64::INFINITY,
            },
            ..Style::default()
        };
        let work = prepared
            .count_work(&view, &style, &Cancel::default())
            .unwrap();
        let lines = 30 * 6 * 9;
        assert_eq!(work.tests, Some(20 * 15 * lines));
        assert_eq!(work.atomics, Some(0));
        assert!(work.bytes_read >= Some(20 * 15 * (16 * lines + 8)));
        assert!(work.bytes_written >= Some(20 * 15 * 4));

        let mut stopping = grid(&gpu, "cells=1+exit")
            .prepare(scene(30), &Budget::default())
            .unwrap();
        let fewer = stopping
            .count_work(&view, &style, &Cancel::default())
            .unwrap();
        assert!(
            fewer.tests < work.tests && fewer.tests > Some(0),
            "{fewer:?}"
        );
    }
}

#[test]
fn every_budget_gives_the_same_picture_or_names_the_needed_bytes() {
    let Some(gpu) = gpu() else { return };
    let view = view(300, 200, 2.0);
    let (expected, full) = draw(&gpu, "scan+cells=40", &view);
    let grid = grid(&gpu, "scan+cells=40");
    let (mut refused, mut in_bands, mut whole) = (Vec::new(), 0, 0);
    for memory_bytes in (0..200).map(|step| step * 4000) {
        let budget = Budget {
            memory_bytes,
            ..Budget::default()
        };
        let drawn = grid.prepare(scene(30), &budget);
        match drawn.and_then(|mut prepared| picture(prepared.as_mut(), &view)) {
            Ok((frame, report)) => {
                assert!(frame == expected, "{memory_bytes} bytes");
                assert!(report.peak_bytes <= memory_bytes, "{report:?}");
                in_bands += usize::from(report.bands > 1);
                whole += usize::from(report.bands == 1);
            }
            Err(RenderError::Budget {
                what, needed_bytes, ..
            }) => {
                assert!(needed_bytes > memory_bytes, "{what}");
                refused.push(what);
            }
            Err(error) => panic!("{error}"),
        }
    }
    refused.dedup();
    assert!(refused.len() >= 5, "{refused:?}");
    assert!(in_bands > 0 && whole > 0 && full.bands == 1);
}

#[test]
fn reports_a_lost_device() {
    let Some(_) = gpu() else { return };
    let lost = limited(GpuOptions::default());
    let grid = grid(&lost, "scan");
    let mut prepared = grid.prepare(scene(3), &Budget::default()).unwrap();
    picture(prepared.as_mut(), &view(20, 20, 1.0)).unwrap();
    lost.lose();
    for error in [
        picture(prepared.as_mut(), &view(20, 20, 1.0)).err(),
        picture(prepared.as_mut(), &view(30, 20, 1.0)).err(),
        grid.prepare(scene(3), &Budget::default()).err(),
    ] {
        let Some(RenderError::Device { what, .. }) = error else {
            panic!("{error:?}");
        };
        assert!(what.contains("lost"), "{what}");
    }
    assert!(Grid::new(lost, GridOptions::default()).is_err());
}

#[test]
fn cancel_stops_before_the_first_submission() {
    let Some(gpu) = gpu() else { return };
    let mut prepared = grid(&gpu, "scan")
        .prepare(scene(3), &Budget::default())
        .unwrap();
    let cancel = Cancel::default();
    cancel.set();
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let outcome = prepared.render(&view(20, 20, 1.0), &Style::default(), &cancel, &mut frame);
    assert_eq!(outcome, Err(RenderError::Cancelled));
    assert!(picture(prepared.as_mut(), &view(20, 20, 1.0)).is_ok());
}

#[test]
fn rejects_views_beyond_single_precision() {
    let Some(gpu) = gpu() else { return };
    let mut prepared = grid(&gpu, "scan+radius")
        .prepare(scene(30), &Budget::default())
        .unwrap();
    // derived: coordinates up to 60 m and segments of 40 m bound the rounding by 600 m x 2^-24.
    assert!(picture(prepared.as_mut(), &view(20, 20, 2000.0)).is_ok());
    let refused = picture(prepared.as_mut(), &view(20, 20, 4000.0)).unwrap_err();
    assert!(refused.to_string().contains("pixels off"), "{refused}");
}
