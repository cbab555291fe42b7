//! Measures the methods of a contest side by side and returns the comparison.

use std::sync::Arc;

use guideway_scene::{Budget, Cancel, FrameSize, Method, RenderError, Scene, Shading, Style, View};
use serde::{Deserialize, Serialize};

use crate::edits::{Edits, Moves, Way};
use crate::measured::MeasureError;
use crate::runner::{FrameRequest, Frames, Runner};
use crate::start::{Start, StartError};
use crate::zoomed_view::zoomed_view;
use crate::{Machine, Motion, Outcome, Row, StylePreset, interleaved};

/// One case in which methods are compared.
#[derive(Clone, Debug)]
pub struct Contest {
    /// Name of the scene: `d1`, `d2` or a file name.
    pub name: String,
    /// Scene to draw.
    pub scene: Arc<Scene>,
    /// Style preset of the scene, for the report.
    pub style_preset: StylePreset,
    /// Methods with their options; ratios are relative to the first.
    pub methods: Vec<String>,
    /// Size of the picture.
    pub size: FrameSize,
    /// Zoom factor about the densest point; 1 shows all paths, less zooms out.
    pub magnify: f64,
    /// Change from frame to frame.
    pub motion: Motion,
    /// Paths that [`Motion::Edit`] moves.
    pub edit: Moves,
    /// Style of the frames.
    pub style: Style,
    /// Memory and threads per method.
    pub budget: Budget,
    /// Unmeasured frames after the first.
    pub warmup: usize,
    /// Measured frames.
    pub frames: usize,
    /// Drawing time of a method in milliseconds after which one measured frame suffices.
    pub enough_ms: f64,
}

/// The result of a [`Contest`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The measuring computer.
    pub machine: Machine,
    /// The scene.
    pub scene: SceneFacts,
    /// Colors and widths of its paths.
    #[serde(default, rename = "dress")]
    pub style_preset: StylePreset,
    /// True if pixels show the number of paths instead of their colors.
    #[serde(default)]
    pub is_density: bool,
    /// View of the first frame.
    pub view: ViewFacts,
    /// Change from frame to frame.
    pub motion: Motion,
    /// Requested share of moved paths, with [`Motion::Edit`].
    pub edit_share: Option<f64>,
    /// Number of moved paths, at least one.
    pub edit_paths: Option<usize>,
    /// True if each path moves by its own curve.
    pub edit_is_apart: Option<bool>,
    /// Way in which paths move, with [`Motion::Edit`].
    #[serde(default)]
    pub edit_way: Option<Way>,
    /// Unmeasured frames per method after the first.
    pub warmup: usize,
    /// Measured frames per method.
    pub frames: usize,
    /// Memory limit per method.
    pub memory_bytes: u64,
    /// One row per method, in the requested order.
    pub methods: Vec<Contestant>,
}

/// One method of a [`Comparison`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contestant {
    /// Device of the method; `None` if it does not run.
    pub device: Option<String>,
    /// Median frame time relative to the first method.
    pub ratio: Option<f64>,
    /// The measurement.
    #[serde(flatten)]
    pub row: Row,
}

/// Name and size of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneFacts {
    /// `d1`, `d2` or a file name.
    pub name: String,
    /// Paths of the input.
    pub paths: usize,
    /// Cubic segments of all paths.
    pub segments: usize,
}

/// Size, center and scale of a view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewFacts {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Center in meters.
    pub center_m: [f64; 2],
    /// Scale in pixels per meter.
    pub px_per_m: f64,
}

impl From<&View> for ViewFacts {
    fn from(view: &View) -> Self {
        Self {
            size_px: [view.size().width(), view.size().height()],
            center_m: [view.center_m().x, view.center_m().y],
            px_per_m: view.px_per_m(),
        }
    }
}

/// Measures all methods of a contest. A method that does not run gets a row with the reason.
///
/// # Errors
/// When the caller cancels, or the view is out of range.
pub fn compare(
    contest: &Contest,
    start: Start<'_>,
    cancel: &Cancel,
) -> Result<Comparison, RenderError> {
    let view = zoomed_view(contest.size, &contest.scene, contest.magnify)?;
    let is_edited = contest.motion == Motion::Edit;
    let request = FrameRequest {
        view,
        motion: contest.motion,
        edits: is_edited.then(|| Edits::new(&contest.scene, contest.edit)),
        style: contest.style,
        frames: Frames {
            warmup: contest.warmup,
            count: contest.frames,
            enough_ms: contest.enough_ms,
        },
    };
    let started: Vec<Result<Box<dyn Method>, StartError>> =
        contest.methods.iter().map(|spec| start(spec)).collect();
    let outcomes = outcomes(contest, &started, &request, cancel)?;
    let layout = contest.scene.layout();
    Ok(Comparison {
        machine: Machine::here(),
        scene: SceneFacts {
            name: contest.name.clone(),
            paths: layout.path_count(),
            segments: layout.paths.geometry().segment_count(),
        },
        style_preset: contest.style_preset,
        is_density: contest.style.shading != Shading::Color,
        view: ViewFacts::from(&view),
        motion: contest.motion,
        edit_share: is_edited.then_some(contest.edit.share),
        edit_paths: request.edits.as_ref().map(Edits::path_count),
        edit_is_apart: is_edited.then_some(contest.edit.way == Way::Apart),
        edit_way: is_edited.then_some(contest.edit.way),
        warmup: contest.warmup,
        frames: contest.frames,
        memory_bytes: contest.budget.memory_bytes,
        methods: contestants(contest, &started, outcomes),
    })
}

