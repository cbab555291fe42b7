//! Figures 5.4 and 5.5: how times grow with the number of paths, everything in view.

use std::sync::Arc;

use guideway_scene::Scene;
use guideway_scene::{RenderError, View};

use crate::reproduce::lab::{Deadline, Lab};
use crate::reproduce::names::SAMPLE;
use crate::reproduce::run::{Reading, Results};
use guideway_bench::Outcome;
use guideway_bench::Prepare;

/// Times of making ready and of drawing against the number of paths.
pub(crate) fn growth(lab: &Lab<'_>, time: Deadline, out: &mut Results) -> Result<(), RenderError> {
    let of_size = |&paths: &usize| {
        lab.cases()
            .map(move |(dataset, spec)| (paths, dataset, spec))
    };
    // From few paths to many: if the time does not do, the long ones are missing.
    let mut open: Vec<_> = lab.plan.sizes.iter().flat_map(of_size).collect();
    open.retain(|&(paths, dataset, spec)| Reading::settled(&out.growth, dataset, paths, spec) == 0);
    for (i, &(paths, dataset, spec)) in open.iter().enumerate() {
        lab.tell(&format!(
            "growth: {spec} on {} with {paths} paths",
            dataset.name()
        ));
        let scene = lab.scene(dataset, paths);
        let outcome = measure(lab, spec, &scene, time.share(open.len() - i))?;
        Reading::new(dataset, paths, paths as f64, spec, outcome).put(&mut out.growth);
    }
    Ok(())
}

fn measure(
    lab: &Lab<'_>,
    spec: &str,
    scene: &Arc<Scene>,
    time: Deadline,
) -> Result<Outcome, RenderError> {
    let all = View::fit(lab.size, scene.bounds())?;
    let mut outcome = lab.measure_all(spec, scene, &[all], time)?.remove(0);
    if let (Outcome::Measured(measured), Ok(method)) = (&mut outcome, lab.method(spec)) {
        // Figure 5.5 is about the phases of a build; without them once is enough.
        let has_phases = measured.prepare.stages.iter().any(|s| s.name == SAMPLE);
        if !has_phases {
            return Ok(outcome);
        }
        let mut prepares = Vec::new();
        while prepares.len() < lab.plan.repeats && !lab.is_over(time) {
            lab.cancel.check()?;
            match lab.ready(spec, &*method, scene) {
                Ok(runner) => prepares.push(runner.preparation().clone()),
                Err(fault) => return Ok(Outcome::WhyNot(fault.to_string())),
            }
        }
        if let Some(mean) = Prepare::mean(&prepares) {
            measured.prepare = mean;
        }
    }
    Ok(outcome)
}
