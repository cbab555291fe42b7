//! Compares method `gpu` with `cpu` in random views of large layouts, magnified up to 400 times.
//!
//! `GUIDEWAY_LARGE_VIEWS=1` selects layouts of up to a million paths at 1920 x 1080 pixels, for a
//! real graphics card. `--nocapture` prints the difference of each view.

use std::sync::Arc;

use guideway_cpu::Cpu;
use guideway_datasets::{GeneratedPath, RUN_POINTS, d1, d2};
use guideway_layout::{Geometry, Layout, NewPath, Paths};
use guideway_scene::{
    Budget, Frame, FrameSize, LineRule, Method, Prepared, RenderError, Scene, SceneOptions, Style,
    View,
};
use guideway_spline::{Point, Runs};
use guideway_tests::BoxError;
use guideway_tests::compare::{Tolerance, check};
use guideway_tests::devices::{available_or_skip, tiles};
use guideway_tests::evidence;
use guideway_tests::methods::render_view;
use guideway_tests::random::Lcg;

/// Number of views per layout.
const VIEWS: usize = 5;
/// Largest magnification, relative to the view of the whole layout.
const MOST_ZOOM: f64 = 400.0;

#[derive(Clone, Copy)]
enum Dataset {
    D1,
    D2,
    /// D1 with one path far away, so that a method may round the points of the others.
    D1WithFarPath,
}
use Dataset::{D1, D1WithFarPath, D2};

/// Layouts to draw, and the size of the pictures.
struct Plan {
    layouts: &'static [(Dataset, usize)],
    size: (u32, u32),
}

const SMALL: Plan = Plan {
    layouts: &[
        (D1, 2_000),
        (D2, 1_000),
        (D1, 10_000),
        (D2, 3_000),
        (D1WithFarPath, 10_000),
    ],
    size: (640, 360),
};
const LARGE: Plan = Plan {
    layouts: &[
        (D1, 10_000),
        (D2, 100_000),
        (D1, 1_000_000),
        (D2, 1_000_000),
    ],
    size: (1920, 1080),
};

#[test]
fn gpu_matches_cpu_in_random_views_of_large_layouts() {
    let Some(gpu) = available_or_skip(tiles()) else {
        return;
    };
    let is_large = std::env::var("GUIDEWAY_LARGE_VIEWS").is_ok_and(|v| v == "1");
    let plan = if is_large { LARGE } else { SMALL };
    println!("on {}", gpu.info().device);
    let mut wrong = Vec::new();
    for (seed, &(dataset, paths)) in (1..).zip(plan.layouts) {
        let name = match dataset {
            D1 => format!("d1 {paths}"),
            D2 => format!("d2 {paths}"),
            D1WithFarPath => format!("d1 {paths} and a far one"),
        };
        let scene = Arc::new(scene(dataset, paths));
        let styled_views = styled_views(&scene, plan.size, seed);
        wrong.extend(compare(&name, &gpu, &scene, &styled_views));
    }
    assert!(wrong.is_empty(), "wrong views:\n{}", wrong.join("\n"));
}

/// Errors of the views of one layout.
fn compare(
    name: &str,
    gpu: &dyn Method,
    scene: &Arc<Scene>,
    styled_views: &[StyledView],
) -> Vec<String> {
    let mut cpu = prepare(&Cpu, scene);
    let mut prepared = prepare(gpu, scene);
    let mut wrong = Vec::new();
    let mut pictures = Vec::new();
    for (number, styled) in styled_views.iter().enumerate() {
        let what = format!("{name} view {number}, {styled}");
        let expected = styled.draw(cpu.as_mut());
        let pair = expected.and_then(|expected| Ok((expected, styled.draw(prepared.as_mut())?)));
        let difference = pair.map_err(BoxError::from).and_then(|(expected, drawn)| {
            let difference = difference(&what, &expected, &drawn);
            pictures.push((styled, drawn));
            difference
        });
        match &difference {
            Ok(found) => println!("{what}: {found}"),
            Err(error) => println!("{what}: {error}"),
        }
        wrong.extend(difference.err().map(|error| format!("{what}: {error}")));
    }
    // In reverse, so that caches of the previous view hold another view.
    for (styled, first) in pictures.iter().rev() {
        if styled.draw(prepared.as_mut()).as_ref() != Ok(first) {
            wrong.push(format!("{name}, {styled}: the second picture differs"));
        }
    }
    wrong
}

