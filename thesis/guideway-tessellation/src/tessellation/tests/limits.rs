//! Tests with small devices, small budgets and failing allocations.

use guideway_scene::{Budget, Method, RenderError};
use guideway_spline::{Point, Runs};

use super::super::plan::Plan;
use super::{Tessellation, draw, every_variant, method, scene, view, winding};
use crate::options::{Antialias, Commands};

fn within(memory_bytes: u64) -> Budget {
    Budget {
        memory_bytes,
        ..Budget::default()
    }
}

#[test]
fn chunks_keep_the_picture() {
    let paths = winding(400);
    let scene = scene(&paths);
    for method in every_variant() {
        let (whole, report) = draw(&method, &scene, &view(160, 120), &Budget::default()).unwrap();
        for (buffer_bytes, workgroups) in [(4096, 65_535), (1 << 20, 1), (700, 2)] {
            let mut small = method.clone();
            small.limits.buffer_bytes = buffer_bytes;
            small.limits.workgroups = workgroups;
            let plan = Plan::new(&scene, method.options.commands, &small.limits).unwrap();
            assert!(plan.chunks.len() > 3, "{} chunks", plan.chunks.len());
            let (cut, cut_report) =
                draw(&small, &scene, &view(160, 120), &Budget::default()).unwrap();
            assert!(cut == whole, "{buffer_bytes} {workgroups}");
            assert_eq!(
                (cut_report.drawn, cut_report.lines),
                (report.drawn, report.lines)
            );
        }
    }
}

#[test]
fn tiles_keep_the_picture() {
    let scene = scene(&winding(300));
    let view = view(200, 90);
    for method in every_variant() {
        let (whole, report) = draw(&method, &scene, &view, &Budget::default()).unwrap();
        assert_eq!(report.bands, 1);
        let mut small = method.clone();
        small.limits.picture_side = 128;
        let (tiled, tiled_report) = draw(&small, &scene, &view, &Budget::default()).unwrap();
        assert_eq!(tiled_report.bands, 4 * 2);
        assert_eq!(
            (tiled_report.drawn, tiled_report.lines),
            (report.drawn, report.lines)
        );
        // The small viewport clips lines that leave it, which rounds their ends again.
        let differing = tiled
            .pixels()
            .iter()
            .zip(whole.pixels())
            .filter(|(a, b)| a != b);
        let differing = differing.count();
        assert!(differing <= 20, "{differing} pixels differ");
    }
}

#[test]
fn small_budgets_draw_in_bands_or_are_rejected() {
    let scene = scene(&winding(50));
    let view = view(320, 240);
    for method in every_variant() {
        let (whole, report) = draw(&method, &scene, &view, &Budget::default()).unwrap();
        let held = report.peak_bytes + 4 * 320 * 240;
        let fits = |memory_bytes: u64| draw(&method, &scene, &view, &within(memory_bytes));
        // The staging memory exceeds that of this picture.
        let staging = super::super::chunk::STAGING_BYTES;
        assert!(held < staging);
        let (mut bands, mut refused) = (1, 0);
        for memory_bytes in (0..8).map(|i| (staging + held) >> i) {
            match fits(memory_bytes) {
                Ok((frame, report)) => {
                    assert!(frame == whole, "within {memory_bytes}");
                    bands = bands.max(report.bands);
                }
                Err(RenderError::Budget {
                    needed_bytes,
                    budget_bytes,
                    ..
                }) => {
                    assert!(needed_bytes > budget_bytes && budget_bytes == memory_bytes);
                    refused += 1;
                }
                Err(error) => panic!("{error}"),
            }
        }
        assert!(refused > 0);
    }
}

#[test]
fn plan_bounds_and_report_states_the_bytes() {
    let scene = scene(&winding(200));
    for method in every_variant() {
        let budget = Budget::default();
        let prepared = method
            .prepare(std::sync::Arc::clone(&scene), &budget)
            .unwrap();
        let held = prepared.preparation().held_bytes;
        let plan = Plan::new(&scene, method.options.commands, &method.limits).unwrap();
        assert!(held >= plan.bytes(method.options.commands));
        assert!(prepared.preparation().peak_bytes > held);
        let (_, report) = draw(&method, &scene, &view(64, 48), &budget).unwrap();
        let surfaces = match method.options.antialias {
            Antialias::None => 1,
            Antialias::Multisample => u64::from(method.limits.samples.min(8)) + 1,
        };
        assert_eq!(report.peak_bytes, held + 64 * 48 * 4 * surfaces);
    }
}

#[test]
fn out_of_memory_names_the_allocation() {
    let scene = scene(&winding(50));
    for method in every_variant() {
        let mut names = Vec::new();
        for allocations in 0.. {
            let mut small = method.clone();
            small.limits.allocations = allocations;
            match draw(&small, &scene, &view(64, 48), &Budget::default()) {
                Ok(_) => break,
                Err(RenderError::Device { what, .. }) => names.push(what),
                Err(error) => panic!("{error}"),
            }
        }
        let all = names.join("\n");
        for named in [
            "control points",
            "paths",
            "counters",
            "the view",
            "picture of 64 x 48",
        ] {
            assert!(all.contains(named), "{named} is not in:\n{all}");
        }
        assert!(draw(&method, &scene, &view(64, 48), &Budget::default()).is_ok());
    }
}

#[test]
fn rejects_a_path_beyond_one_buffer_by_name() {
    let mut long = Runs::default();
    let points: Vec<_> = (0..1000).map(|i| Point::new(f64::from(i), 0.0)).collect();
    long.push(&points);
    let mut paths = winding(3);
    paths.push(long);
    let scene = scene(&paths);
    for commands in [Commands::PerPath, Commands::Compact] {
        let Some(mut method): Option<Tessellation> = method(commands, Antialias::None) else {
            return;
        };
        method.limits.buffer_bytes = 3000;
        match draw(&method, &scene, &view(64, 48), &Budget::default()) {
            Err(RenderError::Unsupported { what, remedy, .. }) => {
                assert!(what.contains("`P3`") && what.contains("3000"), "{what}");
                assert!(!remedy.is_empty());
            }
            other => panic!("{other:?}"),
        }
    }
}
