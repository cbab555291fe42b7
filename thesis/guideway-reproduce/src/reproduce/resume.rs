//! Continues a run that its time limit or its user cut short, after checks of the run file.

use guideway_layout::Limits;
use guideway_scene::{Cancel, RenderError};

use super::measure::measure;
use super::run::Run;
use super::session::Session;
use guideway_bench::Start;

/// A run cannot continue.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ResumeError {
    /// The record holds impossible values.
    #[error("{0}")]
    Damaged(String),
    /// A method runs on another device than before, so that the times are not comparable.
    #[error("method `{method}` ran on {before}; on this computer it runs on {here}")]
    Device {
        /// The method with its options.
        method: String,
        /// Its device in the run.
        before: String,
        /// Its device now.
        here: String,
    },
    /// The picture size of the plan is invalid.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// Measures the parts that a run lacks after a time limit, a stop or a failure. Existing
/// measurements stay, and a search continues from its trials. A complete run returns unchanged.
///
/// # Errors
/// When the record is damaged, or a method runs on another device than before.
pub fn resume(
    run: Run,
    start: Start<'_>,
    cancel: &Cancel,
    progress: &dyn Fn(&str),
) -> Result<Run, ResumeError> {
    check_counts(&run)?;
    let plan = run.plan.clone();
    let session = Session::new(&plan, start, cancel, progress)?;
    check_devices(&run, &session)?;
    Ok(measure(run, &session))
}

/// Checks that every number of paths in the record is within the limits of a layout.
fn check_counts(run: &Run) -> Result<(), ResumeError> {
    let (plan, search) = (&run.plan, &run.plan.search);
    let found = run.results.most_paths.iter();
    let trials = found.flat_map(|found| found.trials.iter().map(|trial| trial.paths));
    let most = usize::try_from(Limits::default().paths).unwrap_or(usize::MAX);
    let mut counts = [search.start, search.least, search.ceiling]
        .into_iter()
        .chain(plan.view_paths)
        .chain(plan.sizes.iter().copied())
        .chain(trials);
    if let Some(paths) = counts.find(|paths| !(1..=most).contains(paths)) {
        let why = format!("a dataset of {paths} paths is outside the limits of 1 to {most} paths");
        return Err(ResumeError::Damaged(why));
    }
    if search.least > search.ceiling {
        let (least, ceiling) = (search.least, search.ceiling);
        let why = format!("the search range from {least} to {ceiling} paths is empty");
        return Err(ResumeError::Damaged(why));
    }
    Ok(())
}

fn check_devices(run: &Run, session: &Session<'_>) -> Result<(), ResumeError> {
    for facts in session.facts() {
        let mut before = run.methods.iter().filter(|m| m.method == facts.method);
        let before = before.next().and_then(|m| m.device.clone());
        if before != facts.device {
            let name = |device: Option<String>| device.unwrap_or_else(|| "no device".to_owned());
            return Err(ResumeError::Device {
                method: facts.method,
                before: name(before),
                here: name(facts.device),
            });
        }
    }
    Ok(())
}
