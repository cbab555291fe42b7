//! Tests of pictures, reports, notes and work counts.

use std::sync::Arc;

use guideway_layout::{Layout, NewPath};
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, LineRule, Method, RenderError, Rgba, Scene, SceneOptions,
    Shading, Stage, Style, View,
};
use guideway_spline::{Point, Runs};

use super::{draw, every_variant, one_pixel, scene, view, winding};
use crate::options::{Antialias, Commands};

fn line(from: (f64, f64), to: (f64, f64)) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(Point::new(from.0, from.1), Point::new(to.0, to.1));
    runs
}

fn pixel(frame: &Frame, x: u32, y: u32) -> [u8; 4] {
    frame.pixels()[(y * frame.size().width() + x) as usize]
}

#[test]
fn pixel_rows_count_down_and_meters_up() {
    // A single line near the upper edge, from the left.
    let scene = scene(&[line((0.5, 97.5), (40.5, 97.5))]);
    for method in every_variant() {
        let (frame, report) = draw(&method, &scene, &view(100, 100), &Budget::default()).unwrap();
        assert_eq!((report.drawn, report.culled, report.total), (1, 0, 1));
        for y in 0..100 {
            for x in 0..100 {
                let is_line = y == 2 && (1..40).contains(&x);
                let may_be_either = y == 2 && (x == 0 || x == 40);
                let shown = pixel(&frame, x, y);
                if !may_be_either {
                    assert_eq!(shown == [0, 0, 0, 255], is_line, "{x} {y} {shown:?}");
                    assert_eq!(shown == [255; 4], !is_line, "{x} {y} {shown:?}");
                }
            }
        }
    }
}

#[test]
fn variants_draw_identical_pictures_every_time() {
    let scene = scene(&winding(500));
    let mut first: Vec<(Antialias, Frame, u64)> = Vec::new();
    for method in every_variant().into_iter().chain(every_variant()) {
        let antialias = method.options.antialias;
        let (frame, report) = draw(&method, &scene, &view(300, 200), &Budget::default()).unwrap();
        assert!(report.drawn > 100 && report.culled > 10, "{report:?}");
        let drawn = (report.drawn, report.lines);
        match first.iter().find(|(aa, ..)| *aa == antialias) {
            Some((_, expected, lines)) => {
                assert!(frame == *expected, "{:?}", method.options);
                assert_eq!(drawn.1, *lines);
            }
            None => first.push((antialias, frame, drawn.1)),
        }
    }
    assert!(first.is_empty() || first[0].1 != first[1].1);
}

#[test]
fn views_of_one_scene_are_independent() {
    let scene = scene(&winding(200));
    for method in every_variant() {
        let mut prepared = method
            .prepare(Arc::clone(&scene), &Budget::default())
            .unwrap();
        let mut frame = Frame::new(FrameSize::new(9, 9).unwrap());
        for (width, height) in [(120, 80), (64, 200), (120, 80)] {
            let view = view(width, height);
            let report = prepared
                .render(&view, &one_pixel(), &Cancel::default(), &mut frame)
                .unwrap();
            let (alone, alone_report) = draw(&method, &scene, &view, &Budget::default()).unwrap();
            assert!(frame == alone);
            assert_eq!(report.drawn, alone_report.drawn);
            let names: Vec<_> = report.stages.iter().map(|s| s.name).collect();
            assert_eq!(names, ["cull", "tessellate and draw", Stage::READ_BACK]);
            assert!(report.stages.iter().all(|s| s.elapsed_ms >= 0.0));
        }
    }
}

