//! The oracle against closed forms, and against points of the curve from the Cox-de Boor recursion.

use std::f64::consts::PI;
use std::sync::Arc;

use guideway_layout::{Layout, NewPath};
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, RenderError, Report, Shading, Style, View,
};
use guideway_scene::{LineRule, Rgba, Scene, SceneOptions};
use guideway_spline::{Point, Runs};

use super::Oracle;

fn point(x: f64, y: f64) -> Point<f64> {
    Point::new(x, y)
}

fn line(start: Point<f64>, end: Point<f64>) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(start, end);
    runs
}

fn curve(control: &[Point<f64>]) -> Runs {
    let mut runs = Runs::default();
    runs.push(control);
    runs
}

fn layout(paths: &[Runs]) -> Layout {
    let mut layout = Layout::default();
    for runs in paths {
        layout.paths.push(&NewPath {
            runs,
            ..NewPath::default()
        });
    }
    layout
}

/// One meter per pixel, the origin in the lower left corner.
fn view(width: u32, height: u32) -> View {
    let middle = point(f64::from(width) / 2.0, f64::from(height) / 2.0);
    View::new(FrameSize::new(width, height).unwrap(), middle, 1.0).unwrap()
}

fn wide(width_m: f64) -> Style {
    let line_rule = LineRule::World {
        width_m,
        min_px: 0.0,
        max_px: f64::INFINITY,
    };
    Style {
        line_rule,
        ..Style::default()
    }
}

fn draw_within(
    layout: Layout,
    color: Rgba,
    view: &View,
    style: &Style,
    memory_bytes: u64,
) -> Result<(Frame, Report), RenderError> {
    let options = SceneOptions {
        color: Some(color),
        ..SceneOptions::default()
    };
    let scene = Arc::new(Scene::new(Arc::new(layout), &options).unwrap());
    let budget = Budget {
        memory_bytes,
        threads: 1,
    };
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let mut prepared = Oracle.prepare(scene, &budget)?;
    let report = prepared.render(view, style, &Cancel::default(), &mut frame)?;
    assert!(report.accounts_for_all());
    Ok((frame, report))
}

fn draw(layout: Layout, color: Rgba, view: &View, style: &Style) -> (Frame, Report) {
    draw_within(layout, color, view, style, 1 << 30).unwrap()
}

/// Coverage per pixel of black paths on white.
fn coverage(paths: &[Runs], view: &View, style: &Style) -> Vec<f64> {
    let (frame, _) = draw(layout(paths), Rgba::BLACK, view, style);
    let ink = |p: &[u8; 4]| 1.0 - f64::from(p[0]) / 255.0;
    frame.pixels().iter().map(ink).collect()
}

#[test]
fn a_level_line_covers_its_share_of_each_row() {
    // From 3.25 to 5.75 m up in a picture of 10 rows: rows 4 to 6, the outer ones to three
    // quarters.
    let across = line(point(-10.0, 4.5), point(30.0, 4.5));
    let ink = coverage(&[across], &view(20, 10), &wide(2.5));
    for (row, expected) in [(3, 0.0), (4, 0.75), (5, 1.0), (6, 0.75), (7, 0.0)] {
        for column in 0..20 {
            let got = ink[row * 20 + column];
            assert!((got - expected).abs() < 0.003, "row {row}: {got}");
        }
    }
}

#[test]
fn lines_and_dots_have_the_area_of_a_capsule() {
    for (dx, dy, width) in [(23.0, 11.0, 3.0), (-17.0, 29.0, 0.7), (0.0, 0.0, 9.0)] {
        let start = point(30.3, 25.6);
        let path = line(start, start + point(dx, dy));
        let area: f64 = coverage(&[path], &view(80, 64), &wide(width)).iter().sum();
        let expected = f64::hypot(dx, dy) * width + PI * width * width / 4.0;
        assert!(
            (area / expected - 1.0).abs() < 0.004,
            "{area} against {expected}"
        );
    }
}

#[test]
fn a_path_that_crosses_itself_covers_once() {
    let bow = curve(&[
        point(-30.0, -60.0),
        point(70.0, 60.0),
        point(-30.0, 60.0),
        point(70.0, -60.0),
    ]);
    let red = Rgba {
        r: 255,
        g: 0,
        b: 0,
        a: 128,
    };
    let (frame, _) = draw(
        layout(std::slice::from_ref(&bow)),
        red,
        &view(40, 60),
        &wide(6.0),
    );
    let inside = [255, 127, 127, 255];
    assert!(frame.pixels().contains(&inside));
    assert!(frame.pixels().iter().all(|p| p[1] >= inside[1]));
    // Two paths are darker.
    let (twice, _) = draw(layout(&[bow.clone(), bow]), red, &view(40, 60), &wide(6.0));
    assert!(twice.pixels().contains(&[255, 63, 63, 255]));
}

#[test]
fn a_color_over_transparency_keeps_its_hue() {
    let style = Style {
        background: Rgba::from_u32(0x1122_3300),
        ..wide(2.0)
    };
    let blue = Rgba {
        r: 10,
        g: 20,
        b: 200,
        a: 128,
    };
    let half = line(point(-9.0, 4.0), point(19.0, 4.0));
    let shifted = line(point(-9.0, 4.5), point(19.0, 4.5));
    let (frame, _) = draw(layout(&[half]), blue, &view(10, 8), &style);
    assert_eq!(frame.pixels()[35], [10, 20, 200, 128]);
    assert_eq!(frame.pixels()[5], [0x11, 0x22, 0x33, 0]);
    let (frame, _) = draw(layout(&[shifted]), blue, &view(10, 8), &style);
    assert_eq!(frame.pixels()[45], [10, 20, 200, 64]);
}

