//! Tests properties of all pictures, for the oracle and every other method on the processor.

use std::f64::consts::TAU;

use guideway_scene::{Budget, Frame, Method};
use guideway_tests::compare::{Tolerance, check};
use guideway_tests::methods::{draw, draw_reference, methods};
use guideway_tests::random::Lcg;
use guideway_tests::scenes::{long_curves, short_paths, site};
use guideway_tests::sketch::Sketch;
use proptest::prelude::*;

fn all_methods() -> Vec<Box<dyn Method>> {
    let oracle: Box<dyn Method> = Box::new(guideway_cpu::Oracle);
    std::iter::once(oracle)
        .chain(methods().into_iter().map(|candidate| candidate.method))
        .collect()
}

fn picture(method: &dyn Method, sketch: &Sketch) -> Frame {
    let drawn = draw(method, &sketch.build(), &Budget::default());
    drawn.expect("there is memory enough").0
}

/// For pictures with other clusters or another origin: `cpu` rounds lines to the grid of their
/// cluster, which moves an edge by up to an eighth of a pixel. Measured: up to 20 levels, and a
/// mean of 0.24.
const OTHER_CLUSTERS: Tolerance = Tolerance {
    mean: 1.0,
    within: (24.0, 0.99),
    max: 64.0,
};

/// Limit of the change that an added path may cause in others.
fn added_path_tolerance(method: &dyn Method) -> Tolerance {
    match method.info().name {
        "oracle" => Tolerance::NONE,
        _ => OTHER_CLUSTERS,
    }
}

/// A sketch of a few paths of any generator.
fn any_sketch() -> impl Strategy<Value = Sketch> {
    (0..3, 0..1000_u64, 0.1..6.0).prop_map(|(kind, seed, width)| {
        let empty = Sketch::new(48, 40).width(width);
        match kind {
            0 => site(empty, 12, seed),
            1 => long_curves(empty, 5, seed),
            _ => short_paths(empty, 20, seed),
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(24)
    })]

    #[test]
    fn pictures_do_not_depend_on_the_origin(
        sketch in any_sketch(),
        x_m in -1e7..1e7,
        y_m in -1e7..1e7,
    ) {
        let sketch = sketch.px_per_m(50.0);
        for method in all_methods() {
            let here = picture(method.as_ref(), &sketch);
            let there = picture(method.as_ref(), &sketch.clone().at(x_m, y_m));
            let tolerance = match method.info().name {
                "cpu" => OTHER_CLUSTERS,
                _ => Tolerance::ROUNDING,
            };
            let outcome = check(&here, &there, &tolerance);
            prop_assert!(outcome.is_ok(), "{}: {outcome:?}", method.info().name);
        }
    }

    #[test]
    fn pictures_in_one_color_do_not_depend_on_the_order(
        sketch in any_sketch(),
        seed in 0..1000_u64,
    ) {
        let sketch = sketch.in_one_color();
        let mut order: Vec<usize> = (0..sketch.len()).collect();
        let mut lcg = Lcg::new(seed);
        for last in (1..order.len()).rev() {
            order.swap(last, lcg.below(last + 1));
        }
        let shuffled = sketch.clone().reordered(&order);
        for method in all_methods() {
            let right = picture(method.as_ref(), &sketch);
            let other = picture(method.as_ref(), &shuffled);
            prop_assert!(right == other, "{}", method.info().name);
        }
    }

    #[test]
    fn an_added_path_lightens_no_pixel(sketch in any_sketch()) {
        let sketch = sketch.in_one_color();
        let fewer = sketch.clone().first(sketch.len() - 1);
        for method in all_methods() {
            let with = picture(method.as_ref(), &sketch);
            let without = picture(method.as_ref(), &fewer);
            let mut lighter = without.clone();
            for (pixel, with) in lighter.pixels_mut().iter_mut().zip(with.pixels()) {
                pixel[0] = pixel[0].max(with[0]);
            }
            let outcome = check(&without, &lighter, &added_path_tolerance(method.as_ref()));
            prop_assert!(outcome.is_ok(), "{}: {outcome:?}", method.info().name);
        }
    }

    #[test]
    fn paths_outside_the_view_change_no_pixel(
        sketch in any_sketch(),
        turn in 0.0..1.0,
        width in 0.1..30.0,
    ) {
        let (sin, cos) = f64::sin_cos(turn * TAU);
        let far = |r: f64| (24.0 + r * cos - 400.0 * sin, 20.0 + r * sin + 400.0 * cos);
        let more = sketch.clone().line(far(-300.0), far(300.0)).own_width(width);
        let drawing = more.build();
        for method in all_methods() {
            let (with, report) = draw(method.as_ref(), &drawing, &Budget::default()).unwrap();
            let without = picture(method.as_ref(), &sketch);
            let outcome = check(&without, &with, &added_path_tolerance(method.as_ref()));
            prop_assert!(outcome.is_ok(), "{}: {outcome:?}", method.info().name);
            prop_assert!(report.accounts_for_all());
        }
    }
}

#[test]
fn distant_scenes_match_those_at_the_origin() {
    let sketch = site(Sketch::new(160, 120).px_per_m(100.0), 200, 77);
    for method in all_methods() {
        let here = picture(method.as_ref(), &sketch);
        for (x_m, y_m) in [
            (1e7, 1e7),
            (-1e7, 1e7),
            (-1e7, -1e7),
            (1e7, -1e7),
            (0.0, 1e7),
        ] {
            let there = picture(method.as_ref(), &sketch.clone().at(x_m, y_m));
            if let Err(message) = check(&here, &there, &Tolerance::ROUNDING) {
                panic!("{} at ({x_m}, {y_m}): {message}", method.info().name);
            }
        }
    }
}

#[test]
fn the_oracle_culls_all_paths_outside_the_view() {
    let sketch = Sketch::new(64, 48)
        .line((-40.0, -40.0), (-24.0, -24.0))
        .line((80.0, 10.0), (90.0, 40.0));
    let (frame, report) = draw_reference(&sketch.build());
    assert_eq!((report.drawn, report.culled), (0, 2));
    assert!(frame.pixels().iter().all(|&pixel| pixel == [255; 4]));
}
