//! What was measured, as it is kept in files (docs/bench.md).

use guideway_scene::{Clock, Preparation, RenderError, Report, Work};
use serde::{Deserialize, Serialize};

use crate::Summary;

/// One method's part in a measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The method with its options, as it was asked for.
    pub method: String,
    /// What came of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// What came of measuring one method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// It was measured.
    Measured(Box<Measured>),
    /// It was not, and why.
    WhyNot(String),
}

impl Outcome {
    /// The measurement, if there is one.
    pub fn measured(&self) -> Option<&Measured> {
        match self {
            Self::Measured(measured) => Some(measured),
            Self::WhyNot(_) => None,
        }
    }
}

impl Row {
    /// The measurement, if there is one.
    pub fn measured(&self) -> Option<&Measured> {
        self.outcome.measured()
    }
}

impl From<Result<Measured, Fault>> for Outcome {
    fn from(result: Result<Measured, Fault>) -> Self {
        match result {
            Ok(measured) => Self::Measured(Box::new(measured)),
            Err(fault) => Self::WhyNot(fault.to_string()),
        }
    }
}

/// Times, memory and work of one method. Times are in milliseconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Making the scene ready, the first time.
    pub prepare: Prepare,
    /// The first frame, which may have to load or compile something.
    pub first_frame: FrameTime,
    /// Until the picture was complete where it was made, by the device's clock where it has one. With
    /// [`crate::Motion::Edit`], making the changed scene ready is part of it.
    pub frame_ms: Summary,
    /// The same work seen from outside, with the way to the device and back.
    pub wall_ms: Summary,
    /// Making the changed scene ready, with [`crate::Motion::Edit`].
    pub update_ms: Option<Summary>,
    /// Bytes brought to the device by the last edit; none without one, or where all was made ready anew.
    pub update_bytes: Option<u64>,
    /// Parts of the frames.
    pub stages: Vec<StageTime>,
    /// What became of the paths in the last frame.
    pub paths: PathCounts,
    /// Lines that the last frame's curves were turned into.
    pub lines: u64,
    /// Bands that the last frame was drawn in.
    pub bands: u32,
    /// Bytes that stay allocated from frame to frame, beside the scene.
    pub held_bytes: u64,
    /// Most bytes held at once, for making ready or for a frame.
    pub peak_bytes: u64,
    /// Counted work of the first view.
    pub work: WorkCounts,
    /// What the method drew otherwise than asked.
    pub notes: Vec<String>,
}

/// Making a scene ready.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Prepare {
    /// Time of its stages together.
    pub ms: f64,
    /// Time seen from outside, with allocating and sending to the device.
    pub wall_ms: f64,
    /// Parts of it.
    pub stages: Vec<StageTime>,
    /// Counted work of it.
    pub work: WorkCounts,
}

/// Times of one frame, each as in [`Measured`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameTime {
    /// Until the picture was complete where it was made.
    pub ms: f64,
    /// Seen from outside.
    pub wall_ms: f64,
    /// Making the changed scene ready, with [`crate::Motion::Edit`].
    pub update_ms: Option<f64>,
}

/// Time of one part; the median where there were several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageTime {
    /// What the method calls it.
    pub name: String,
    /// By whose clock: `host` or `device`.
    pub clock: String,
    /// How long it took.
    pub ms: f64,
}

/// What became of every path: total = drawn + outside + hidden + refused.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PathCounts {
    /// Paths of the input.
    pub total: u64,
    /// Not proven to be outside the view.
    pub drawn: u64,
    /// Proven to be outside the view.
    pub outside: u64,
    /// Hidden by the scene.
    pub hidden: u64,
    /// Cannot be drawn.
    pub refused: u64,
}

/// Work in numbers that any device would give; none where the method does not count it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WorkCounts {
    /// Tests of a point against a line.
    pub tests: Option<u64>,
    /// The same for each pixel of the picture; none for a preparation, which has no picture.
    pub tests_a_pixel: Option<f64>,
    /// Atomic operations on memory that all threads see.
    pub atomics: Option<u64>,
    /// Bytes that threads ask for, before any cache.
    pub bytes_read: Option<u64>,
    /// Bytes that threads write, before any cache.
    pub bytes_written: Option<u64>,
}

impl From<Work> for WorkCounts {
    fn from(work: Work) -> Self {
        Self {
            tests: work.tests,
            tests_a_pixel: None,
            atomics: work.atomics,
            bytes_read: work.bytes_read,
            bytes_written: work.bytes_written,
        }
    }
}

impl WorkCounts {
    /// The work of a frame of so many pixels.
    pub fn of_frame(work: Work, pixels: usize) -> Self {
        Self {
            tests_a_pixel: work.tests.map(|tests| tests as f64 / pixels as f64),
            ..Self::from(work)
        }
    }
}

impl Prepare {
    /// From what a method reports, and the wall time of preparation.
    pub fn new(preparation: &Preparation, wall_ms: f64) -> Self {
        let stages = preparation.stages.iter();
        Self {
            // The sum of no stages is negative zero.
            ms: preparation.elapsed_ms() + 0.0,
            wall_ms,
            stages: stages
                .map(|stage| StageTime::new(stage.name, stage.clock, stage.elapsed_ms))
                .collect(),
            work: WorkCounts::from(preparation.work),
        }
    }

    /// The mean of several times of making the same scene ready; none of none.
    pub fn mean(all: &[Self]) -> Option<Self> {
        let first = all.first()?;
        let mean = |of: &dyn Fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
        let stages = first.stages.iter().enumerate().map(|(i, stage)| StageTime {
            ms: mean(&|prepare| prepare.stages.get(i).map_or(0.0, |stage| stage.ms)),
            ..stage.clone()
        });
        Some(Self {
            ms: mean(&|prepare| prepare.ms),
            wall_ms: mean(&|prepare| prepare.wall_ms),
            stages: stages.collect(),
            work: first.work,
        })
    }
}

impl StageTime {
    /// The time of a named stage by one clock.
    pub fn new(name: &str, clock: Clock, ms: f64) -> Self {
        Self {
            name: name.to_owned(),
            clock: match clock {
                Clock::Host => "host".to_owned(),
                Clock::Device => "device".to_owned(),
            },
            ms,
        }
    }
}

impl From<&Report> for PathCounts {
    fn from(report: &Report) -> Self {
        Self {
            total: report.total,
            drawn: report.drawn,
            outside: report.culled,
            hidden: report.hidden,
            refused: report.refused,
        }
    }
}

/// Why a method was not measured.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// It refused or failed, with what to do about it where that is known.
    #[error("{}", with_remedy(.0))]
    Method(#[from] RenderError),
    /// It drew, but what it says of it cannot be right.
    #[error("its report {0}")]
    Report(&'static str),
}

fn with_remedy(error: &RenderError) -> String {
    match error {
        RenderError::Unsupported { remedy, .. } => format!("{error}. {remedy}"),
        RenderError::Budget { .. } => format!("{error}. Allow more with --memory"),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_taken_stage_by_stage() {
        let prepare = |ms: f64| Prepare {
            ms,
            wall_ms: 2.0 * ms,
            stages: vec![StageTime::new("sample", Clock::Device, ms)],
            work: WorkCounts::default(),
        };
        let mean = Prepare::mean(&[prepare(1.0), prepare(3.0)]);
        assert_eq!(mean, Some(prepare(2.0)));
        assert_eq!(Prepare::mean(&[]), None);
    }
}
