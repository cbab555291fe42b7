//! Scenes and comparisons for the tests of all stages.

use std::sync::Arc;

use guideway_layout::{Layout, NewPath};
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, LineRule, Method, Prepared, Report, Rgba, Scene,
    SceneOptions, Style, View,
};
use guideway_spline::{Point, Runs};

use super::Cpu;
use crate::Oracle;

/// Numbers between -1 and 1, the same in every run.
pub(crate) fn numbers(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Paths that wander over a square of 200 m around `center`, with a control point every `step_m`.
pub(crate) fn wandering(count: usize, points: usize, step_m: f64, center: Point<f64>) -> Layout {
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

/// The layout in random colors, with the opacity of each path.
pub(crate) fn colored(mut layout: Layout, alpha: impl Fn(usize) -> u8) -> Arc<Scene> {
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

/// The layout in its own styles.
pub(crate) fn scene(layout: Layout) -> Arc<Scene> {
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

/// A view whose sides are no multiples of a tile.
pub(crate) fn view(center: Point<f64>, px_per_m: f64) -> View {
    View::new(FrameSize::new(203, 157).unwrap(), center, px_per_m).unwrap()
}

/// Strokes of one width in pixels.
pub(crate) fn wide_px(width_px: f64) -> Style {
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

/// Draws one frame of a scene.
pub(crate) fn draw(
    method: &dyn Method,
    scene: &Arc<Scene>,
    view: &View,
    style: &Style,
    budget: &Budget,
) -> (Frame, Report) {
    let mut prepared = method.prepare(Arc::clone(scene), budget).unwrap();
    draw_with(&mut *prepared, view, style)
}

/// Draws the next frame of a prepared scene.
pub(crate) fn draw_with(
    prepared: &mut dyn Prepared,
    view: &View,
    style: &Style,
) -> (Frame, Report) {
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let report = prepared
        .render(view, style, &Cancel::default(), &mut frame)
        .unwrap();
    assert!(report.accounts_for_all(), "{report:?}");
    (frame, report)
}

/// Compares with the oracle, well within the tolerances of the scene suite.
#[track_caller]
pub(crate) fn check(scene: &Arc<Scene>, view: &View, style: &Style) {
    let (ours, _) = draw(&Cpu, scene, view, style, &Budget::default());
    check_frame(&ours, scene, view, style);
}

/// Compares a picture with that of the oracle.
#[track_caller]
pub(crate) fn check_frame(ours: &Frame, scene: &Arc<Scene>, view: &View, style: &Style) {
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

/// Differences of the channels of two pictures, and their mean.
pub(crate) fn errors(ours: &Frame, other: &Frame) -> (Vec<u8>, f64) {
    let pairs = ours.pixels().iter().zip(other.pixels());
    let errors: Vec<_> = pairs.flat_map(|(&a, &b)| differences(a, b)).collect();
    let mean = errors.iter().map(|&e| f64::from(e)).sum::<f64>() / errors.len() as f64;
    (errors, mean)
}

/// Differences of two colors, premultiplied: the color of a transparent pixel is arbitrary.
pub(crate) fn differences(a: [u8; 4], b: [u8; 4]) -> [u8; 4] {
    let weighed = |[r, g, b, a]: [u8; 4]| {
        let weigh = |c: u8| ((u32::from(c) * u32::from(a) + 127) / 255) as u8;
        [weigh(r), weigh(g), weigh(b), a]
    };
    let (a, b) = (weighed(a), weighed(b));
    std::array::from_fn(|i| a[i].abs_diff(b[i]))
}

pub(crate) const ORIGIN: Point<f64> = Point { x: 0.0, y: 0.0 };
