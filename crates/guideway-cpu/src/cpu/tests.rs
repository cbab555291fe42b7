//! Whole pictures, compared with the oracle's, and with each other where they have to be the same.

use std::sync::Arc;

use guideway_layout::{Layout, NewPath, OwnStyle};
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, Cancel, EditOutcome, Frame, FrameSize, Method, Prepared, RenderError, Report, Shading,
    Style, View,
};
use guideway_scene::{Edit, Insertion, LineRule, PathState, Rgba, Scene, SceneOptions};
use guideway_spline::{Affine, Point, Runs};

use super::Cpu;
use super::prepared::CpuPrepared;
use crate::Oracle;

mod crossings;
mod fills;
mod joins;
mod kept;
mod lanes;
mod moved;
mod threads;

/// Numbers below 1 in magnitude, the same on every run.
fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Paths that wander over a square of 200 m around `center`, `step_m` from one control point to the next.
fn wandering(count: usize, points: usize, step_m: f64, center: Point<f64>) -> Layout {
    let mut next = numbers(count as u64);
    let mut layout = Layout::default();
    for _ in 0..count {
        let mut at = center + Point::new(next(), next()) * 100.0;
        let mut heading = 4.0 * next();
        let control: Vec<_> = (0..points)
            .map(|_| {
                heading += 0.7 * next();
                at = at + Point::new(heading.cos(), heading.sin()) * step_m;
                at
            })
            .collect();
        let mut runs = Runs::default();
        runs.push(&control);
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout
}

fn colored(mut layout: Layout, alpha: impl Fn(usize) -> u8) -> Arc<Scene> {
    let mut next = numbers(9);
    let colors = (0..layout.paths.len()).map(|i| {
        let mut channel = || (127.5 * (next() + 1.0)) as u8;
        let (r, g, b) = (channel(), channel(), channel());
        let a = alpha(i);
        Rgba { r, g, b, a }.to_u32()
    });
    let colors = colors.collect();
    layout.paths.set_color_rgba(colors);
    scene(layout)
}

fn scene(layout: Layout) -> Arc<Scene> {
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

fn view(center: Point<f64>, px_per_m: f64) -> View {
    View::new(FrameSize::new(203, 157).unwrap(), center, px_per_m).unwrap()
}

fn wide_px(width_px: f64) -> Style {
    let line_rule = LineRule::World {
        width_m: 0.0,
        min_px: width_px,
        max_px: width_px,
    };
    Style {
        line_rule,
        ..Style::default()
    }
}

fn draw(
    method: &dyn Method,
    scene: &Arc<Scene>,
    view: &View,
    style: &Style,
    budget: &Budget,
) -> (Frame, Report) {
    let mut prepared = method.prepare(Arc::clone(scene), budget).unwrap();
    draw_with(&mut *prepared, view, style)
}

/// Draws the next frame of what is prepared.
fn draw_with(prepared: &mut dyn Prepared, view: &View, style: &Style) -> (Frame, Report) {
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let report = prepared
        .render(view, style, &Cancel::default(), &mut frame)
        .unwrap();
    assert!(report.accounts_for_all(), "{report:?}");
    (frame, report)
}

/// Draws with both, and compares far below what is allowed.
#[track_caller]
fn check(scene: &Arc<Scene>, view: &View, style: &Style) {
    let (ours, _) = draw(&Cpu, scene, view, style, &Budget::default());
    check_frame(&ours, scene, view, style);
}

/// Compares a picture with what the oracle draws.
#[track_caller]
fn check_frame(ours: &Frame, scene: &Arc<Scene>, view: &View, style: &Style) {
    let (exact, _) = draw(&Oracle, scene, view, style, &Budget::default());
    let (errors, mean) = errors(ours, &exact);
    let far = errors.iter().filter(|&&e| e > 16).count();
    let most = errors.iter().max().unwrap();
    let is_near = mean <= 0.75 && far * 2000 <= errors.len() && *most <= 64;
    assert!(
        is_near,
        "mean {mean}, {far} of {} above 16, most {most}",
        errors.len()
    );
}

/// How far the channels of two pictures are apart, each and on the mean.
fn errors(ours: &Frame, other: &Frame) -> (Vec<u8>, f64) {
    let pairs = ours.pixels().iter().zip(other.pixels());
    let errors: Vec<_> = pairs.flat_map(|(&a, &b)| differences(a, b)).collect();
    let mean = errors.iter().map(|&e| f64::from(e)).sum::<f64>() / errors.len() as f64;
    (errors, mean)
}

/// Of the colors as they weigh: what is hardly there may have any color.
fn differences(a: [u8; 4], b: [u8; 4]) -> [u8; 4] {
    let weighed = |[r, g, b, a]: [u8; 4]| {
        let weigh = |c: u8| ((u32::from(c) * u32::from(a) + 127) / 255) as u8;
        [weigh(r), weigh(g), weigh(b), a]
    };
    let (a, b) = (weighed(a), weighed(b));
    std::array::from_fn(|i| a[i].abs_diff(b[i]))
}

const ORIGIN: Point<f64> = Point { x: 0.0, y: 0.0 };

#[test]
fn opaque_paths_look_as_the_oracle_draws_them() {
    let scene = colored(wandering(150, 11, 3.0, ORIGIN), |_| 255);
    for width_px in [0.02, 0.3, 1.5] {
        for px_per_m in [0.4, 1.0, 7.0] {
            check(&scene, &view(ORIGIN, px_per_m), &wide_px(width_px));
        }
    }
    check(&scene, &view(ORIGIN, 1.0), &wide_px(12.0));
    check(
        &scene,
        &view(Point::new(7.0, -3.0), 30.0),
        &Style::default(),
    );
}

#[test]
fn translucent_paths_look_as_the_oracle_draws_them() {
    let scene = colored(wandering(150, 11, 3.0, ORIGIN), |i| {
        [255, 90, 0, 200, 255][i % 5]
    });
    for width_px in [0.3, 6.0] {
        let mut style = wide_px(width_px);
        check(&scene, &view(ORIGIN, 1.0), &style);
        style.background = Rgba::from_u32(0x2060_a050);
        check(&scene, &view(ORIGIN, 1.0), &style);
        style.background = Rgba::from_u32(0x2060_a000);
        check(&scene, &view(ORIGIN, 1.0), &style);
    }
}

#[test]
fn densities_look_as_the_oracle_draws_them() {
    let scene = colored(wandering(150, 11, 3.0, ORIGIN), |_| 255);
    for tone in [ToneMap::Linear, ToneMap::Log] {
        let style = Style {
            shading: Shading::Density(tone),
            ..wide_px(2.0)
        };
        check(&scene, &view(ORIGIN, 0.7), &style);
    }
}

#[test]
fn neither_distance_nor_zoom_costs_accuracy() {
    let far = Point::new(1e7, -4e6);
    let scene = colored(wandering(300, 11, 3.0, far), |_| 255);
    check(&scene, &view(far, 1.0), &wide_px(1.5));
    // The middle of a line of 10^9 pixels, and what crosses it.
    let mut layout = wandering(3, 11, 3.0, ORIGIN);
    let mut runs = Runs::default();
    runs.push_line(Point::new(-1e4, -2.5e3), Point::new(1e4, 2.5e3));
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    runs.clear();
    runs.push(&[(-9e3, -1e3), (-1.0, 2.0), (1.0, -2.0), (9e3, 1e3)].map(|(x, y)| Point::new(x, y)));
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    let scene = colored(layout, |_| 255);
    for px_per_m in [1.0, 1e3, 1e5] {
        check(&scene, &view(ORIGIN, px_per_m), &wide_px(3.0));
    }
}

#[test]
fn a_path_of_no_length_is_a_dot() {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    runs.push(&[Point::new(0.3, 0.2); 4]);
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    check(&scene(layout), &view(ORIGIN, 10.0), &wide_px(20.0));
}

#[test]
fn threads_bands_and_earlier_frames_do_not_show() {
    let scene = colored(wandering(3000, 11, 3.0, ORIGIN), |i| [255, 200][i % 2]);
    let style = wide_px(1.5);
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..style
    };
    for style in [style, density] {
        let view = view(ORIGIN, 0.8);
        let one = Budget {
            threads: 1,
            ..Budget::default()
        };
        let (expected, report) = draw(&Cpu, &scene, &view, &style, &one);
        assert_eq!(report.bands, 1);
        let four = Budget {
            threads: 4,
            ..Budget::default()
        };
        let mut prepared = Cpu.prepare(Arc::clone(&scene), &four).unwrap();
        let mut frame = expected.clone();
        for px_per_m in [0.8, 20.0, 0.8] {
            let view = View::new(view.size(), ORIGIN, px_per_m).unwrap();
            prepared
                .render(&view, &style, &Cancel::default(), &mut frame)
                .unwrap();
        }
        assert_eq!(frame, expected);
        // A little less than all at once takes, the picture included.
        let whole = report.peak_bytes + 4 * view.size().pixels() as u64;
        let little = Budget {
            memory_bytes: whole - 50_000,
            threads: 1,
        };
        let (banded, in_bands) = draw(&Cpu, &scene, &view, &style, &little);
        assert!(in_bands.bands > 1, "{in_bands:?}");
        assert_eq!(
            (in_bands.drawn, in_bands.lines),
            (report.drawn, report.lines)
        );
        assert!(in_bands.peak_bytes <= little.memory_bytes);
        assert_eq!(banded, expected);
    }
}

#[test]
fn thin_strokes_that_share_pixels_are_neither_too_dark_nor_too_pale() {
    let (scene, view) = (scene(wandering(20_000, 11, 3.0, ORIGIN)), view(ORIGIN, 0.8));
    for width_px in [0.09, 0.3] {
        let light = |method: &dyn Method| {
            let (frame, _) = draw(
                method,
                &scene,
                &view,
                &wide_px(width_px),
                &Budget::default(),
            );
            let sum: f64 = frame.pixels().iter().map(|pixel| f64::from(pixel[0])).sum();
            sum / frame.pixels().len() as f64
        };
        let (ours, exact) = (light(&Cpu), light(&Oracle));
        assert!((ours - exact).abs() < 0.1, "{width_px}: {ours}, {exact}");
    }
}

#[test]
fn strips_are_rows_of_the_whole() {
    let scene = colored(wandering(3000, 11, 3.0, ORIGIN), |i| [255, 200][i % 2]);
    let cancel = Cancel::default();
    let densities = [ToneMap::Log, ToneMap::Equalized].map(Shading::Density);
    for shading in [Shading::Color].into_iter().chain(densities) {
        // Lines that are kept from one strip to the next, and others that are cut for each.
        for px_per_m in [0.8, 20.0, 60_000.0] {
            let style = Style {
                shading,
                ..wide_px(1.5)
            };
            let size = FrameSize::new(200, 300).unwrap();
            let view = View::new(size, ORIGIN, px_per_m).unwrap();
            let (whole, report) = draw(&Cpu, &scene, &view, &style, &Budget::default());
            let mut prepared = Cpu.prepare(Arc::clone(&scene), &Budget::default()).unwrap();
            let (mut rows, mut joined) = (whole.pixels().iter(), None::<Report>);
            for strip in view.strips(0) {
                let mut frame = Frame::new(strip.size());
                let of_strip = prepared
                    .render_strip(&strip, &style, &cancel, &mut frame)
                    .unwrap();
                assert!(
                    frame
                        .pixels()
                        .iter()
                        .eq(rows.by_ref().take(frame.pixels().len()))
                );
                match &mut joined {
                    Some(joined) => joined.join(of_strip),
                    none => *none = Some(of_strip),
                }
            }
            let joined = joined.unwrap();
            assert_eq!((rows.next(), joined.bands), (None, 5));
            assert!(joined.accounts_for_all());
            assert_eq!((joined.drawn, joined.lines), (report.drawn, report.lines));
        }
    }
}

#[test]
fn too_little_memory_and_a_call_to_stop_are_told() {
    let scene = colored(wandering(3000, 11, 3.0, ORIGIN), |_| 255);
    let budget = |memory_bytes| Budget {
        memory_bytes,
        threads: 1,
    };
    assert!(matches!(
        Cpu.prepare(Arc::clone(&scene), &budget(1000)),
        Err(RenderError::Budget { .. })
    ));
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let mut prepared = Cpu.prepare(Arc::clone(&scene), &budget(300_000)).unwrap();
    let cancel = Cancel::default();
    let (view, style) = (view(ORIGIN, 0.8), wide_px(1.5));
    let refused = prepared.render(&view, &style, &cancel, &mut frame);
    assert!(
        matches!(refused, Err(RenderError::Budget { .. })),
        "{refused:?}"
    );
    cancel.set();
    let mut prepared = Cpu.prepare(scene, &Budget::default()).unwrap();
    let stopped = prepared.render(&view, &style, &cancel, &mut frame);
    assert_eq!(stopped, Err(RenderError::Cancelled));
}

#[test]
fn an_edited_scene_looks_as_one_made_so() {
    let before = colored(wandering(500, 11, 3.0, ORIGIN), |i| [255, 120][i % 2]);
    let moved: Arc<[u32]> = (0..500).step_by(7).collect();
    let hidden: Arc<[_]> = (0..500)
        .step_by(11)
        .map(|i| (i, PathState::Hidden))
        .collect();
    let mut runs = Runs::default();
    runs.push_line(Point::new(-80.0, -3.0), Point::new(70.0, 5.0));
    let own = OwnStyle {
        width_m: Some(9.0),
        color_rgba: Some(0xff00_40ff),
    };
    let inserted = Insertion {
        runs,
        ..Insertion::default()
    };
    let mapped = |paths: &Arc<[u32]>, by| Edit::Transform {
        paths: Arc::clone(paths),
        by,
    };
    let all: Arc<[u32]> = (0..500).collect();
    let edits = [
        mapped(&moved, Affine::translation(Point::new(4.0, -30.0))),
        mapped(&all, Affine::translation(Point::new(-9.0, 7.0))),
        mapped(&all, Affine::rotation(0.05, ORIGIN)),
        mapped(&all, Affine::rotation(1.5, Point::new(20.0, 3.0))),
        Edit::SetStates(hidden),
        Edit::Insert(Arc::new([inserted])),
        Edit::Restyle(Arc::new([(3, own), (4, own)])),
    ];
    let mut prepared = Cpu
        .prepare(Arc::clone(&before), &Budget::default())
        .unwrap();
    let mut scene = Scene::clone(&before);
    let (view, style) = (view(ORIGIN, 0.8), Style::default());
    draw_with(&mut *prepared, &view, &style);
    for edit in edits {
        scene.edit(&edit).unwrap();
        assert_eq!(
            prepared.edit(&edit),
            Ok(EditOutcome::InPlace { moved_bytes: 0 })
        );
        let (frame, _) = draw_with(&mut *prepared, &view, &style);
        check_frame(&frame, &Arc::new(scene.clone()), &view, &style);
    }
}