/// One outcome per method, in the requested order.
fn outcomes(
    contest: &Contest,
    started: &[Result<Box<dyn Method>, StartError>],
    request: &FrameRequest,
    cancel: &Cancel,
) -> Result<Vec<Outcome>, RenderError> {
    let mut ready = Vec::new();
    let mut runners = Vec::new();
    for method in started {
        let runner = match method {
            Ok(method) => {
                Runner::new(&**method, &contest.scene, contest.budget).map_err(MeasureError::from)
            }
            Err(error) => Err(error.clone().into()),
        };
        cancel.check()?;
        ready.push(runner.map(|runner| runners.push(runner)));
    }
    let mut measured = interleaved::measure(&mut runners, request, cancel)?.into_iter();
    let outcome = |ready: Result<(), MeasureError>| match ready {
        Err(error) => Outcome::NotMeasured(error.to_string()),
        Ok(()) => match measured.next() {
            Some(result) => Outcome::from(result),
            None => unreachable!("every runner has a result"),
        },
    };
    Ok(ready.into_iter().map(outcome).collect())
}

fn contestants(
    contest: &Contest,
    started: &[Result<Box<dyn Method>, StartError>],
    outcomes: Vec<Outcome>,
) -> Vec<Contestant> {
    let median_ms = |outcome: &Outcome| outcome.measured().map(|m| m.frame_ms.median);
    let first_ms = outcomes.first().and_then(median_ms).filter(|&ms| ms > 0.0);
    let all = contest.methods.iter().zip(started).zip(outcomes);
    all.map(|((spec, method), outcome)| Contestant {
        device: method.as_ref().ok().map(|method| method.info().device),
        ratio: median_ms(&outcome)
            .zip(first_ms)
            .map(|(ms, first)| ms / first),
        row: Row {
            method: spec.clone(),
            outcome,
        },
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use guideway_cpu::{Cpu, Oracle};

    use super::*;

    fn start(spec: &str) -> Result<Box<dyn Method>, StartError> {
        match spec {
            "cpu" => Ok(Box::new(Cpu)),
            "oracle" => Ok(Box::new(Oracle)),
            _ => Err(StartError::new(format_args!("no method `{spec}`"))),
        }
    }

    fn contest(motion: Motion, methods: &[&str]) -> Contest {
        Contest {
            name: "d1".into(),
            scene: crate::Dataset::D1.scene(60),
            style_preset: StylePreset::Own,
            methods: methods.iter().map(|&m| m.to_owned()).collect(),
            size: FrameSize::new(64, 36).unwrap(),
            magnify: 1.0,
            motion,
            edit: Moves {
                share: 0.1,
                way: Way::Gesture,
            },
            style: Style::default(),
            budget: Budget::default(),
            warmup: 1,
            frames: 3,
            enough_ms: f64::INFINITY,
        }
    }

    #[test]
    fn rows_hold_a_measurement_or_the_reason_for_its_absence() {
        for motion in [Motion::Still, Motion::Pan, Motion::Zoom, Motion::Edit] {
            let contest = contest(motion, &["cpu", "nothing", "oracle"]);
            let comparison = compare(&contest, &start, &Cancel::default()).unwrap();
            let [cpu, nothing, oracle] = &comparison.methods[..] else {
                panic!("{comparison:?}");
            };
            assert_eq!(
                nothing.row.outcome,
                Outcome::NotMeasured("no method `nothing`".into())
            );
            assert_eq!((nothing.ratio, cpu.ratio), (None, Some(1.0)));
            for contestant in [cpu, oracle] {
                let measured = contestant.row.measured().expect("it runs");
                assert_eq!(measured.frame_ms.count, 3);
                assert_eq!(measured.paths.total, 60);
                let is_edited = motion == Motion::Edit;
                assert_eq!(measured.update_ms.is_some(), is_edited);
                assert_eq!(measured.first_frame.update_ms.is_some(), is_edited);
                assert!(contestant.device.is_some() && contestant.ratio.is_some());
            }
        }
    }

    #[test]
    fn magnification_scales_the_view_and_culls_paths() {
        let mut contest = contest(Motion::Still, &["cpu"]);
        let all = compare(&contest, &start, &Cancel::default()).unwrap();
        contest.magnify = 20.0;
        let near = compare(&contest, &start, &Cancel::default()).unwrap();
        assert!((near.view.px_per_m / all.view.px_per_m - 20.0).abs() < 1e-9);
        let drawn = |of: &Comparison| of.methods[0].row.measured().map(|m| m.paths.drawn);
        assert!(drawn(&near) > Some(0) && drawn(&near) < drawn(&all));
    }

    #[test]
    fn exceeded_budget_is_reported_with_its_option() {
        let mut contest = contest(Motion::Still, &["cpu", "oracle"]);
        contest.budget.memory_bytes = 1000;
        let comparison = compare(&contest, &start, &Cancel::default()).unwrap();
        for contestant in &comparison.methods {
            let Outcome::NotMeasured(why) = &contestant.row.outcome else {
                panic!("1000 bytes do: {contestant:?}");
            };
            assert!(why.contains("--memory"), "{why}");
        }
    }

    #[test]
    fn cancelling_ends_the_comparison() {
        let cancel = Cancel::default();
        cancel.set();
        let result = compare(&contest(Motion::Still, &["cpu"]), &start, &cancel);
        assert_eq!(result, Err(RenderError::Cancelled));
    }
}
