//! Measures the parts of a plan one after the other within its time limit, and returns the run.

use std::time::{Instant, SystemTime};

use guideway_scene::{Cancel, RenderError};

use super::deadline::Deadline;
use super::names::{BORDERS, CHANGES, GROWTH, MAGNIFICATION, MOST_PATHS, OCCUPANCY, PICTURES};
use super::parts::{borders, growth, most_paths, pictures, views};
use super::plan::Plan;
use super::run::{PartFacts, Results, Run, RunSession};
use super::session::Session;
use guideway_bench::{Machine, Start};

/// One part of a run.
struct Part {
    name: &'static str,
    /// Share of the remaining time, relative to the weights of the later parts.
    weight: f64,
    measure: fn(&Session<'_>, Deadline, &mut Results) -> Result<(), RenderError>,
}

impl Part {
    const fn new(
        name: &'static str,
        weight: f64,
        measure: fn(&Session<'_>, Deadline, &mut Results) -> Result<(), RenderError>,
    ) -> Self {
        Self {
            name,
            weight,
            measure,
        }
    }
}

/// The parts of a run in order.
const PARTS: [Part; 7] = [
    Part::new(PICTURES, 2.0, pictures::pictures),
    Part::new(BORDERS, 1.0, borders::borders),
    Part::new(OCCUPANCY, 2.0, views::occupancy),
    Part::new(MAGNIFICATION, 2.0, views::zoom),
    Part::new(CHANGES, 2.0, growth::changes),
    Part::new(MOST_PATHS, 6.0, most_paths::most_paths),
    Part::new(GROWTH, 6.0, growth::growth),
];

/// Measures everything that the plan lists. The rows of a method that fails hold the reason. When
/// the caller cancels, the run holds the measurements so far and is marked as partial.
///
/// # Errors
/// When the picture size of the plan is invalid.
pub fn reproduce(
    plan: &Plan,
    start: Start<'_>,
    cancel: &Cancel,
    progress: &dyn Fn(&str),
) -> Result<Run, RenderError> {
    let session = Session::new(plan, start, cancel, progress)?;
    let run = Run {
        sessions: Vec::new(),
        is_partial: false,
        plan: plan.clone(),
        methods: session.facts().collect(),
        parts: Vec::new(),
        results: Results::default(),
    };
    Ok(measure(run, &session))
}

/// Measures the parts that the run lacks, within the time limit of its plan, and records the
/// session.
pub(super) fn measure(mut run: Run, session: &Session<'_>) -> Run {
    let (began, started) = (SystemTime::now(), Instant::now());
    let parts: Vec<Part> = PARTS
        .into_iter()
        .filter(|part| !run.has(part.name))
        .collect();
    if parts.is_empty() {
        return run;
    }
    run.is_partial = false;
    let end_s = run.plan.minutes * 60.0;
    for (i, part) in parts.iter().enumerate() {
        let weights: f64 = parts[i..].iter().map(|part| part.weight).sum();
        let part_started = Instant::now();
        let left_s = end_s - started.elapsed().as_secs_f64();
        let time = Deadline::after(left_s * part.weight / weights);
        let outcome = (part.measure)(session, time, &mut run.results);
        run.record(PartFacts {
            name: part.name.to_owned(),
            elapsed_s: part_started.elapsed().as_secs_f64(),
            is_cut: session.take_is_cut(),
            failure: outcome.as_ref().err().map(RenderError::to_string),
        });
        if outcome == Err(RenderError::Cancelled) {
            run.is_partial = true;
            break;
        }
    }
    run.sessions.push(RunSession {
        machine: Machine::here(),
        started: humantime::format_rfc3339_seconds(began).to_string(),
        elapsed_s: started.elapsed().as_secs_f64(),
    });
    run
}

#[cfg(test)]
mod tests {
    use super::super::names;
    use super::*;

    #[test]
    fn parts_match_the_names_that_a_whole_run_needs() {
        assert_eq!(PARTS.map(|part| part.name), names::PARTS);
    }
}
