//! Reports: what a method did with every path, the time of each stage, and its work counters.

use std::fmt;

use guideway_layout::clock::Instant;

use crate::color_by::Legend;
use crate::scene::Scene;

/// Report of one frame: the fate of every path and the time of every stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Name of the method.
    pub method: &'static str,
    /// Paths of the input.
    pub total: u64,
    /// Paths not proven to be outside the view.
    pub drawn: u64,
    /// Paths proven to be outside the view.
    pub culled: u64,
    /// Paths that the scene hides, such as those of other levels.
    pub hidden: u64,
    /// Paths that no method can draw; the layout lists each with its reason.
    pub refused: u64,
    /// Stages in order, with their time.
    pub stages: Vec<Stage>,
    /// Line segments that the curves were flattened to.
    pub lines: u64,
    /// Peak memory of the method beside the scene and the frame, in bytes.
    pub peak_bytes: u64,
    /// Bands that the picture was drawn in; more than one if the budget cannot hold all at once.
    pub bands: u32,
    /// Deviations from the requested style, a sentence each: for example, a fixed line width.
    pub notes: Vec<String>,
    /// Meaning of the colors of density shading.
    pub density: Option<Legend>,
}

/// A stage of a frame or of a preparation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Name of the stage.
    pub name: &'static str,
    /// Elapsed time, in milliseconds.
    pub elapsed_ms: f64,
    /// The clock that measured it.
    pub clock: Clock,
}

impl Stage {
    /// Name of the stage that copies a finished picture from a device to memory. A window does not
    /// need it, so [`Report::frame_ms`] excludes it.
    pub const READ_BACK: &'static str = "read back";

    /// A stage measured by the CPU clock.
    pub fn host(name: &'static str, elapsed_ms: f64) -> Self {
        Self {
            name,
            elapsed_ms,
            clock: Clock::Host,
        }
    }

    /// A stage measured by device timestamps.
    pub fn device(name: &'static str, elapsed_ms: f64) -> Self {
        Self {
            name,
            elapsed_ms,
            clock: Clock::Device,
        }
    }

    /// Adds `more` to `stages`; stages of one name add up.
    pub fn merge(stages: &mut Vec<Self>, more: impl IntoIterator<Item = Self>) {
        for stage in more {
            match stages.iter_mut().find(|s| s.name == stage.name) {
                Some(same) => same.elapsed_ms += stage.elapsed_ms,
                None => stages.push(stage),
            }
        }
    }
}

/// Milliseconds since an instant.
pub fn elapsed_ms(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

/// The clock that measured a stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clock {
    /// The CPU clock.
    #[default]
    Host,
    /// Timestamps of the graphics device.
    Device,
}

/// Cost of preparing a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Preparation {
    /// Stages in order, with their time.
    pub stages: Vec<Stage>,
    /// Bytes allocated between frames, beside the scene.
    pub held_bytes: u64,
    /// Peak memory during the preparation, in bytes.
    pub peak_bytes: u64,
    /// Device-independent work counters.
    pub work: Work,
}

impl Preparation {
    /// Total time of all stages, in milliseconds.
    pub fn elapsed_ms(&self) -> f64 {
        self.stages.iter().map(|s| s.elapsed_ms).sum()
    }
}

/// Device-independent work counters of a frame or a preparation; `None` if a method does not count
/// a kind of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Point-to-line distance tests.
    pub tests: Option<u64>,
    /// Atomic operations on global memory.
    pub atomics: Option<u64>,
    /// Bytes that threads request, before any cache.
    pub bytes_read: Option<u64>,
    /// Bytes that threads write, before any cache.
    pub bytes_written: Option<u64>,
}

impl Report {
    /// A report with the path counts of `scene`, `drawn` of which were drawn. All other fields are
    /// empty.
    pub fn of(method: &'static str, scene: &Scene, drawn: u64) -> Self {
        let layout = scene.layout();
        Self {
            method,
            total: scene.path_count() as u64,
            drawn,
            culled: scene.shown_count() as u64 - drawn,
            hidden: scene.hidden_count() as u64,
            refused: layout.refused.len() as u64,
            ..Self::default()
        }
    }

    /// Adds the report of another strip of the same picture.
    pub fn join(&mut self, other: Self) {
        self.drawn += other.drawn;
        self.culled = self.culled.saturating_sub(other.drawn);
        Stage::merge(&mut self.stages, other.stages);
        self.lines += other.lines;
        self.peak_bytes = self.peak_bytes.max(other.peak_bytes);
        self.bands += other.bands;
    }

    /// Returns `true` if drawn + culled + hidden + refused = total.
    pub fn accounts_for_all(&self) -> bool {
        self.drawn + self.culled + self.hidden + self.refused == self.total
    }

    /// Total time of all stages, in milliseconds.
    pub fn elapsed_ms(&self) -> f64 {
        self.stages.iter().map(|s| s.elapsed_ms).sum()
    }

    /// Time until the picture is complete on its device: all stages but [`Stage::READ_BACK`].
    pub fn frame_ms(&self) -> f64 {
        let drawing = self.stages.iter().filter(|s| s.name != Stage::READ_BACK);
        drawing.map(|s| s.elapsed_ms).sum()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} paths drawn by {}",
            self.drawn, self.total, self.method
        )?;
        for (count, what) in [
            (self.culled, "outside the view"),
            (self.hidden, "hidden"),
            (self.refused, "refused"),
        ] {
            if count > 0 {
                write!(f, ", {count} {what}")?;
            }
        }
        write!(f, ", in {:.1} ms", self.elapsed_ms())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_time_excludes_read_back() {
        let report = Report {
            stages: vec![
                Stage::device("draw", 2.0),
                Stage::host(Stage::READ_BACK, 5.0),
            ],
            ..Report::default()
        };
        assert_eq!((report.frame_ms(), report.elapsed_ms()), (2.0, 7.0));
    }
}