#[test]
fn culls_exactly_the_paths_outside_the_view() {
    let far = [(200.0, 50.0), (-100.0, 50.0), (50.0, 200.0), (50.0, -100.0)];
    let mut paths: Vec<_> = far
        .iter()
        .map(|&(x, y)| line((x, y), (x + 1.0, y)))
        .collect();
    paths.push(line((49.0, 50.0), (51.0, 50.0)));
    paths.push(Runs::default());
    for method in every_variant() {
        let (_, report) = draw(&method, &scene(&paths), &view(50, 50), &Budget::default()).unwrap();
        assert_eq!((report.drawn, report.culled, report.total), (1, 5, 6));
        let (frame, report) =
            draw(&method, &scene(&[]), &view(50, 50), &Budget::default()).unwrap();
        assert_eq!((report.drawn, report.culled, report.total), (0, 0, 0));
        assert!(frame.pixels().iter().all(|p| *p == [255; 4]));
    }
}

#[test]
fn long_bends_stay_smooth_at_large_scales() {
    // A second difference of 160,000 pixels: 64 lines would be 5 pixels off between their ends.
    let mut bend = Runs::default();
    let control = [
        (-30.0, -100.0),
        (-10.0, 100.0),
        (10.0, -100.0),
        (30.0, 100.0),
    ];
    bend.push(&control.map(|(x, y)| Point::new(x, y)));
    let scene = scene(&[bend]);
    let size = FrameSize::new(200, 200).unwrap();
    for method in every_variant() {
        for t in [0.5 / 64.0, 20.5 / 64.0, 63.5 / 64.0] {
            // On the curve, by equation 3.2.
            let weights = [
                (1.0 - t) * (1.0 - t) * (1.0 - t),
                3.0 * t * t * t - 6.0 * t * t + 4.0,
                -3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0,
                t * t * t,
            ];
            let on = |axis: fn(&(f64, f64)) -> f64| {
                let sum: f64 = control.iter().zip(weights).map(|(p, w)| axis(p) * w).sum();
                sum / 6.0
            };
            let at = Point::new(on(|p| p.0), on(|p| p.1));
            let view = View::new(size, at, 400.0).unwrap();
            let (frame, _) = draw(&method, &scene, &view, &Budget::default()).unwrap();
            let near = (98..102).flat_map(|y| (98..102).map(move |x| (x, y)));
            assert!(
                near.clone().any(|(x, y)| pixel(&frame, x, y) != [255; 4]),
                "{t}"
            );
        }
    }
}

#[test]
fn count_work_matches_the_shaders() {
    let paths = winding(300);
    let scene = scene(&paths);
    for method in every_variant() {
        let mut prepared = method
            .prepare(Arc::clone(&scene), &Budget::default())
            .unwrap();
        let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
        let (view, style, cancel) = (view(100, 80), one_pixel(), Cancel::default());
        let report = prepared.render(&view, &style, &cancel, &mut frame).unwrap();
        let work = prepared.count_work(&view, &style, &cancel).unwrap();
        assert_eq!(work.tests, None);
        // Every path has segments here, so the bytes written give the visible paths.
        let written = work.bytes_written.unwrap();
        let read = work.bytes_read.unwrap();
        match method.options.commands {
            Commands::PerPath => {
                assert_eq!(work.atomics, Some(report.drawn));
                assert_eq!(written, 20 * report.drawn);
                let vertices_read = read - 24 * 300 - written;
                assert_eq!(vertices_read % (4 * 12), 0);
                assert!(vertices_read > 0);
            }
            Commands::Compact => {
                assert_eq!(work.atomics, Some(2 * report.drawn));
                let segments = written / 4;
                assert!(segments >= report.drawn);
                assert_eq!(read, 24 * 300 + 4 * segments + 4 * 12 * segments);
            }
        }
    }
}

