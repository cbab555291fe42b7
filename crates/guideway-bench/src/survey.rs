//! A survey of a computer: the same contests everywhere, in minutes, as one page to send.
//!
//! | stage | input | output |
//! |---|---|---|
//! | [`survey`] | methods, a time limit | a [`Survey`]: the computer and a contest per case |
//! | [`page`] | a survey | a self-contained HTML page |

use std::time::{Duration, Instant, SystemTime};

use guideway_scene::density::ToneMap;
use guideway_scene::{Budget, Cancel, FrameSize, LineRule, RenderError, Shading, Style};
use serde::{Deserialize, Serialize};

use crate::format;
use crate::page::{Cell, Column, Table, document, element, escape, facts};
use crate::{
    Comparison, Contest, Contestant, Dataset, Machine, Motion, Moves, Outcome, Start, StylePreset,
    Way, compare,
};

/// Width of the measured pictures in pixels: that of most screens of office laptops.
const SIZE_PX: [u32; 2] = [1920, 1080];
/// Drawing time of a case and a method after which one measured frame suffices.
const ENOUGH_MS: f64 = 4_000.0;
/// Memory per method.
const MEMORY_BYTES: u64 = 2_000_000_000;

/// One case: a scene and what changes from frame to frame.
#[derive(Clone, Copy, Debug)]
struct Case {
    title: &'static str,
    dataset: Dataset,
    paths: usize,
    motion: Motion,
    magnify: f64,
    style_preset: StylePreset,
    is_density: bool,
}

const PLAIN: Case = Case {
    title: "",
    dataset: Dataset::D1,
    paths: 100_000,
    motion: Motion::Zoom,
    magnify: 1.0,
    style_preset: StylePreset::Own,
    is_density: false,
};

/// The cases, those that say most first: the time limit may leave out the last ones.
const CASES: [Case; 10] = [
    Case {
        title: "A site of 100,000 paths, zooming",
        ..PLAIN
    },
    Case {
        title: "A site of 100,000 paths, dragging a tenth of them",
        motion: Motion::Edit,
        ..PLAIN
    },
    Case {
        title: "A site of a million paths, zooming",
        paths: 1_000_000,
        ..PLAIN
    },
    Case {
        title: "A site of a million paths, panning",
        paths: 1_000_000,
        motion: Motion::Pan,
        ..PLAIN
    },
    Case {
        title: "A site of a million paths, zooming, 20 times nearer",
        paths: 1_000_000,
        magnify: 20.0,
        ..PLAIN
    },
    Case {
        title: "A site of a million paths, dragging a tenth of them",
        paths: 1_000_000,
        motion: Motion::Edit,
        ..PLAIN
    },
    Case {
        title: "A site of 100,000 paths in many colors and widths, zooming",
        style_preset: StylePreset::Mixed,
        ..PLAIN
    },
    Case {
        title: "The density of 100,000 paths, zooming",
        is_density: true,
        ..PLAIN
    },
    Case {
        title: "100,000 paths that overlap everywhere, zooming",
        dataset: Dataset::D2,
        ..PLAIN
    },
    Case {
        title: "A site of 10,000 paths, zooming",
        paths: 10_000,
        ..PLAIN
    },
];

/// Anchors of the cases in the page.
const ANCHORS: [&str; CASES.len()] = [
    "case-1", "case-2", "case-3", "case-4", "case-5", "case-6", "case-7", "case-8", "case-9",
    "case-10",
];

/// A survey of one computer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Survey {
    /// The computer and the program.
    pub machine: Machine,
    /// Limits of the graphics device, by name.
    pub device_limits: Vec<(String, String)>,
    /// Start of the survey (RFC 3339).
    pub started: String,
    /// Duration in seconds.
    pub elapsed_s: f64,
    /// Cases that the time limit left out.
    pub cases_left_out: usize,
    /// The measured cases.
    pub cases: Vec<SurveyCase>,
}

/// One measured case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurveyCase {
    /// The case in words.
    pub title: String,
    /// Its measurements.
    #[serde(flatten)]
    pub comparison: Comparison,
}

