//! Table 5.1: searches for the most paths at 60 frames per second.

use guideway_scene::{RenderError, View};

use crate::reproduce::deadline::Deadline;
use crate::reproduce::run::{MostPaths, OUT_OF_TIME, Results};
use crate::reproduce::search::{Limit, SearchState, TrialOutcome};
use crate::reproduce::session::Session;
use guideway_bench::{Dataset, Measured, Outcome, Row};

/// Searches for the most paths of each method and dataset.
pub(crate) fn most_paths(
    session: &Session<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let rows = &mut out.most_paths;
    let mut open: Vec<_> = session.cases().collect();
    open.retain(|&(dataset, spec)| {
        index_of(rows, dataset, spec).is_none_or(|index| rows[index].limit == Limit::Time)
    });
    for (i, &(dataset, spec)) in open.iter().enumerate() {
        let index = index_of(rows, dataset, spec);
        let begun = index.map_or_else(SearchState::nothing, |index| recorded(&rows[index]));
        let found = find(session, dataset, spec, begun, time.share(open.len() - i))?;
        let row = row(dataset, spec, found);
        match index {
            Some(index) => rows[index] = row,
            None => rows.push(row),
        }
    }
    Ok(())
}

fn index_of(rows: &[MostPaths], dataset: Dataset, spec: &str) -> Option<usize> {
    let is_own = |row: &MostPaths| row.dataset == dataset && row.row.method == spec;
    rows.iter().position(is_own)
}

/// The recorded state of a search.
fn recorded(row: &MostPaths) -> SearchState<Measured> {
    SearchState {
        best: row.paths.zip(row.row.measured().cloned()),
        limit: row.limit,
        reason: row.reason.clone(),
        trials: row.trials.clone(),
    }
}

fn find(
    session: &Session<'_>,
    dataset: Dataset,
    spec: &str,
    begun: SearchState<Measured>,
    time: Deadline,
) -> Result<SearchState<Measured>, RenderError> {
    session.plan.search.run(
        begun,
        || session.is_over(time),
        |paths| {
            session.show_progress(&format!(
                "most paths: {spec} on {}, trying {paths}",
                dataset.name()
            ));
            let scene = session.scene(dataset, paths);
            let all = View::fit(session.size, scene.bounds())?;
            // A started trial runs to its end.
            let mut outcomes =
                session.measure_all(spec, &scene, &[all], None, Deadline::never())?;
            // The thesis uses the mean; the median equals it on an idle machine, and tolerates
            // load.
            Ok(match outcomes.remove(0) {
                Outcome::Measured(measured) => TrialOutcome::Drawn {
                    frame_ms: measured.frame_ms.median,
                    measurement: *measured,
                },
                Outcome::NotMeasured(reason) => TrialOutcome::Refused { reason },
            })
        },
    )
}

fn row(dataset: Dataset, spec: &str, found: SearchState<Measured>) -> MostPaths {
    let (paths, outcome) = match found.best {
        Some((paths, measured)) => (Some(paths), Outcome::Measured(Box::new(measured))),
        None => {
            let reason = match (found.limit, &found.reason) {
                (Limit::Time, _) => OUT_OF_TIME,
                (_, Some(reason)) => reason,
                (_, None) => "even the fewest paths of the search exceed the frame time",
            };
            (None, Outcome::NotMeasured(reason.to_owned()))
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