#[test]
fn rejects_unsupported_input_with_a_remedy() {
    let two_colors = |second: Rgba| {
        let mut layout = Layout::default();
        for row in 0..2 {
            let runs = line((10.0, 10.0 * f64::from(row)), (90.0, 50.0));
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
        }
        let color = |c: Rgba| c.to_u32();
        layout
            .paths
            .set_color_rgba(vec![color(Rgba::BLACK), color(second)]);
        Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
    };
    let translucent = SceneOptions {
        color: Some(Rgba::from_u32(0x1020_3080)),
        ..SceneOptions::default()
    };
    let plain = scene(&winding(5));
    let translucent = Scene::new(Arc::new(plain.layout().clone()), &translucent).unwrap();
    let close = View::new(view(50, 50).size(), Point::new(50.0, 50.0), 1e6).unwrap();
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..one_pixel()
    };
    for method in every_variant() {
        assert!(
            method
                .prepare(two_colors(Rgba::BLACK), &Budget::default())
                .is_ok()
        );
        let red = Rgba::opaque(255, 0, 0);
        let mut errors = Vec::new();
        errors.push(method.prepare(two_colors(red), &Budget::default()).err());
        let translucent = Arc::new(translucent.clone());
        errors.push(method.prepare(translucent, &Budget::default()).err());
        let mut prepared = method
            .prepare(Arc::clone(&plain), &Budget::default())
            .unwrap();
        let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
        let mut render = |view: &View, style: &Style| {
            let drawn = prepared.render(view, style, &Cancel::default(), &mut frame);
            let counted = prepared.count_work(view, style, &Cancel::default());
            assert_eq!(drawn.as_ref().err(), counted.as_ref().err());
            drawn.err()
        };
        errors.push(render(&view(50, 50), &density));
        errors.push(render(&close, &one_pixel()));
        assert_eq!(render(&view(50, 50), &one_pixel()), None);
        for (error, named) in errors.into_iter().zip([
            "several colors",
            "translucent",
            "density",
            "single precision",
        ]) {
            match error {
                Some(RenderError::Unsupported { what, remedy, .. }) => {
                    assert!(what.contains(named) && remedy.ends_with('.'), "{what}");
                }
                other => panic!("{named}: {other:?}"),
            }
        }
    }
}

#[test]
fn notes_differences_and_stops_when_cancelled() {
    let mut paths = winding(5);
    paths.push(line((50.0, 50.0), (50.0, 50.0)));
    let scene = scene(&paths);
    for method in every_variant() {
        let is_gapped = method.device.is_software() && method.options.antialias != Antialias::None;
        let mut prepared = method
            .prepare(Arc::clone(&scene), &Budget::default())
            .unwrap();
        let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
        for (rule, notes) in [
            (one_pixel().line_rule, 0),
            (LineRule::default(), 1),
            (LineRule::Thesis, 1),
        ] {
            let style = Style {
                line_rule: rule,
                ..Style::default()
            };
            let report = prepared
                .render(&view(50, 50), &style, &Cancel::default(), &mut frame)
                .unwrap();
            let notes_on = |text: &str| report.notes.iter().filter(|n| n.contains(text)).count();
            assert_eq!(
                notes_on("one pixel wide"),
                notes,
                "{rule:?}: {:?}",
                report.notes
            );
            assert_eq!(notes_on("shorter than a pixel"), 1);
            assert_eq!(notes_on("gaps"), usize::from(is_gapped));
        }
        let cancel = Cancel::default();
        cancel.set();
        let stopped = prepared.render(&view(50, 50), &one_pixel(), &cancel, &mut frame);
        assert_eq!(stopped, Err(RenderError::Cancelled));
    }
}

#[test]
fn line_keeps_its_color_on_a_translucent_background() {
    let scene = scene(&[line((10.0, 20.0), (90.0, 70.0))]);
    let style = Style {
        background: Rgba::from_u32(0xff80_4000),
        ..one_pixel()
    };
    for method in every_variant() {
        let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
        let prepared = method.prepare(Arc::clone(&scene), &Budget::default());
        prepared
            .unwrap()
            .render(&view(100, 100), &style, &Cancel::default(), &mut frame)
            .unwrap();
        let shown = || frame.pixels().iter().filter(|p| p[3] > 0);
        assert!(shown().count() > 70);
        assert!(shown().all(|&[r, g, b, _]| (r, g, b) == (0, 0, 0)));
        let partly = shown().filter(|p| p[3] < 255).count();
        assert_eq!(
            partly > 0,
            method.options.antialias == Antialias::Multisample
        );
    }
}
