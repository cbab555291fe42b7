use std::sync::Arc;

use guideway_scene::Scene;
use guideway_scene::{Budget, Cancel, FrameSize, Method, RenderError, Shading, Style, View};
use serde::{Deserialize, Serialize};

use crate::edits::{Edits, Moves};
use crate::measured::Fault;
use crate::runner::{Frames, Runner, Shot};
use crate::zoomed_view::zoomed_view;
use crate::{Dress, Machine, Motion, Outcome, Row, Start, interleaved};

/// One case in which methods are compared.
#[derive(Clone, Debug)]
pub struct Contest {
    /// What the scene is called: `d1`, `d2` or the name of a file.
    pub name: String,
    /// What is drawn.
    pub scene: Arc<Scene>,
    /// How it was dressed, for the record.
    pub dress: Dress,
    /// Methods with their options; ratios are to the first.
    pub methods: Vec<String>,
    /// Size of the picture.
    pub size: FrameSize,
    /// How many times nearer the busiest place than where all is seen; 1 to see all, less for farther away.
    pub magnify: f64,
    /// What changes from frame to frame.
    pub motion: Motion,
    /// What [`Motion::Edit`] moves.
    pub edit: Moves,
    /// How it looks.
    pub style: Style,
    /// What each method may use.
    pub budget: Budget,
    /// Frames after the first that do not count.
    pub warmup: usize,
    /// Frames that count.
    pub frames: usize,
}

/// What came of a [`Contest`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Where it was measured.
    pub machine: Machine,
    /// What was drawn.
    pub scene: SceneFacts,
    /// What its paths look like.
    #[serde(default)]
    pub dress: Dress,
    /// Whether pixels show how many paths there are, in place of their colors.
    #[serde(default)]
    pub is_density: bool,
    /// How the first frame saw it.
    pub view: ViewFacts,
    /// What changed from frame to frame.
    pub motion: Motion,
    /// Share of the paths that were to move, with [`Motion::Edit`].
    pub edit_share: Option<f64>,
    /// Paths that moved: one at the least.
    pub edit_paths: Option<usize>,
    /// Whether each of them went its own way.
    pub edit_is_apart: Option<bool>,
    /// Frames of each method after the first that do not count.
    pub warmup: usize,
    /// Frames of each method that count.
    pub frames: usize,
    /// Memory that each method was allowed.
    pub memory_bytes: u64,
    /// One row a method, in the order asked for.
    pub methods: Vec<Contestant>,
}

/// One method of a [`Comparison`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contestant {
    /// Where the method runs; none when it does not.
    pub device: Option<String>,
    /// Median frame time in units of the first method's.
    pub ratio: Option<f64>,
    /// What was measured.
    #[serde(flatten)]
    pub row: Row,
}

/// What was drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneFacts {
    /// `d1`, `d2` or the name of a file.
    pub name: String,
    /// Paths of the input.
    pub paths: usize,
    /// Cubic segments of all paths.
    pub segments: usize,
}

/// A view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewFacts {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// The point in the middle, in meters.
    pub center_m: [f64; 2],
    /// Scale in pixels a meter.
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

/// Measures all methods of a contest in one run. A method that does not run gets a row that says why.
///
/// # Errors
/// When the caller cancels, or there is no such view.
pub fn compare(
    contest: &Contest,
    start: Start<'_>,
    cancel: &Cancel,
) -> Result<Comparison, RenderError> {
    let view = zoomed_view(contest.size, &contest.scene, contest.magnify)?;
    let is_edited = contest.motion == Motion::Edit;
    let shot = Shot {
        view,
        motion: contest.motion,
        edits: is_edited.then(|| Edits::new(&contest.scene, contest.edit)),
        style: contest.style,
        frames: Frames {
            warmup: contest.warmup,
            count: contest.frames,
            enough_ms: f64::INFINITY,
        },
    };
    let started: Vec<Result<Box<dyn Method>, String>> =
        contest.methods.iter().map(|spec| start(spec)).collect();
    let outcomes = outcomes(contest, &started, &shot, cancel)?;
    let layout = contest.scene.layout();
    Ok(Comparison {
        machine: Machine::here(),
        scene: SceneFacts {
            name: contest.name.clone(),
            paths: layout.path_count(),
            segments: layout.paths.geometry().segment_count(),
        },
        dress: contest.dress,
        is_density: contest.style.shading != Shading::Color,
        view: ViewFacts::from(&view),
        motion: contest.motion,
        edit_share: is_edited.then_some(contest.edit.share),
        edit_paths: shot.edits.as_ref().map(Edits::path_count),
        edit_is_apart: is_edited.then_some(contest.edit.is_apart),
        warmup: contest.warmup,
        frames: contest.frames,
        memory_bytes: contest.budget.memory_bytes,
        methods: contestants(contest, &started, outcomes),
    })
}