/// Measures the cases with all methods until the limit, at least one; a started case runs to its
/// end. `progress` receives the title of each case.
///
/// # Errors
/// When the caller cancels.
pub fn survey(
    methods: &[String],
    limit: Duration,
    start: Start<'_>,
    cancel: &Cancel,
    progress: &dyn Fn(&str),
) -> Result<Survey, RenderError> {
    let (began, started) = (SystemTime::now(), Instant::now());
    let mut cases = Vec::new();
    for case in CASES {
        if !cases.is_empty() && started.elapsed() >= limit {
            break;
        }
        progress(case.title);
        let comparison = compare(&case.contest(methods)?, start, cancel)?;
        cases.push(SurveyCase {
            title: case.title.to_owned(),
            comparison,
        });
    }
    Ok(Survey {
        machine: Machine::here(),
        device_limits: Vec::new(),
        started: humantime::format_rfc3339_seconds(began).to_string(),
        elapsed_s: started.elapsed().as_secs_f64(),
        cases_left_out: CASES.len() - cases.len(),
        cases,
    })
}

impl Case {
    fn contest(&self, methods: &[String]) -> Result<Contest, RenderError> {
        Ok(Contest {
            name: self.dataset.name().to_owned(),
            scene: self.style_preset.scene(self.dataset.scene(self.paths)),
            style_preset: self.style_preset,
            methods: methods.to_vec(),
            size: FrameSize::new(SIZE_PX[0], SIZE_PX[1])?,
            magnify: self.magnify,
            motion: self.motion,
            edit: Moves {
                share: 0.1,
                way: Way::Gesture,
            },
            style: Style {
                line_rule: LineRule::default(),
                shading: match self.is_density {
                    true => Shading::Density(ToneMap::default()),
                    false => Shading::Color,
                },
                ..Style::default()
            },
            budget: Budget {
                memory_bytes: MEMORY_BYTES,
                threads: 0,
            },
            warmup: 2,
            frames: 20,
            enough_ms: ENOUGH_MS,
        })
    }
}

/// The page of a survey.
pub fn page(survey: &Survey) -> String {
    let title = "Guideway on this computer";
    let mut body = format!("<header>\n{}", element("h1", title));
    if survey.machine.profile != "release" {
        body += "<p class=\"notice\">Compiled with the debug profile: times on the processor are \
                 longer than in a release build.</p>\n";
    }
    let mut about = vec![
        ("Measured", survey.started.clone()),
        ("Processor", survey.machine.processor()),
        ("System", survey.machine.os.clone()),
        ("Guideway", survey.machine.build()),
    ];
    let devices = devices(survey);
    about.extend(
        devices
            .iter()
            .map(|(method, device)| (&**method, device.clone())),
    );
    let limits = survey.device_limits.iter();
    about.extend(limits.map(|(name, value)| (&**name, value.clone())));
    body += &facts(&about);
    body += "</header>\n<main>\n<p>Milliseconds per frame of 1920 x 1080 pixels: the median, and \
             the 5th and 95th percentile. A screen shows 60 frames per second if a frame takes \
             16.7 ms or less.</p>\n";
    for ((number, anchor), case) in (1..).zip(ANCHORS).zip(&survey.cases) {
        let heading = format!("{number}. {}", escape(&case.title));
        body += &format!(
            "<section>\n<h2>{heading}</h2>\n{}",
            table(anchor, case).html()
        );
        for contestant in &case.comparison.methods {
            if let Outcome::NotMeasured(why) = &contestant.row.outcome {
                let text = format!("{}: not measured: {why}", contestant.row.method);
                body += &element("p", &text);
            }
        }
        body += "</section>\n";
    }
    if survey.cases_left_out > 0 {
        let text = format!("The time limit left out {} cases.", survey.cases_left_out);
        body += &element("p", &text);
    }
    body += "</main>\n";
    document(title, &body)
}

/// The device of each method.
fn devices(survey: &Survey) -> Vec<(String, String)> {
    let first = survey.cases.first().map(|case| &case.comparison.methods);
    let methods = first.into_iter().flatten();
    let device = |contestant: &Contestant| {
        let device = contestant.device.clone()?;
        Some((format!("Method {}", contestant.row.method), device))
    };
    methods.filter_map(device).collect()
}