/// Difference of a picture from the expected one, as a sentence; an error beyond the tolerance.
fn difference(what: &str, expected: &Frame, drawn: &Frame) -> Result<String, BoxError> {
    let background = Style::default().background;
    let background = [background.r, background.g, background.b, background.a];
    let covered = expected
        .pixels()
        .iter()
        .filter(|pixel| **pixel != background);
    let share = covered.count() as f64 / expected.pixels().len() as f64;
    match check(expected, drawn, &Tolerance::STANDARD) {
        Ok(found) => Ok(format!(
            "{:.1} % covered, mean {:.3}, {:.3} % within, {:.0} at most",
            share * 100.0,
            found.mean_abs,
            found.share_within * 100.0,
            found.max_abs
        )),
        Err(error) => {
            let written = evidence::write(what, expected, drawn);
            let shown = written.map_or_else(|e| e.to_string(), |file| file.display().to_string());
            Err(format!("{error}; see {shown}").into())
        }
    }
}

fn prepare(method: &dyn Method, scene: &Arc<Scene>) -> Box<dyn Prepared> {
    let budget = Budget {
        memory_bytes: 16_000_000_000,
        ..Budget::default()
    };
    let prepared = method.prepare(Arc::clone(scene), &budget);
    prepared.expect("there is memory enough")
}

fn scene(dataset: Dataset, paths: usize) -> Scene {
    let layout = match dataset {
        D1 => layout(d1(paths, 1)),
        D2 => layout(d2(paths, 1)),
        D1WithFarPath => {
            let mut layout = layout(d1(paths, 1));
            let mut runs = Runs::default();
            runs.push_line(Point::new(3000.0, 0.0), Point::new(3001.0, 1.0));
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
            layout
        }
    };
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default());
    scene.expect("options that fit any layout")
}

fn layout(paths: impl Iterator<Item = GeneratedPath>) -> Layout {
    let (ids, runs): (Vec<String>, Vec<_>) = paths.map(|path| (path.id, path.run)).unzip();
    let ends = (1..=runs.len()).map(|row| (row * RUN_POINTS) as u32);
    let geometry = Geometry::from_f32(runs.concat(), ends.collect());
    Layout {
        paths: Paths::from_columns(ids.iter().map(String::as_str).collect(), geometry),
        ..Layout::default()
    }
}

/// A view with its style.
struct StyledView {
    view: View,
    style: Style,
    zoom: f64,
}

impl StyledView {
    fn draw(&self, prepared: &mut dyn Prepared) -> Result<Frame, RenderError> {
        render_view(prepared, &self.view, &self.style).map(|(frame, _)| frame)
    }
}

impl std::fmt::Display for StyledView {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Point { x, y } = self.view.center_m();
        let rule = match self.style.line_rule {
            LineRule::Thesis => "thesis",
            LineRule::World { .. } => "world",
        };
        write!(
            f,
            "magnified {:.1} times, at ({x:.1}, {y:.1}), {rule}",
            self.zoom
        )
    }
}

/// The whole layout first, then magnified views near random paths, by both line rules alternately.
fn styled_views(scene: &Scene, (width, height): (u32, u32), seed: u64) -> Vec<StyledView> {
    let mut lcg = Lcg::new(seed);
    let size = FrameSize::new(width, height).expect("a picture has pixels");
    let all = View::fit(size, scene.bounds()).expect("the view is usable");
    let mut styled = |number: usize| {
        let (mut center, mut zoom) = (all.center_m(), 1.0);
        if number > 0 {
            zoom = lcg.between(0.0, MOST_ZOOM.ln()).exp();
            let path = scene.layout().paths.get(lcg.below(scene.row_count()));
            // A random offset that keeps the end of the path in view.
            let most_m = 0.4 * f64::from(height) / (all.px_per_m() * zoom);
            let mut aside = || lcg.between(-most_m, most_m);
            let aside = Point::new(aside(), aside());
            center = path.ends().expect("a path has a curve").0 + aside;
        }
        let line_rule = match (seed as usize + number) % 2 {
            0 => LineRule::default(),
            _ => LineRule::Thesis,
        };
        StyledView {
            view: View::new(size, center, all.px_per_m() * zoom).expect("the view is usable"),
            style: Style {
                line_rule,
                ..Style::default()
            },
            zoom,
        }
    };
    (0..VIEWS).map(&mut styled).collect()
}
