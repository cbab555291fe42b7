//! What lies where, against the distance of every curve from every pixel.

use std::sync::Arc;

use guideway_cpu::Cpu;
use guideway_layout::{Layout, NewPath, OwnStyle};
use guideway_scene::{Budget, Cancel, FrameSize, Method, NO_PATH, Prepared, Style, View};
use guideway_scene::{Edit, LineRule, PathState, Scene, SceneOptions};
use guideway_spline::{Point, Runs, uniform};

const PATHS: u32 = 300;
const SIDES: [u32; 2] = [24, 18];
const STYLE: Style = Style {
    line_rule: LineRule::World {
        width_m: 0.5,
        min_px: 1.0,
        max_px: 40.0,
    },
    shading: guideway_scene::Shading::Color,
    background: guideway_scene::Rgba::WHITE,
};

/// Paths that cross each other around the origin; the ranks of some are turned around, and some are wide.
fn scene(is_ranked: bool) -> Scene {
    let mut layout = Layout::default();
    for path in 0..PATHS {
        let turn = f64::from(path) * 2.4;
        let from = Point::new(turn.cos(), turn.sin()) * (f64::from(path) * 0.1);
        let point = |i: u32| {
            let along = f64::from(i);
            from + Point::new(along * 1.3, (along + turn).sin() * 2.0)
        };
        let mut runs = Runs::default();
        runs.push(&(0..7).map(point).collect::<Vec<_>>());
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    if is_ranked {
        layout
            .paths
            .set_rank((0..PATHS as i32).map(|path| path * 7 % 50).collect());
    }
    let mut scene = Scene::new(Arc::new(layout), &SceneOptions::default()).expect("no options");
    let wide = OwnStyle {
        width_m: Some(2.0),
        color_rgba: None,
    };
    let hidden = (0..PATHS).step_by(9).map(|path| (path, PathState::Hidden));
    scene
        .edit(&Edit::Restyle(Arc::new([(40, wide), (41, wide)])))
        .expect("it can be done");
    scene
        .edit(&Edit::SetStates(hidden.collect()))
        .expect("it can be done");
    scene
}

/// Distance of a path's curve from a pixel, near enough.
fn distance_px(scene: &Scene, path: u32, view: &View, pixel: [u32; 2]) -> f64 {
    let low = pixel.map(f64::from);
    let segments = scene.layout().paths.get(path as usize).runs();
    let points = segments
        .flat_map(|run| run.segments())
        .flat_map(|segment| (0..=128).map(move |i| uniform::point(&segment, f64::from(i) / 128.0)));
    let distances = points.map(|p| {
        let p = view.pixel_from_world(p);
        let nearest = Point::new(
            p.x.clamp(low[0], low[0] + 1.0),
            p.y.clamp(low[1], low[1] + 1.0),
        );
        p.distance(nearest)
    });
    distances.fold(f64::INFINITY, f64::min)
}

fn check(scene: &Scene, view: &View) {
    let budget = Budget::default();
    let mut prepared = Cpu
        .prepare(Arc::new(scene.clone()), &budget)
        .expect("it can be done");
    let ask: &mut dyn Prepared = prepared.as_mut();
    let cancel = Cancel::default();
    let tops = ask
        .top_paths(view, &STYLE, &cancel)
        .expect("there is memory")
        .expect("it knows");
    let here = ask
        .paths_in(view, &STYLE, &cancel)
        .expect("there is memory")
        .expect("it knows");
    assert!(here.is_sorted() && here.len() > 3, "{here:?}");
    let order = scene.draw_order();
    let rank = |path: u32| order.iter().position(|&other| other == path);
    let radius_px = |path| {
        STYLE
            .line_rule
            .radius_px(scene.width_m(path), view.px_per_m())
    };
    let mut nearest = vec![f64::INFINITY; PATHS as usize];
    for (index, &top) in (0..).zip(&tops) {
        let pixel = [index % SIDES[0], index / SIDES[0]];
        let is_shown = top == NO_PATH || scene.state(top) == PathState::Shown;
        assert!(is_shown, "{top} at {pixel:?}");
        for path in order.iter().copied() {
            let beyond_px = distance_px(scene, path, view, pixel) - radius_px(path);
            nearest[path as usize] = nearest[path as usize].min(beyond_px);
            // Lines may be a 32nd of a pixel off the curve.
            if beyond_px < -0.05 {
                let is_above = top != NO_PATH && rank(top) >= rank(path);
                assert!(is_above, "{path} covers {pixel:?}, on top is {top}");
            }
            let is_there = top != path || beyond_px < 0.05;
            assert!(is_there, "{path} at {pixel:?}: {beyond_px}");
        }
    }
    for (path, beyond_px) in (0..).zip(nearest) {
        let is_found = here.contains(&path);
        assert!(is_found || beyond_px > -0.05, "{path}: {beyond_px}");
        assert!(!is_found || beyond_px < 0.05, "{path}: {beyond_px}");
    }
}

#[test]
fn questions_find_what_lies_there() {
    let size = FrameSize::new(SIDES[0], SIDES[1]).unwrap();
    for is_ranked in [false, true] {
        let scene = scene(is_ranked);
        for px_per_m in [0.4, 3.0, 40.0] {
            check(
                &scene,
                &View::new(size, Point::new(1.0, 2.0), px_per_m).unwrap(),
            );
        }
    }
}

#[test]
fn where_nothing_is_nothing_is_found() {
    let size = FrameSize::new(SIDES[0], SIDES[1]).unwrap();
    let nowhere = View::new(size, Point::new(1e4, 1e4), 4.0).unwrap();
    let mut prepared = Cpu
        .prepare(Arc::new(scene(false)), &Budget::default())
        .unwrap();
    let cancel = Cancel::default();
    let tops = prepared
        .top_paths(&nowhere, &STYLE, &cancel)
        .unwrap()
        .unwrap();
    assert!(tops.iter().all(|&path| path == NO_PATH));
    let here = prepared.paths_in(&nowhere, &STYLE, &cancel).unwrap();
    assert_eq!(here, Some(vec![]));
    cancel.set();
    assert!(prepared.paths_in(&nowhere, &STYLE, &cancel).is_ok());
    let all = View::new(size, Point::new(0.0, 0.0), 0.4).unwrap();
    assert!(prepared.paths_in(&all, &STYLE, &cancel).is_err());
}
