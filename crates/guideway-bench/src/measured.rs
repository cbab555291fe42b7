//! Results of a measurement, as the JSON reports store them (README.md).

use guideway_scene::{Clock, Preparation, RenderError, Report, Work};
use serde::{Deserialize, Serialize};

use crate::{StartError, Summary};

/// The result of one method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The method with its options, as requested.
    pub method: String,
    /// Measurement, or the reason for its absence.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// The measurement of one method, or the reason for its absence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The method was measured.
    Measured(Box<Measured>),
    /// The method was not measured, for this reason.
    #[serde(rename = "why_not")]
    NotMeasured(String),
}

impl Outcome {
    /// The measurement, if there is one.
    pub fn measured(&self) -> Option<&Measured> {
        match self {
            Self::Measured(measured) => Some(measured),
            Self::NotMeasured(_) => None,
        }
    }
}

impl Row {
    /// The measurement, if there is one.
    pub fn measured(&self) -> Option<&Measured> {
        self.outcome.measured()
    }
}

impl From<Result<Measured, MeasureError>> for Outcome {
    fn from(result: Result<Measured, MeasureError>) -> Self {
        match result {
            Ok(measured) => Self::Measured(Box::new(measured)),
            Err(fault) => Self::NotMeasured(fault.to_string()),
        }
    }
}

/// Times, memory and work of one method. Times are in milliseconds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// First preparation of the scene.
    pub prepare: Prepare,
    /// The first frame, which may load or compile resources.
    pub first_frame: FrameTime,
    /// Time until the picture is complete in the memory of the method, by the clock of the device
    /// if it has one. With [`crate::Motion::Edit`], it includes the update.
    pub frame_ms: Summary,
    /// Wall time of the same work, including transfers to and from the device.
    pub wall_ms: Summary,
    /// Wall time of the same work where the picture stays on the device, as a window shows it;
    /// `None` if the method draws only into main memory.
    #[serde(default)]
    pub device_wall_ms: Option<Summary>,
    /// Update of the prepared scene, with [`crate::Motion::Edit`].
    pub update_ms: Option<Summary>,
    /// Bytes that the last edit uploaded to the device; `None` without an edit, or if the method
    /// prepared the whole scene again.
    pub update_bytes: Option<u64>,
    /// True if gestures showed the changes and the scene stayed; `None` without changes.
    #[serde(default)]
    pub update_is_gesture: Option<bool>,
    /// Stages of the frames.
    pub stages: Vec<StageTime>,
    /// Drawn, culled and refused paths of the last frame.
    pub paths: PathCounts,
    /// Lines that the curves of the last frame were flattened to.
    pub lines: u64,
    /// Bands of the last frame.
    pub bands: u32,
    /// Bytes allocated between frames, without the scene.
    pub held_bytes: u64,
    /// Peak bytes of the preparation and of a frame.
    pub peak_bytes: u64,
    /// Counted work of the first view.
    pub work: WorkCounts,
    /// Deviations from the request that the method reports.
    pub notes: Vec<String>,
}

/// Preparation of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Prepare {
    /// Sum of its stages, in milliseconds.
    pub ms: f64,
    /// Wall time, including allocation and transfer to the device.
    pub wall_ms: f64,
    /// Its stages.
    pub stages: Vec<StageTime>,
    /// Its counted work.
    pub work: WorkCounts,
}

/// Times of one frame, each as in [`Measured`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameTime {
    /// Time until the picture is complete in the memory of the method.
    pub ms: f64,
    /// Wall time.
    pub wall_ms: f64,
    /// Update of the prepared scene, with [`crate::Motion::Edit`].
    pub update_ms: Option<f64>,
}

/// Time of one stage; the median of several samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageTime {
    /// Name of the stage.
    pub name: String,
    /// Clock: `host` or `device`.
    pub clock: String,
    /// Time in milliseconds.
    pub ms: f64,
}

/// Path counts of a frame: total = drawn + outside + hidden + refused.
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

/// Work in device-independent counts; `None` if the method does not count it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WorkCounts {
    /// Point-line distance tests.
    pub tests: Option<u64>,
    /// Tests per pixel of the picture; `None` for a preparation.
    pub tests_a_pixel: Option<f64>,
    /// Atomic operations on memory shared by all threads.
    pub atomics: Option<u64>,
    /// Bytes that threads read, before any cache.
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
    /// The work of a frame with this number of pixels.
    pub fn of_frame(work: Work, pixels: usize) -> Self {
        Self {
            tests_a_pixel: work.tests.map(|tests| tests as f64 / pixels as f64),
            ..Self::from(work)
        }
    }
}

impl Prepare {
    /// Converts the report of a method, and adds the wall time of the preparation.
    pub fn new(preparation: &Preparation, wall_ms: f64) -> Self {
        let stages = preparation.stages.iter();
        Self {
            // `f64::sum` of an empty list is -0.0.
            ms: preparation.elapsed_ms() + 0.0,
            wall_ms,
            stages: stages
                .map(|stage| StageTime::new(stage.name, stage.clock, stage.elapsed_ms))
                .collect(),
            work: WorkCounts::from(preparation.work),
        }
    }

    /// The mean of repeated preparations of one scene; `None` for an empty list.
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

/// The reason why a method was not measured.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// The method cannot start.
    #[error(transparent)]
    Start(#[from] StartError),
    /// The method refused or failed; the text includes a known remedy.
    #[error("{}", with_remedy(.0))]
    Method(#[from] RenderError),
    /// The method drew, but its report is inconsistent.
    #[error("the report of the method {0}")]
    Report(&'static str),
}

fn with_remedy(error: &RenderError) -> String {
    match error {
        RenderError::Unsupported { remedy, .. } => format!("{error}. {remedy}"),
        RenderError::Budget { .. } => format!("{error}. Raise the limit with --memory"),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_averages_each_stage() {
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