fn table(anchor: &'static str, case: &SurveyCase) -> Table {
    let megabytes = |bytes: Option<u64>| Cell::from(bytes.map(format::megabytes));
    let measured = |contestant: &Contestant| {
        let measured = contestant.row.measured()?;
        let times = |s: &crate::Summary| Cell::Range([s.median, s.p5, s.p95]);
        let on_device = measured.device_wall_ms.as_ref();
        Some(vec![
            Cell::text(&contestant.row.method),
            times(&measured.frame_ms),
            times(&measured.wall_ms),
            on_device.map_or(Cell::Nothing, times),
            Cell::Number(measured.first_frame.wall_ms),
            Cell::Number(measured.prepare.wall_ms),
            megabytes(Some(measured.peak_bytes)),
            Cell::from(measured.work.tests_a_pixel),
            Cell::from(measured.work.atomics),
            megabytes(measured.work.bytes_read),
            megabytes(measured.work.bytes_written),
        ])
    };
    Table {
        name: anchor,
        title: scene(&case.comparison),
        is_folded: false,
        columns: vec![
            Column::in_page("Method"),
            Column::in_page("Frame (ms)"),
            Column::in_page("Wall time (ms)"),
            Column::in_page("Wall time, picture left on the device (ms)"),
            Column::in_page("First (ms)"),
            Column::in_page("Preparing (ms)"),
            Column::in_page("Memory (MB)"),
            Column::in_page("Tests per pixel"),
            Column::in_page("Atomic operations"),
            Column::in_page("Read (MB)"),
            Column::in_page("Written (MB)"),
        ],
        rows: case
            .comparison
            .methods
            .iter()
            .filter_map(measured)
            .collect(),
    }
}

fn scene(comparison: &Comparison) -> String {
    let count = |value: usize| format::count(value as u64);
    format!(
        "{} paths of {} segments",
        count(comparison.scene.paths),
        count(comparison.scene.segments)
    )
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use guideway_cpu::Cpu;
    use guideway_scene::Method;

    use super::*;
    use crate::StartError;

    fn start(spec: &str) -> Result<Box<dyn Method>, StartError> {
        match spec {
            "cpu" => Ok(Box::new(Cpu)),
            _ => Err(StartError::new(format_args!("no <method> `{spec}`"))),
        }
    }

    #[test]
    fn page_shows_each_case_and_what_was_left_out() {
        let methods = ["cpu".to_owned(), "nothing".to_owned()];
        let limit = Duration::from_nanos(1);
        let shown = AtomicUsize::new(0);
        let show = |_: &str| {
            shown.fetch_add(1, Ordering::Relaxed);
        };
        let mut survey = survey(&methods, limit, &start, &Cancel::default(), &show).unwrap();
        assert_eq!((survey.cases.len(), shown.into_inner()), (1, 1));
        assert_eq!(survey.cases_left_out, CASES.len() - 1);
        survey.device_limits = vec![("Largest <buffer>".into(), "2 GB".into())];
        let page = page(&survey);
        let options = roxmltree::ParsingOptions {
            allow_dtd: true,
            ..roxmltree::ParsingOptions::default()
        };
        roxmltree::Document::parse_with_options(&page, options).expect("well-formed");
        for text in [
            "A site of 100,000 paths, zooming",
            "Largest &lt;buffer&gt;",
            "no &lt;method&gt; `nothing`",
            "The time limit left out 9 cases.",
            ">cpu<",
        ] {
            assert!(page.contains(text), "{text}: {page}");
        }
        let json = serde_json::to_string(&survey).unwrap();
        let read: Survey = serde_json::from_str(&json).unwrap();
        assert_eq!(read.cases[0].title, survey.cases[0].title);
        assert_eq!(read.device_limits, survey.device_limits);
    }

    #[test]
    fn cancelling_ends_the_survey() {
        let cancel = Cancel::default();
        cancel.set();
        let methods = ["cpu".to_owned()];
        let result = survey(&methods, Duration::MAX, &start, &cancel, &|_| ());
        assert_eq!(result, Err(RenderError::Cancelled));
    }
}
