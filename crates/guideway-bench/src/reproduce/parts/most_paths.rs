//! Table 5.1: the most paths at 60 frames a second.

use guideway_render::{RenderError, View};

use crate::reproduce::Limit;
use crate::reproduce::lab::{Deadline, Lab, OUT_OF_TIME};
use crate::reproduce::run::{MostPaths, Results};
use crate::reproduce::search::Found;
use crate::{Dataset, Measured, Outcome, Row};

/// Searches for the most paths of each method and dataset.
pub(crate) fn most_paths(
    lab: &Lab<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let methods = &lab.plan.methods;
    for (i, dataset) in Dataset::ALL.into_iter().enumerate() {
        for (j, spec) in methods.iter().enumerate() {
            let left = (Dataset::ALL.len() - i) * methods.len() - j;
            let found = find(lab, dataset, spec, time.share(left))?;
            out.most_paths.push(row(dataset, spec, found));
        }
    }
    Ok(())
}

fn find(
    lab: &Lab<'_>,
    dataset: Dataset,
    spec: &str,
    time: Deadline,
) -> Result<Found<Measured>, RenderError> {
    lab.plan.search.run(
        || lab.is_over(time),
        |paths| {
            lab.tell(&format!(
                "most paths: {spec} on {}, trying {paths}",
                dataset.name()
            ));
            let scene = lab.scene(dataset, paths);
            let all = View::fit(lab.size, scene.bounds())?;
            // A trial that has begun is measured to its end.
            let mut outcomes = lab.measure_all(spec, &scene, &[all], Deadline::never())?;
            // The thesis goes by the mean; the median is the same on a quiet machine, and bears a busy one.
            Ok(match outcomes.remove(0) {
                Outcome::Measured(measured) => Ok((measured.frame_ms.median, *measured)),
                Outcome::WhyNot(why) => Err(why),
            })
        },
    )
}

fn row(dataset: Dataset, spec: &str, found: Found<Measured>) -> MostPaths {
    let (paths, outcome) = match found.best {
        Some((paths, measured)) => (Some(paths), Outcome::Measured(Box::new(measured))),
        None => {
            let why = match (found.limit, &found.reason) {
                (_, Some(reason)) => reason,
                (Limit::Time, None) => OUT_OF_TIME,
                (_, None) => "even the fewest paths that were tried take too long",
            };
            (None, Outcome::WhyNot(why.to_owned()))
        }
    };
    MostPaths {
        dataset,
        paths,
        limit: found.limit,
        reason: found.reason,
        trials: found.trials,
        row: Row {
            method: spec.to_owned(),
            outcome,
        },
    }
}
