//! Arguments of `check`, and the rules that result from them and from `guideway.toml`.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::layout::{CheckOptions, Code, Limits};
use guideway::network::AnalyzeOptions;

use super::baseline::FINDINGS_PER_KIND;
use super::clearance::ClearanceArgs;
use super::codes::{self, FailOn};
use super::config::Rules;
use crate::cli::input::{self, Input};
use crate::cli::output::is_stdout;
use crate::cli::values;

#[derive(Debug, clap::Args)]
#[command(
    after_help = format!("Exit codes: 0 no finding at or above the failing level, 1 such findings, \
    2 no file could be read.\n\nOptions come from the nearest `guideway.toml` at the file or above \
    it, too; arguments override it.\n\n{}", input::PLACEMENT_HELP)
)]
pub(crate) struct Args {
    /// Layout files, each checked by itself; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    pub(super) inputs: Vec<Input>,
    /// The files are one layout: an identifier occurs once in all of them
    #[arg(long)]
    pub(super) together: bool,
    /// Form of the report: a table, JSON (the same as --json), or SARIF 2.1.0 for code review tools
    #[arg(long, default_value = "table")]
    pub(super) format: Format,
    /// File for the report, in place of standard output
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Least severity of findings that make the exit code 1 [default: error]
    #[arg(long, value_name = "LEVEL")]
    fail_on: Option<FailOn>,
    /// The same as `--fail-on warning`
    #[arg(long, conflicts_with = "fail_on")]
    strict: bool,
    /// Report findings of these kinds only, such as `node-gap,kink`
    #[arg(long, value_name = "CODE,...", value_delimiter = ',', value_parser = codes::code)]
    only: Vec<Code>,
    /// Leave out findings of these kinds
    #[arg(long, value_name = "CODE,...", value_delimiter = ',', value_parser = codes::code)]
    ignore: Vec<Code>,
    /// File of options for all files, in place of the nearest `guideway.toml` of each
    #[arg(long, value_name = "FILE")]
    pub(super) config: Option<PathBuf>,
    /// Known findings, which are not reported and do not count
    #[arg(long, value_name = "FILE")]
    pub(super) baseline: Option<PathBuf>,
    /// Save the findings as known ones for --baseline; they do not count
    #[arg(long, value_name = "FILE")]
    pub(super) write_baseline: Option<PathBuf>,
    /// Draw the findings of one file to a PNG, SVG or PDF file; `-` is standard output, as PNG
    #[arg(long, value_name = "FILE")]
    pub(super) picture: Option<PathBuf>,
    /// Findings to show per kind; JSON and SARIF hold more
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub(super) show: usize,
    /// Maximum distance from the end of a path to its node [default: 0.01, and less in a layout of
    /// paths shorter than a meter]
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    gap: Option<f64>,
    /// Maximum change of direction at a smooth joint [default: 5]
    #[arg(
        long,
        value_name = "DEGREES",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    kink: Option<f64>,
    /// Minimum turning radius of the vehicles; without it, radii are not checked
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::positive,
        allow_hyphen_values = true
    )]
    min_radius: Option<f64>,
    /// Largest lateral acceleration in bends, in m/s²; without it, speeds are not checked
    #[arg(
        long,
        value_name = "VALUE",
        value_parser = values::positive,
        allow_hyphen_values = true
    )]
    lateral_acceleration: Option<f64>,
    #[command(flatten)]
    pub(super) clearance: ClearanceArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    Table,
    Json,
    Sarif,
}

impl Args {
    /// The file for the report; `None` for standard output.
    pub(super) fn report_file(&self) -> Option<&Path> {
        self.output.as_deref().filter(|path| !is_stdout(path))
    }

    /// Overrides the rules of a file. `--only` replaces what the rules select and ignore.
    pub(super) fn override_rules(&self, mut rules: Rules) -> Rules {
        if !self.only.is_empty() {
            rules.only = Some(self.only.clone());
            rules.ignore.clear();
        }
        rules.ignore.extend(&self.ignore);
        let strict = self.strict.then_some(FailOn::Warning);
        rules.fail_on = self.fail_on.or(strict).or(rules.fail_on);
        rules.gap_m = self.gap.or(rules.gap_m);
        rules.kink_deg = self.kink.or(rules.kink_deg);
        rules.min_radius_m = self.min_radius.or(rules.min_radius_m);
        let acceleration = self.lateral_acceleration;
        rules.lateral_acceleration_m_s2 = acceleration.or(rules.lateral_acceleration_m_s2);
        rules
    }

    /// Findings of each kind to keep: a baseline compares all that it can.
    pub(super) fn findings_per_kind(&self) -> usize {
        match (&self.baseline, &self.write_baseline) {
            (None, None) => Limits::default().diagnostics_per_code,
            _ => FINDINGS_PER_KIND,
        }
    }

    pub(super) fn check_options(&self, rules: &Rules) -> CheckOptions {
        let default = CheckOptions::default();
        let kink_rad = rules.kink_deg.map(f64::to_radians);
        CheckOptions {
            gap_tolerance_m: rules.gap_m,
            kink_angle_rad: kink_rad.unwrap_or(default.kink_angle_rad),
            min_radius_m: rules.min_radius_m,
            diagnostics_per_code: self.findings_per_kind(),
            ..default
        }
    }

    pub(super) fn network_options(&self, rules: &Rules) -> AnalyzeOptions {
        AnalyzeOptions {
            lateral_acceleration_m_s2: rules.lateral_acceleration_m_s2,
            diagnostics_per_code: self.findings_per_kind(),
            ..AnalyzeOptions::default()
        }
    }
}