/// The basis function `i` of order `k` over the knots 0, 1, 2, ...
fn cox_de_boor(i: usize, k: usize, t: f64) -> f64 {
    let knot = i as f64;
    if k == 1 {
        return f64::from((knot..knot + 1.0).contains(&t));
    }
    let span = (k - 1) as f64;
    (t - knot) / span * cox_de_boor(i, k - 1, t)
        + (knot + span + 1.0 - t) / span * cox_de_boor(i + 1, k - 1, t)
}

#[test]
fn coverage_matches_dense_points_of_the_curve() {
    let control = [
        point(-4.0, 3.0),
        point(4.0, 16.0),
        point(6.0, -3.0),
        point(15.0, 8.0),
        point(15.0, 8.0),
        point(16.0, 16.0),
        point(30.0, -2.0),
    ];
    let (width, height, radius) = (24, 14, 1.3);
    let on_curve: Vec<_> = (0..=800)
        .map(|step| 3.0 + f64::from(step) / 800.0 * (control.len() - 3) as f64)
        .map(|t| {
            let weigh = |(i, &p): (usize, &Point<f64>)| p * cox_de_boor(i, 4, t);
            let start = point(0.0, 0.0);
            control
                .iter()
                .enumerate()
                .map(weigh)
                .fold(start, |a, b| a + b)
        })
        .collect();
    let share = |row: usize, column: usize| {
        let covered = (0..256).filter(|s| {
            let x = column as f64 + (f64::from(s % 16) + 0.5) / 16.0;
            let y = row as f64 + (f64::from(s / 16) + 0.5) / 16.0;
            let at = point(x, f64::from(height) - y);
            on_curve.iter().any(|&p| p.distance(at) <= radius)
        });
        covered.count() as f64 / 256.0
    };
    let ink = coverage(
        &[curve(&control)],
        &view(width, height),
        &wide(2.0 * radius),
    );
    for row in 0..height as usize {
        for column in 0..width as usize {
            let (got, expected) = (ink[row * width as usize + column], share(row, column));
            assert!(
                (got - expected).abs() < 0.013,
                "({column}, {row}): {got} against {expected}"
            );
        }
    }
}

#[test]
fn density_is_the_mean_number_of_paths() {
    let half_a_row = line(point(-9.0, 5.0), point(19.0, 5.0));
    let row = line(point(-9.0, 5.5), point(19.0, 5.5));
    let style = Style {
        shading: Shading::Density(ToneMap::Linear),
        ..wide(1.0)
    };
    let mut expected = Frame::new(FrameSize::new(10, 8).unwrap());
    let mut counts = [0.0; 80];
    counts[20..30].fill(1.5);
    counts[30..40].fill(0.5);
    guideway_scene::density::shade(&counts, ToneMap::Linear, Rgba::WHITE, &mut expected);
    let (frame, _) = draw(
        layout(&[half_a_row, row]),
        Rgba::BLACK,
        &view(10, 8),
        &style,
    );
    assert_eq!(frame, expected);
}

#[test]
fn paths_that_go_on_as_others_count_once_in_density() {
    let style = Style {
        shading: Shading::Density(ToneMap::Linear),
        ..wide(4.0)
    };
    let drawn = |stops: &[f64]| {
        let paths = stops
            .windows(2)
            .map(|pair| line(point(pair[0], 5.0), point(pair[1], 5.0)));
        let paths: Vec<_> = paths.collect();
        draw(layout(&paths), Rgba::BLACK, &view(20, 10), &style).0
    };
    let whole = drawn(&[1.0, 17.0]);
    assert_eq!(drawn(&[1.0, 7.0, 17.0]), whole);
    // Pieces shorter than they are wide.
    let stops: Vec<f64> = (1..=17).map(f64::from).collect();
    assert_eq!(drawn(&stops), whole);
    assert_ne!(drawn(&[1.0, 7.0, 16.0]), whole);
}

#[test]
fn bands_change_no_bit_and_too_little_memory_is_rejected() {
    let paths = [
        curve(&[(0.0, 9.0), (40.0, -30.0), (-9.0, 70.0), (60.0, 30.0)].map(|(x, y)| point(x, y))),
        line(point(-5.0, -5.0), point(45.0, 60.0)),
        line(point(90.0, 0.0), point(99.0, 9.0)),
    ];
    let (view, style) = (view(40, 50), wide(2.0));
    let within = |bytes| draw_within(layout(&paths), Rgba::BLACK, &view, &style, bytes);
    let (whole, report) = within(1 << 30).unwrap();
    assert_eq!((report.bands, report.drawn, report.culled), (1, 2, 1));
    let (in_bands, report) = within(1 << 20).unwrap();
    assert_eq!(whole, in_bands);
    assert!(report.bands > 5, "{} bands", report.bands);
    assert!(matches!(within(1000), Err(RenderError::Budget { .. })));
}

#[test]
fn stops_when_cancelled() {
    let scene = Scene::new(
        Arc::new(layout(&[line(point(0.0, 0.0), point(9.0, 9.0))])),
        &SceneOptions::default(),
    );
    let mut prepared = Oracle
        .prepare(Arc::new(scene.unwrap()), &Budget::default())
        .unwrap();
    let cancel = Cancel::default();
    cancel.set();
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let outcome = prepared.render(&view(9, 9), &Style::default(), &cancel, &mut frame);
    assert_eq!(outcome, Err(RenderError::Cancelled));
}
