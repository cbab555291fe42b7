//! Compares the line positions of method `tessellation` with the oracle, over the scene suite.

use std::sync::Arc;

use guideway_scene::{Budget, Frame, Method, RenderError, Report};
use guideway_tessellation::{Antialias, Commands, GlDevice, Tessellation, TessellationOptions};
use guideway_tests::BoxError;
use guideway_tests::devices::{available_or_skip, gl};
use guideway_tests::evidence;
use guideway_tests::hairline::{Difference, Tolerance, check, drawing};
use guideway_tests::methods::{draw_reference, render_view};
use guideway_tests::parallel::in_parallel;
use guideway_tests::scenes::{self, SceneCase};
use guideway_tests::sketch::{Drawing, Sketch};

/// Fewest scenes that the method must draw. It rejects density, translucency and extreme zoom.
const LEAST_SCENES: usize = 200;

const VARIANTS: [(Antialias, Tolerance); 2] = [
    (Antialias::None, Tolerance::ALIASED),
    (Antialias::Multisample, Tolerance::MULTISAMPLED),
];

/// Scenes of paths shorter than a pixel: a line inside the diamond of its pixel is not drawn.
const LOST_BELOW_A_PIXEL: [&str; 5] = [
    "crowds/short-paths-below-a-pixel",
    "dots/row",
    "tiles/dots-on-corners-of-16",
    "tiles/dots-on-corners-of-32",
    "tiles/dots-on-corners-of-64",
];
/// Scenes of thin pictures and of lines along a border, most of which llvmpipe omits with several
/// samples.
const LOST_AT_BORDERS: [&str; 5] = [
    "sizes/1x96",
    "sizes/96x1",
    "sizes/3x257",
    "sizes/257x3",
    "edges/along-all-four",
];

#[test]
fn line_positions_match_the_oracle() {
    let Some(device) = available_or_skip(gl()) else {
        return;
    };
    let cases = scenes::all();
    let outcomes = in_parallel(&cases, |case| outcome(case, &device));
    let drawn: Vec<_> = outcomes.iter().flatten().collect();
    let wrong: Vec<_> = drawn.iter().filter_map(|o| o.as_ref().err()).collect();
    println!("{} scenes on {}", drawn.len(), device.description());
    assert!(drawn.len() >= LEAST_SCENES, "{} scenes", drawn.len());
    assert!(
        wrong.is_empty(),
        "{} scenes are wrong:\n{}",
        wrong.len(),
        wrong
            .iter()
            .map(|error| error.to_string())
            .collect::<Vec<_>>()
            .join("\n")
    );
}

/// The outcome of a scene; `None` if the method rejects it.
fn outcome(case: &SceneCase, device: &Arc<GlDevice>) -> Option<Result<(), BoxError>> {
    let drawing = drawing(case.sketch());
    let mut expected = None;
    for (antialias, tolerance) in VARIANTS {
        let (frame, report) = match draw_repeatedly(device, antialias, &drawing) {
            Ok(drawn) => drawn,
            Err(RenderError::Unsupported { what, remedy, .. }) => {
                let rejected = ["density", "translucent", "single precision"];
                assert!(rejected.iter().any(|s| what.contains(s)) && remedy.ends_with('.'));
                return None;
            }
            Err(error) => return Some(Err(format!("{}: {error}", case.name).into())),
        };
        let expected = expected.get_or_insert_with(|| draw_reference(&drawing).0);
        let tolerance = allowed(&case.name, antialias, tolerance, &report);
        if let Err(wrong) = compare(expected, &frame, &drawing, &tolerance) {
            let name = format!("tessellation-{antialias:?}-{}", case.name);
            let shown = evidence::write(&name, expected, &frame);
            let shown = shown.map_or_else(|e| e.to_string(), |file| file.display().to_string());
            return Some(Err(format!(
                "{} {antialias:?}: {wrong}; see {shown}",
                case.name
            )
            .into()));
        }
    }
    Some(Ok(()))
}

/// The tolerance of a scene; lost paths are allowed if the report of the method notes them.
fn allowed(scene: &str, antialias: Antialias, tolerance: Tolerance, report: &Report) -> Tolerance {
    let is_noted = |about: &str| report.notes.iter().any(|note| note.contains(about));
    let is_lossy = match antialias {
        Antialias::None => LOST_BELOW_A_PIXEL.contains(&scene) && is_noted("shorter than a pixel"),
        Antialias::Multisample => LOST_BELOW_A_PIXEL
            .iter()
            .chain(&LOST_AT_BORDERS)
            .any(|lossy| *lossy == scene && (is_noted("shorter than a pixel") || is_noted("gaps"))),
    };
    Tolerance {
        lost: if is_lossy { 1.0 } else { tolerance.lost },
        ..tolerance
    }
}

fn compare(
    expected: &Frame,
    actual: &Frame,
    drawing: &Drawing,
    tolerance: &Tolerance,
) -> Result<Difference, BoxError> {
    let background = drawing.style.background;
    let background = [background.r, background.g, background.b, background.a];
    check(expected, actual, background, tolerance)
}

