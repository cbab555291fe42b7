//! Every measurement of the thesis' chapter 5, on whatever device is there.
//!
//! [`reproduce`] follows a [`Plan`] and returns a [`Run`]: all that was measured, and under which
//! circumstances. Parts get time by their weight; what a part leaves is for those after it. [`resume`] measures
//! what a run lacks.

mod findings;
mod lab;
pub(crate) mod names;
mod parts;
mod plan;
mod resume;
mod run;
mod search;
pub(crate) mod thesis;

use std::time::{Instant, SystemTime};

use guideway_scene::{Cancel, RenderError};

use guideway_bench::{Machine, Start};
use lab::{Deadline, Lab};
use parts::{borders, growth, most_paths, pictures, views};

pub use findings::{Finding, Verdict, findings};
pub use plan::{METHODS, Plan};
pub use resume::{ResumeError, resume};
pub use run::{Border, MethodFacts, MostPaths, PartFacts, Picture, Reading, Results, Run, Sitting};
pub use search::{Limit, Search, Trial};

type Part = (
    &'static str,
    f64,
    fn(&Lab<'_>, Deadline, &mut Results) -> Result<(), RenderError>,
);

/// The parts of a run with their weights: shares of the time that the parts before left over.
const PARTS: [Part; 6] = [
    ("pictures", 2.0, pictures::pictures),
    ("coverage at the borders of cells", 1.0, borders::borders),
    (
        "frame time against pixels inside the grid",
        2.0,
        views::occupancy,
    ),
    ("frame time against magnification", 2.0, views::zoom),
    (
        "most paths at 60 frames a second",
        6.0,
        most_paths::most_paths,
    ),
    ("time against number of paths", 6.0, growth::growth),
];

/// Measures what the plan says. A method that does not run, or fails, is told of in its rows; when the
/// caller cancels, what was measured until then is returned, marked as partial.
///
/// # Errors
/// When the plan's pictures have no possible size.
pub fn reproduce(
    plan: &Plan,
    start: Start<'_>,
    cancel: &Cancel,
    progress: &dyn Fn(&str),
) -> Result<Run, RenderError> {
    let lab = Lab::new(plan, start, cancel, progress)?;
    let run = Run {
        sittings: Vec::new(),
        is_partial: false,
        plan: plan.clone(),
        methods: lab.facts().collect(),
        parts: Vec::new(),
        results: Results::default(),
    };
    Ok(measure(run, &lab))
}

/// The parts that a run lacks, or lacks something of.
fn pending(run: &Run) -> Vec<Part> {
    let is_pending = |(name, ..): &Part| !run.has(name);
    PARTS.into_iter().filter(is_pending).collect()
}

/// One sitting: measures what the run lacks, as far as the time does.
fn measure(mut run: Run, lab: &Lab<'_>) -> Run {
    let (began, started) = (SystemTime::now(), Instant::now());
    let parts = pending(&run);
    if parts.is_empty() {
        return run;
    }
    run.is_partial = false;
    let end_s = run.plan.minutes * 60.0;
    for (i, &(name, weight, part)) in parts.iter().enumerate() {
        let weights: f64 = parts[i..].iter().map(|(_, weight, _)| weight).sum();
        let part_started = Instant::now();
        let left_s = end_s - started.elapsed().as_secs_f64();
        let time = Deadline::after(left_s * weight / weights);
        let outcome = part(lab, time, &mut run.results);
        run.note(PartFacts {
            name: name.to_owned(),
            elapsed_s: part_started.elapsed().as_secs_f64(),
            is_cut: lab.take_is_cut(),
            failure: outcome.as_ref().err().map(RenderError::to_string),
        });
        if outcome == Err(RenderError::Cancelled) {
            run.is_partial = true;
            break;
        }
    }
    run.sittings.push(Sitting {
        machine: Machine::here(),
        started: humantime::format_rfc3339_seconds(began).to_string(),
        elapsed_s: started.elapsed().as_secs_f64(),
    });
    run
}
