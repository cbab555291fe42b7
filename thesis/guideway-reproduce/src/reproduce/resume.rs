//! Taking up a run that its time or its user cut short, perhaps from a file that somebody changed.

use guideway_layout::Limits;
use guideway_scene::{Cancel, RenderError};

use super::lab::Lab;
use super::{Run, measure};
use guideway_bench::Start;

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ResumeError {
    /// What it says of itself cannot be.
    #[error("{0}")]
    Damaged(String),
    /// A method runs elsewhere than before, so that its numbers would not compare.
    #[error("{method} ran on {before}, and here it runs on {here}")]
    Device {
        /// The method with its options.
        method: String,
        /// Its device in the run.
        before: String,
        /// Its device now.
        here: String,
    },
    /// The plan's pictures have no possible size.
    #[error(transparent)]
    Render(#[from] RenderError),
}

/// Measures what a run lacks, because its time was over, it was stopped, or a part of it failed. All that was
/// measured stays, and a search goes on from its trials. A run that lacks nothing comes back as it is.
///
/// # Errors
/// When the run is damaged, or the devices of its methods are not those of before.
pub fn resume(
    run: Run,
    start: Start<'_>,
    cancel: &Cancel,
    progress: &dyn Fn(&str),
) -> Result<Run, ResumeError> {
    check_counts(&run)?;
    let plan = run.plan.clone();
    let lab = Lab::new(&plan, start, cancel, progress)?;
    check_devices(&run, &lab)?;
    Ok(measure(run, &lab))
}

/// Whether every number of paths can be measured.
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
        let why = format!("it has a dataset of {paths} paths, where 1 to {most} can be measured");
        return Err(ResumeError::Damaged(why));
    }
    if search.least > search.ceiling {
        let (least, ceiling) = (search.least, search.ceiling);
        let why = format!("its search goes from {least} paths up to {ceiling}");
        return Err(ResumeError::Damaged(why));
    }
    Ok(())
}

fn check_devices(run: &Run, lab: &Lab<'_>) -> Result<(), ResumeError> {
    for facts in lab.facts() {
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
