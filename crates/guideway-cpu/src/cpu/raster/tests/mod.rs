//! Whole pictures against the oracle.

mod full_pixels;
mod simd;

use guideway_layout::{Layout, NewPath};
use guideway_scene::density::ToneMap;
use guideway_scene::{Budget, Method, Rgba, Shading, Style};
use guideway_spline::{Point, Runs};

use crate::Oracle;
use crate::cpu::Cpu;
use crate::cpu::testing::*;

#[test]
fn opaque_paths_match_the_oracle() {
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
fn translucent_paths_match_the_oracle() {
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
fn densities_match_the_oracle() {
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
fn pictures_far_from_the_origin_and_zoomed_in_match_the_oracle() {
    let far = Point::new(1e7, -4e6);
    let scene = colored(wandering(300, 11, 3.0, far), |_| 255);
    check(&scene, &view(far, 1.0), &wide_px(1.5));
    // The middle of a line of 10^9 pixels, and a curve that crosses it.
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
fn a_path_without_length_is_a_dot() {
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
fn thin_strokes_that_share_pixels_have_the_right_lightness() {
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
