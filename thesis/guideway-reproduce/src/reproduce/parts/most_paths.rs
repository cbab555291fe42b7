//! Table 5.1: the most paths at 60 frames a second.

use guideway_scene::{RenderError, View};

use crate::reproduce::Limit;
use crate::reproduce::lab::{Deadline, Lab};
use crate::reproduce::run::{MostPaths, OUT_OF_TIME, Results};
use crate::reproduce::search::Found;
use guideway_bench::{Dataset, Measured, Outcome, Row};

/// Searches for the most paths of each method and dataset.
pub(crate) fn most_paths(
    lab: &Lab<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let rows = &mut out.most_paths;
    let mut open: Vec<_> = lab.cases().collect();
    open.retain(|&(dataset, spec)| {
        place(rows, dataset, spec).is_none_or(|place| rows[place].limit == Limit::Time)
    });
    for (i, &(dataset, spec)) in open.iter().enumerate() {
        let place = place(rows, dataset, spec);
        let begun = place.map_or_else(Found::nothing, |place| begun(&rows[place]));
        let found = find(lab, dataset, spec, begun, time.share(open.len() - i))?;
        let row = row(dataset, spec, found);
        match place {
            Some(place) => rows[place] = row,
            None => rows.push(row),
        }
    }
    Ok(())
}

fn place(rows: &[MostPaths], dataset: Dataset, spec: &str) -> Option<usize> {
    let is_own = |row: &MostPaths| row.dataset == dataset && row.row.method == spec;
    rows.iter().position(is_own)
}

/// A search as far as it went.
fn begun(row: &MostPaths) -> Found<Measured> {
    Found {
        best: row.paths.zip(row.row.measured().cloned()),
        limit: row.limit,
        reason: row.reason.clone(),
        trials: row.trials.clone(),
    }
}

fn find(
    lab: &Lab<'_>,
    dataset: Dataset,
    spec: &str,
    begun: Found<Measured>,
    time: Deadline,
) -> Result<Found<Measured>, RenderError> {
    lab.plan.search.run(
        begun,
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
                (Limit::Time, _) => OUT_OF_TIME,
                (_, Some(reason)) => reason,
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
