//! Compares every method on the processor with the oracle in every scene, for any threads and
//! memory.

use std::collections::HashSet;

use guideway_scene::{Budget, Frame, Method, RenderError};
use guideway_tests::BoxError;
use guideway_tests::compare::{Difference, check};
use guideway_tests::evidence;
use guideway_tests::methods::{Candidate, check_counts, draw, draw_reference, methods};
use guideway_tests::parallel::in_parallel;
use guideway_tests::scenes::{self, SceneCase};
use guideway_tests::sketch::Drawing;

/// Budgets small enough that small pictures need several bands.
const TIGHT_BUDGETS_BYTES: [u64; 5] = [16 << 20, 4 << 20, 1 << 20, 256 << 10, 64 << 10];
/// Number of threads with these budgets.
const TIGHT_THREADS: usize = 2;

struct Outcome {
    scene: String,
    method: &'static str,
    difference: Result<Difference, BoxError>,
    /// Largest number of bands of the picture.
    bands: u32,
}

#[test]
fn methods_match_the_oracle_in_every_scene() {
    let cases = scenes::all();
    let methods = methods();
    let outcomes: Vec<Outcome> = in_parallel(&cases, |case| {
        let drawing = case.build();
        let (expected, report) = draw_reference(&drawing);
        let counted = check_counts(&report, &drawing).map(|()| Difference::default());
        let own = Outcome {
            scene: case.name.clone(),
            method: "oracle",
            difference: counted,
            bands: report.bands,
        };
        let judged = methods
            .iter()
            .map(|m| outcome(case, &drawing, &expected, m));
        std::iter::once(own).chain(judged).collect::<Vec<_>>()
    })
    .into_iter()
    .flatten()
    .collect();

    print_worst(&outcomes);
    let failures: Vec<String> = outcomes
        .iter()
        .filter_map(|o| Some((o, o.difference.as_ref().err()?)))
        .map(|(o, message)| format!("{} by {}: {message}", o.scene, o.method))
        .collect();
    assert!(
        failures.is_empty(),
        "{} of {} pictures are wrong:\n{}",
        failures.len(),
        outcomes.len(),
        failures.join("\n")
    );
    for candidate in &methods {
        let name = candidate.method.info().name;
        let in_bands = outcomes.iter().any(|o| o.method == name && o.bands > 1);
        assert!(in_bands, "{name} never used several bands");
    }
}

#[test]
fn scene_names_are_unique_and_cover_the_suite() {
    let cases = scenes::all();
    assert!(cases.len() >= 120, "{} scenes", cases.len());
    let names: HashSet<_> = cases.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(names.len(), cases.len());
    assert!(names.iter().all(|name| name.split('/').count() == 2));
}

fn outcome(
    case: &SceneCase,
    drawing: &Drawing,
    expected: &Frame,
    candidate: &Candidate,
) -> Outcome {
    let method = candidate.method.as_ref();
    let mut bands = 0;
    let difference = draw_repeatedly(method, drawing, &mut bands).and_then(|actual| {
        check(expected, &actual, &candidate.tolerance).map_err(|message| {
            let name = format!("{}-{}", method.info().name, case.name);
            let written = evidence::write(&name, expected, &actual);
            let shown = written.map_or_else(|e| e.to_string(), |file| file.display().to_string());
            format!("{message}; see {shown}").into()
        })
    });
    Outcome {
        scene: case.name.clone(),
        method: method.info().name,
        difference,
        bands,
    }
}

/// Draws with several numbers of threads and with decreasing memory; all pictures must be equal.
fn draw_repeatedly(
    method: &dyn Method,
    drawing: &Drawing,
    bands: &mut u32,
) -> Result<Frame, BoxError> {
    let within = |memory_bytes, threads| Budget {
        memory_bytes,
        threads,
    };
    let plenty = Budget::default().memory_bytes;
    let (first, report) = draw(method, drawing, &within(plenty, 1))?;
    check_counts(&report, drawing)?;
    let mut needed_bytes = 0;
    for threads in [1, TIGHT_THREADS, 3, 8] {
        let (again, report) = draw(method, drawing, &within(plenty, threads))?;
        check_counts(&report, drawing)?;
        if again != first {
            return Err(format!("the picture by {threads} threads differs from one thread").into());
        }
        if threads == TIGHT_THREADS {
            needed_bytes = report.peak_bytes + size_of_val(again.pixels()) as u64;
        }
    }
    // With slightly less memory, the method may need bands.
    let short = [15, 12].map(|sixteenths| needed_bytes * sixteenths / 16);
    for memory_bytes in TIGHT_BUDGETS_BYTES.into_iter().chain(short) {
        match draw(method, drawing, &within(memory_bytes, TIGHT_THREADS)) {
            Ok((again, report)) if again == first => *bands = report.bands.max(*bands),
            Ok(_) => return Err(format!("the picture within {memory_bytes} bytes differs").into()),
            Err(RenderError::Budget { .. }) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(first)
}

fn print_worst(outcomes: &[Outcome]) {
    let mut measured: Vec<_> = outcomes
        .iter()
        .filter(|o| o.method != "oracle")
        .filter_map(|o| Some((o, o.difference.as_ref().ok()?)))
        .collect();
    measured.sort_by(|a, b| b.1.mean_abs.total_cmp(&a.1.mean_abs));
    println!("worst scenes within the tolerance, in levels of 255:");
    println!(
        "{:<44} {:<8} {:>7} {:>10} {:>5}",
        "scene", "method", "mean", "within", "max"
    );
    for (outcome, difference) in measured.iter().take(15) {
        println!(
            "{:<44} {:<8} {:>7.3} {:>8.3} % {:>5.0}",
            outcome.scene,
            outcome.method,
            difference.mean_abs,
            difference.share_within * 100.0,
            difference.max_abs
        );
    }
}
