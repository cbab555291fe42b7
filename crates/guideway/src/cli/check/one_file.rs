//! Reads and checks one file; one that cannot be read has a finding that says why.

use guideway::formats::ReadError;
use guideway::layout::{
    Code, Diagnostics, Layout, Limits, Place, UserError, check_watched, shown_path,
};
use guideway::network::analyze_watched;

use super::args::Args;
use super::clearance::ClearanceCheck;
use super::config::{Configs, Rules};
use super::findings::CheckedFile;
use crate::cli::input::{self, Input};
use crate::cli::limits;
use crate::cli::output::Output;

/// A checked file with its layout, and the durations of both steps in milliseconds.
pub(super) struct Checked {
    pub(super) file: CheckedFile,
    pub(super) layout: Option<Layout>,
    pub(super) read_ms: f64,
    pub(super) check_ms: f64,
}

/// Checks a file by itself.
///
/// # Errors
/// When its file of settings is not valid, or no path has an envelope.
pub(super) fn check_file(
    args: &Args,
    input: &Input,
    configs: &mut Configs,
    clearance: Option<&ClearanceCheck>,
    out: &Output,
) -> Result<Checked, UserError> {
    let (rules, config) = configs.rules(&input.path)?;
    let rules = args.override_rules(rules);
    let mut file = CheckedFile::new(input, config, &rules);
    let progress = out.progress(format!("reading {}", shown_path(&input.path)));
    let limits = Limits {
        diagnostics_per_code: args.findings_per_kind(),
        ..limits::limits_over(&rules.limits)
    };
    let options = limits::read_options_within(limits, Some(&progress));
    let layout = input::read_input(&input.path, &options).map_err(Unread::from);
    let layout = layout.and_then(|mut layout| {
        input::place(&mut layout, input, &options.limits)?;
        Ok(layout)
    });
    let read_ms = progress.finish();
    let mut layout = match layout {
        Ok(layout) => layout,
        Err(unread) => {
            unread.report(&mut file);
            return Ok(Checked {
                file,
                layout: None,
                read_ms,
                check_ms: 0.0,
            });
        }
    };
    let progress = out.progress("checking");
    // A doubt about the unit comes first: findings of the reader may follow from it.
    let paths = layout.path_count() as u64;
    // Clearances take as long as all else, and tell nothing before they are known.
    let whole = if clearance.is_some() { 0.5 } else { 1.0 };
    let at = |share: f64| progress.share(whole * share, paths);
    let options = args.check_options(&rules);
    let mut found = check_watched(&layout, &options, &|share| at(0.5 * share));
    let options = args.network_options(&rules);
    found.append(analyze_watched(&layout, &options, &|share| {
        at(0.5 + 0.5 * share);
    }));
    found.append(std::mem::take(&mut layout.diagnostics));
    let clearance = clearance.map(|check| check.run(&layout, &mut found));
    file.paths = layout.path_count() as u64;
    file.refused = layout.refused.len() as u64;
    file.clearance = clearance.transpose()?;
    file.found = found;
    Ok(Checked {
        file,
        layout: Some(layout),
        read_ms,
        check_ms: progress.finish(),
    })
}

/// Removes the findings that the rules leave out.
pub(super) fn apply(rules: &Rules, found: &mut Diagnostics) {
    found.retain(|code, _| rules.reports(code), |_| true);
}

/// Why a file could not be read.
struct Unread {
    place: Place,
    /// The problem without the name of the file.
    message: String,
    error: UserError,
}

impl From<ReadError> for Unread {
    fn from(error: ReadError) -> Self {
        Self {
            place: error.problem.place(),
            message: error.problem.to_string(),
            error: error.into(),
        }
    }
}

impl From<UserError> for Unread {
    fn from(error: UserError) -> Self {
        Self {
            place: Place::element("the file"),
            message: error.message.clone(),
            error,
        }
    }
}

impl Unread {
    fn report(self, file: &mut CheckedFile) {
        let Self {
            place,
            message,
            error,
        } = self;
        let remedy = error.remedy.clone();
        file.found
            .push(Code::Unreadable, || place, || message, remedy);
        file.unread = Some(error);
    }
}
