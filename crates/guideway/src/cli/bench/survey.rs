//! `guideway bench --report`: measures this computer, and writes a page to send.

use std::path::Path;
use std::time::Duration;

use guideway::layout::{UserError, shown_path};
use guideway::scene::Cancel;
use guideway_bench::survey::{Survey, page, survey};
use guideway_bench::{Outcome, StartError};

use crate::cli::error::{Exit, usage_error};
use crate::cli::output::{self, Output, REPORT_VERSION};
use crate::cli::part_progress::PartProgress;
use crate::cli::share::is_page;
use crate::cli::text;

/// Name of the report, in the JSON answer and in the file.
const REPORT: &str = "bench-report";
/// Time after which no further case starts.
const LIMIT: Duration = Duration::from_secs(240);

/// Measures with these methods. The general ones that run here, if none is named.
pub(super) fn run(file: &Path, methods: &[String], out: &Output) -> Result<Exit, UserError> {
    let json = file.with_extension("json");
    if !is_page(file) {
        return Err(usage_error(
            "the report of a computer is an HTML page",
            "Name it so, such as `--report laptop.html`",
        ));
    }
    let progress = PartProgress::new(out);
    let show = |case: &str| progress.begin(case);
    let start = |spec: &str| guideway::method(spec).map_err(StartError::new);
    // Ctrl-C ends the process at once: no file is open before the end.
    let mut survey = survey(methods, LIMIT, &start, &Cancel::default(), &show)?;
    drop(progress);
    survey.device_limits = guideway::device_limits();
    output::save(file, page(&survey).as_bytes())?;
    output::save_report(&json, REPORT, REPORT_VERSION, &survey)?;
    out.report(REPORT, &survey, || lines(&survey, file, &json))?;
    Ok(Exit::Clean)
}

fn lines(survey: &Survey, file: &Path, json: &Path) -> String {
    let mut lines = String::new();
    for case in &survey.cases {
        let of_method = case.comparison.methods.iter().map(|contestant| {
            let time = match &contestant.row.outcome {
                Outcome::Measured(measured) => text::time(measured.frame_ms.median),
                Outcome::NotMeasured(_) => "not measured".to_owned(),
            };
            format!("{} {time}", contestant.row.method)
        });
        let times: Vec<String> = of_method.collect();
        lines += &format!("{}: {}\n", case.title, times.join(", "));
    }
    lines += &format!(
        "\nSend {}; {} has the same figures for programs\n",
        shown_path(file),
        shown_path(json)
    );
    lines
}