/// One outcome a method, in the order asked for.
fn outcomes(
    contest: &Contest,
    started: &[Result<Box<dyn Method>, String>],
    shot: &Shot,
    cancel: &Cancel,
) -> Result<Vec<Outcome>, RenderError> {
    let mut ready = Vec::new();
    let mut runners = Vec::new();
    for method in started {
        let runner = method.as_ref().map_err(Clone::clone).and_then(|method| {
            let runner = Runner::new(&**method, &contest.scene, contest.budget);
            runner.map_err(|error| Fault::from(error).to_string())
        });
        cancel.check()?;
        ready.push(runner.map(|runner| runners.push(runner)));
    }
    let mut measured = interleaved::measure(&mut runners, shot, cancel)?.into_iter();
    let outcome = |ready: Result<(), String>| match ready {
        Err(why_not) => Outcome::WhyNot(why_not),
        Ok(()) => match measured.next() {
            Some(result) => Outcome::from(result),
            None => unreachable!("every runner has a result"),
        },
    };
    Ok(ready.into_iter().map(outcome).collect())
}

fn contestants(
    contest: &Contest,
    started: &[Result<Box<dyn Method>, String>],
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

    fn start(spec: &str) -> Result<Box<dyn Method>, String> {
        match spec {
            "cpu" => Ok(Box::new(Cpu)),
            "oracle" => Ok(Box::new(Oracle)),
            _ => Err(format!("no `{spec}` here")),
        }
    }

    fn contest(motion: Motion, methods: &[&str]) -> Contest {
        Contest {
            name: "d1".into(),
            scene: crate::Dataset::D1.scene(60),
            dress: Dress::Own,
            methods: methods.iter().map(|&m| m.to_owned()).collect(),
            size: FrameSize::new(64, 36).unwrap(),
            magnify: 1.0,
            motion,
            edit: Moves {
                share: 0.1,
                is_apart: false,
            },
            style: Style::default(),
            budget: Budget::default(),
            warmup: 1,
            frames: 3,
        }
    }

    #[test]
    fn methods_that_run_are_measured_and_the_others_say_why_not() {
        for motion in [Motion::Still, Motion::Pan, Motion::Zoom, Motion::Edit] {
            let contest = contest(motion, &["cpu", "nothing", "oracle"]);
            let comparison = compare(&contest, &start, &Cancel::default()).unwrap();
            let [cpu, nothing, oracle] = &comparison.methods[..] else {
                panic!("{comparison:?}");
            };
            assert_eq!(
                nothing.row.outcome,
                Outcome::WhyNot("no `nothing` here".into())
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
    fn what_is_magnified_is_seen_from_nearer() {
        let mut contest = contest(Motion::Still, &["cpu"]);
        let all = compare(&contest, &start, &Cancel::default()).unwrap();
        contest.magnify = 20.0;
        let near = compare(&contest, &start, &Cancel::default()).unwrap();
        assert!((near.view.px_per_m / all.view.px_per_m - 20.0).abs() < 1e-9);
        let drawn = |of: &Comparison| of.methods[0].row.measured().map(|m| m.paths.drawn);
        assert!(drawn(&near) > Some(0) && drawn(&near) < drawn(&all));
    }

    #[test]
    fn a_method_without_memory_enough_says_so_and_the_others_go_on() {
        let mut contest = contest(Motion::Still, &["cpu", "oracle"]);
        contest.budget.memory_bytes = 1000;
        let comparison = compare(&contest, &start, &Cancel::default()).unwrap();
        for contestant in &comparison.methods {
            let Outcome::WhyNot(why) = &contestant.row.outcome else {
                panic!("1000 bytes do: {contestant:?}");
            };
            assert!(why.contains("--memory"), "{why}");
        }
    }

    #[test]
    fn cancelling_ends_it() {
        let cancel = Cancel::default();
        cancel.set();
        let result = compare(&contest(Motion::Still, &["cpu"]), &start, &cancel);
        assert_eq!(result, Err(RenderError::Cancelled));
    }
}
