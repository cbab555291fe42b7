//! Figures 5.4 and 5.5: measures the times of preparation and frames against the number of paths,
//! all in view; then frames of one number of paths that all move.

use std::sync::Arc;

use guideway_scene::{RenderError, Scene, View};

use crate::reproduce::deadline::Deadline;
use crate::reproduce::names::SAMPLE;
use crate::reproduce::run::{Reading, Results};
use crate::reproduce::session::Session;
use guideway_bench::{Edits, Moves, Outcome, Prepare, Way};

/// Measures preparation and frame times for each number of paths.
pub(crate) fn growth(
    session: &Session<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let of_size = |&paths: &usize| {
        session
            .cases()
            .map(move |(dataset, spec)| (paths, dataset, spec))
    };
    // From few paths to many: the time limit then leaves out the slowest measurements.
    let mut open: Vec<_> = session.plan.sizes.iter().flat_map(of_size).collect();
    open.retain(|&(paths, dataset, spec)| Reading::settled(&out.growth, dataset, paths, spec) == 0);
    for (i, &(paths, dataset, spec)) in open.iter().enumerate() {
        session.show_progress(&format!(
            "growth: {spec} on {} with {paths} paths",
            dataset.name()
        ));
        let scene = session.scene(dataset, paths);
        let outcome = measure(session, spec, &scene, time.share(open.len() - i))?;
        Reading::new(dataset, paths, paths as f64, spec, outcome).put(&mut out.growth);
    }
    Ok(())
}

/// Measures frames before each of which all paths move.
pub(crate) fn changes(
    session: &Session<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let all = Moves {
        share: 1.0,
        way: Way::Drop,
    };
    let paths = |dataset| session.plan.view_paths(dataset);
    let mut open: Vec<_> = session.cases().collect();
    open.retain(|&(dataset, spec)| {
        Reading::settled(&out.changes, dataset, paths(dataset), spec) == 0
    });
    for (i, &(dataset, spec)) in open.iter().enumerate() {
        session.show_progress(&format!("changes: {spec} on {}", dataset.name()));
        let paths = paths(dataset);
        let scene = session.scene(dataset, paths);
        let edits = Edits::new(&scene, all);
        let view = View::fit(session.size, scene.bounds())?;
        let time = time.share(open.len() - i);
        let outcome = session.measure_all(spec, &scene, &[view], Some(&edits), time)?;
        for outcome in outcome {
            Reading::new(dataset, paths, paths as f64, spec, outcome).put(&mut out.changes);
        }
    }
    Ok(())
}

fn measure(
    session: &Session<'_>,
    spec: &str,
    scene: &Arc<Scene>,
    time: Deadline,
) -> Result<Outcome, RenderError> {
    let all = View::fit(session.size, scene.bounds())?;
    let mut outcome = session
        .measure_all(spec, scene, &[all], None, time)?
        .remove(0);
    if let (Outcome::Measured(measured), Ok(method)) = (&mut outcome, session.method(spec)) {
        // Figure 5.5 shows the phases of the grid; other methods need no repetition.
        let has_phases = measured.prepare.stages.iter().any(|s| s.name == SAMPLE);
        if !has_phases {
            return Ok(outcome);
        }
        let mut prepares = Vec::new();
        while prepares.len() < session.plan.repeats && !session.is_over(time) {
            session.cancel.check()?;
            match session.prepare(spec, &*method, scene) {
                Ok(runner) => prepares.push(runner.preparation().clone()),
                Err(error) => return Ok(Outcome::NotMeasured(error.to_string())),
            }
        }
        if let Some(mean) = Prepare::mean(&prepares) {
            measured.prepare = mean;
        }
    }
    Ok(outcome)
}
