//! Compares every scene that a method on a graphics device supports with the oracle.

use guideway_scene::{Budget, Frame, RenderError};
use guideway_tests::BoxError;
use guideway_tests::compare::{Difference, Tolerance, check};
use guideway_tests::devices::{DeviceCandidate, candidates};
use guideway_tests::evidence;
use guideway_tests::methods::{check_counts, draw, draw_reference};
use guideway_tests::scenes::{self, SceneCase};

struct Outcome {
    scene: String,
    candidate: usize,
    difference: Result<Difference, BoxError>,
}

#[test]
fn device_methods_match_the_oracle_in_supported_scenes() {
    let candidates = candidates();
    if candidates.is_empty() {
        return;
    }
    let outcomes: Vec<_> = scenes::all()
        .iter()
        .enumerate()
        .flat_map(|(scene, case)| outcomes(scene, case, &candidates))
        .collect();

    let failures: Vec<_> = outcomes
        .iter()
        .filter_map(|o| Some((o, o.difference.as_ref().err()?)))
        .map(|(o, message)| format!("{} by {}: {message}", o.scene, candidates[o.candidate].name))
        .collect();
    for (number, candidate) in candidates.iter().enumerate() {
        let drawn: Vec<_> = outcomes.iter().filter(|o| o.candidate == number).collect();
        print_worst(&candidate.name, &drawn);
        assert!(
            drawn.len() >= candidate.least_scenes,
            "{} draws {} scenes, fewer than the required {}",
            candidate.name,
            drawn.len(),
            candidate.least_scenes
        );
    }
    assert!(
        failures.is_empty(),
        "{} of {} pictures are wrong:\n{}",
        failures.len(),
        outcomes.len(),
        failures.join("\n")
    );
}

/// The outcomes of the candidates that support a scene.
fn outcomes(scene: usize, case: &SceneCase, candidates: &[DeviceCandidate]) -> Vec<Outcome> {
    let drawing = case.build();
    let has_one_color = drawing.scene().common_color().is_some();
    let mut expected = None;
    let mut outcomes = Vec::new();
    let candidates = candidates.iter().enumerate();
    for (number, candidate) in candidates.filter(|(_, candidate)| candidate.draws(scene)) {
        let drawn = draw(candidate.method.as_ref(), &drawing, &Budget::default());
        let difference = match drawn {
            Err(RenderError::Unsupported { what, remedy, .. }) => {
                assert!(
                    !what.is_empty() && remedy.ends_with('.'),
                    "{what}: {remedy}"
                );
                continue;
            }
            Err(error) => Err(error.into()),
            Ok((actual, report)) => {
                let expected = expected.get_or_insert_with(|| draw_reference(&drawing).0);
                let tolerance = match has_one_color {
                    true => &candidate.tolerance,
                    false => &candidate.color_tolerance,
                };
                let name = format!("{} {}", candidate.name, case.name);
                check_counts(&report, &drawing)
                    .and_then(|()| compare(&name, tolerance, expected, &actual))
            }
        };
        outcomes.push(Outcome {
            scene: case.name.clone(),
            candidate: number,
            difference,
        });
    }
    outcomes
}

fn compare(
    name: &str,
    tolerance: &Tolerance,
    expected: &Frame,
    actual: &Frame,
) -> Result<Difference, BoxError> {
    check(expected, actual, tolerance).map_err(|message| {
        let written = evidence::write(name, expected, actual);
        let shown = written.map_or_else(|e| e.to_string(), |file| file.display().to_string());
        format!("{message}; see {shown}").into()
    })
}

fn print_worst(name: &str, drawn: &[&Outcome]) {
    println!("{name}: {} scenes, the worst of them", drawn.len());
    let mut measured: Vec<_> = drawn
        .iter()
        .filter_map(|o| Some((o, o.difference.as_ref().ok()?)))
        .collect();
    measured.sort_by(|a, b| b.1.mean_abs.total_cmp(&a.1.mean_abs));
    for (outcome, difference) in measured.iter().take(5) {
        println!(
            "  {:<44} mean {:>6.3} {:>8.3} % within, {:>3.0} at most",
            outcome.scene,
            difference.mean_abs,
            difference.share_within * 100.0,
            difference.max_abs
        );
    }
}