/// Draws with each kind of draw commands, twice; all pictures must be equal.
fn draw_repeatedly(
    device: &Arc<GlDevice>,
    antialias: Antialias,
    drawing: &Drawing,
) -> Result<(Frame, Report), RenderError> {
    let mut first: Option<(Frame, Report)> = None;
    for commands in [Commands::PerPath, Commands::Compact] {
        let options = TessellationOptions {
            commands,
            antialias,
        };
        let method = Tessellation::new(Arc::clone(device), options);
        let mut prepared = method.prepare(Arc::new(drawing.scene()), &Budget::default())?;
        for _ in 0..2 {
            let (again, report_again) =
                render_view(prepared.as_mut(), &drawing.view, &drawing.style)?;
            let (frame, report) =
                first.get_or_insert_with(|| (again.clone(), report_again.clone()));
            assert!(again == *frame, "{commands:?}");
            assert_eq!(
                (report_again.drawn, report_again.lines),
                (report.drawn, report.lines)
            );
        }
    }
    let (frame, report) = first.expect("each kind draws");
    assert!(report.accounts_for_all(), "{report:?}");
    assert_eq!(report.total, drawing.layout.path_count() as u64);
    Ok((frame, report))
}

/// Five paths without symmetry.
fn sketch(moved: (f64, f64)) -> Sketch {
    let at = |x: f64, y: f64| (x + moved.0, y + moved.1);
    Sketch::new(96, 64)
        .line(at(8.0, 52.0), at(88.0, 20.0))
        .curve(&[
            at(-30.0, -20.0),
            at(20.0, 50.0),
            at(70.0, 44.0),
            at(120.0, -30.0),
        ])
        .line(at(70.0, 6.0), at(40.0, 60.0))
        .line(at(6.3, 8.0), at(6.3, 30.0))
        .line(at(60.0, 58.3), at(92.0, 58.3))
}

/// Returns `true` if the device's picture of `actual` matches `expected`, per variant.
fn passes(device: &Arc<GlDevice>, expected: &Sketch, actual: &Sketch) -> [bool; 2] {
    let (expected, _) = draw_reference(&drawing(expected.clone()));
    let actual = drawing(actual.clone());
    VARIANTS.map(|(antialias, tolerance)| {
        let (frame, _) = draw_repeatedly(device, antialias, &actual).expect("it can be drawn");
        compare(&expected, &frame, &actual, &tolerance).is_ok()
    })
}

#[test]
fn rejects_moved_and_missing_paths() {
    let Some(device) = available_or_skip(gl()) else {
        return;
    };
    let right = sketch((0.0, 0.0));
    assert_eq!(passes(&device, &right, &right), [true; 2]);
    for moved in [(2.0, 0.0), (0.0, 2.0), (-2.0, 0.0), (0.0, -2.0)] {
        assert_eq!(
            passes(&device, &right, &sketch(moved)),
            [false; 2],
            "{moved:?}"
        );
    }
    for missing in 0..right.len() {
        let rest: Vec<_> = (0..right.len()).filter(|&i| i != missing).collect();
        let rest = right.clone().reordered(&rest);
        assert_eq!(passes(&device, &right, &rest), [false; 2], "{missing}");
        assert_eq!(
            passes(&device, &rest, &right),
            [false; 2],
            "{missing} too many"
        );
    }
    assert_eq!(passes(&device, &right, &Sketch::new(96, 64)), [false; 2]);
    assert_eq!(passes(&device, &Sketch::new(96, 64), &right), [false; 2]);
}

#[test]
fn rejects_rotated_and_mirrored_pictures() {
    let right = drawing(sketch((0.0, 0.0)));
    let (expected, _) = draw_reference(&right);
    let (width, height) = (96, 64);
    for from in [
        |x: usize, y: usize| (x, 63 - y),
        |x, y| (95 - x, y),
        |x, y| (95 - x, 63 - y),
    ] {
        let mut turned = expected.clone();
        for y in 0..height {
            for x in 0..width {
                let (from_x, from_y) = from(x, y);
                turned.pixels_mut()[y * width + x] = expected.pixels()[from_y * width + from_x];
            }
        }
        for (_, tolerance) in VARIANTS {
            assert!(compare(&expected, &expected, &right, &tolerance).is_ok());
            assert!(compare(&expected, &turned, &right, &tolerance).is_err());
        }
    }
}

#[test]
fn rejects_faded_pictures() {
    let right = drawing(sketch((0.0, 0.0)));
    let (expected, _) = draw_reference(&right);
    let mut faded = expected.clone();
    for [r, g, b, _] in faded.pixels_mut() {
        for channel in [r, g, b] {
            *channel = 255 - (255 - *channel) / 8;
        }
    }
    for (_, tolerance) in VARIANTS {
        assert!(compare(&expected, &faded, &right, &tolerance).is_err());
    }
}
