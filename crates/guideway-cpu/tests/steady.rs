//! A frame like the one before allocates only its report, however large the scene.

use std::sync::Arc;

use guideway_cpu::Cpu;
use guideway_layout::{Layout, NewPath};
use guideway_scene::{Budget, Cancel, Frame, FrameSize, Method, Style, View};
use guideway_scene::{Scene, SceneOptions};
use guideway_spline::{Point, Runs};

/// Upper bound of the bytes of a report with its stages.
const REPORT_BYTES: u64 = 1024;

/// Waves that cross each other, in one or two colors.
fn scene(colors: usize) -> Arc<Scene> {
    let mut layout = Layout::default();
    for path in 0..3000 {
        let (row, column) = (path / 50, path % 50);
        let mut runs = Runs::default();
        let point = |i: u32| {
            let along = f64::from(column * 4 + i);
            Point::new(along, f64::from(row * 2) + along.sin())
        };
        runs.push(&(0..11).map(point).collect::<Vec<_>>());
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    let color = |path: usize| [0x0000_00ff, 0xff00_0080][path % colors];
    layout.paths.set_color_rgba((0..3000).map(color).collect());
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).expect("no options"))
}

/// Most bytes that a frame allocates after all views were drawn before.
fn most_bytes(scene: &Arc<Scene>, views: &[View]) -> u64 {
    let mut prepared = Cpu
        .prepare(Arc::clone(scene), &Budget::default())
        .expect("there is memory");
    let mut frame = Frame::new(views[0].size());
    let mut draw = |view: &View| {
        let (style, cancel) = (Style::default(), Cancel::default());
        let asked = allocation_counter::measure(|| {
            let report = prepared.render(view, &style, &cancel, &mut frame);
            assert!(report.expect("it can be drawn").drawn > 100);
        });
        asked.bytes_total
    };
    for _ in 0..2 {
        views.iter().for_each(|view| _ = draw(view));
    }
    views.iter().map(draw).max().expect("a view")
}

#[test]
fn a_steady_frame_allocates_nothing() {
    // One thread: only allocations of this thread are counted.
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread();
    let _pool = pool.build().unwrap();
    let view = |x_px: f64, px_per_m: f64| {
        let center = Point::new(100.0 + x_px / px_per_m, 60.0);
        View::new(FrameSize::new(400, 300).unwrap(), center, px_per_m).unwrap()
    };
    for colors in [1, 2] {
        let scene = scene(colors);
        for (motion, views) in [
            ("still", vec![view(0.0, 1.7)]),
            ("pan", vec![view(0.0, 1.7), view(5.0, 1.7), view(11.0, 1.7)]),
            ("zoom", vec![view(0.0, 1.6), view(0.0, 1.7), view(0.0, 1.8)]),
        ] {
            let bytes = most_bytes(&scene, &views);
            assert!(bytes <= REPORT_BYTES, "{motion}, {colors} colors: {bytes}");
        }
    }
    // The counter works: the first frame allocates all lines.
    let scene = scene(1);
    let asked = allocation_counter::measure(|| {
        let mut prepared = Cpu.prepare(Arc::clone(&scene), &Budget::default()).unwrap();
        let mut frame = Frame::new(FrameSize::new(400, 300).unwrap());
        let drawn = prepared.render(
            &view(0.0, 1.7),
            &Style::default(),
            &Cancel::default(),
            &mut frame,
        );
        assert!(drawn.is_ok());
    });
    assert!(asked.bytes_total > 100 * REPORT_BYTES);
}
