use std::fmt;
use std::time::Instant;

use crate::Scene;

/// What became of every path, and where the time went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Name of the method.
    pub method: &'static str,
    /// Paths of the input.
    pub total: u64,
    /// Paths that may have left a mark: not proven to be outside the view.
    pub drawn: u64,
    /// Paths proven to be outside the view.
    pub culled: u64,
    /// Paths that the scene hides, such as those of other levels.
    pub hidden: u64,
    /// Paths that cannot be drawn; the layout names each with its reason.
    pub refused: u64,
    /// Stages in order, with their time.
    pub stages: Vec<Stage>,
    /// Lines that curves were turned into.
    pub lines: u64,
    /// Most bytes that the method held beside the scene and the frame.
    pub peak_bytes: u64,
    /// Bands that the picture was drawn in; more than one where the budget did not hold all at once.
    pub bands: u32,
    /// What is drawn otherwise than asked, a sentence each: a method of fixed line width says so here.
    pub notes: Vec<String>,
}

/// One stage of a frame or of a preparation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// What it does.
    pub name: &'static str,
    /// How long it took.
    pub elapsed_ms: f64,
    /// By whose clock.
    pub clock: Clock,
}

impl Stage {
    /// Name of the stage that fetches a finished picture from a device. A window has no need of it, so it
    /// is no part of [`Report::frame_ms`].
    pub const READ_BACK: &'static str = "read back";

    /// A stage by the processor's clock.
    pub fn host(name: &'static str, elapsed_ms: f64) -> Self {
        Self {
            name,
            elapsed_ms,
            clock: Clock::Host,
        }
    }

    /// A stage by the device's clock.
    pub fn device(name: &'static str, elapsed_ms: f64) -> Self {
        Self {
            name,
            elapsed_ms,
            clock: Clock::Device,
        }
    }

    /// Adds stages to those of the same name.
    pub fn merge(stages: &mut Vec<Self>, more: impl IntoIterator<Item = Self>) {
        for stage in more {
            match stages.iter_mut().find(|s| s.name == stage.name) {
                Some(same) => same.elapsed_ms += stage.elapsed_ms,
                None => stages.push(stage),
            }
        }
    }
}

/// Milliseconds since then, by the processor's clock.
pub fn elapsed_ms(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

/// Who measured a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clock {
    /// The processor that runs the program.
    #[default]
    Host,
    /// The graphics device, by timestamps around its work.
    Device,
}

/// What making a scene ready took, and what is kept of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Preparation {
    /// Stages in order, with their time.
    pub stages: Vec<Stage>,
    /// Bytes that stay allocated from frame to frame, beside the scene.
    pub held_bytes: u64,
    /// Most bytes held at once on the way there.
    pub peak_bytes: u64,
    /// What it took, in numbers that any device would give.
    pub work: Work,
}

impl Preparation {
    /// Time of all stages.
    pub fn elapsed_ms(&self) -> f64 {
        self.stages.iter().map(|s| s.elapsed_ms).sum()
    }
}

/// Work of a frame or of a preparation, in numbers that any device would give. None where a method does not
/// count it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Tests of a point against a line.
    pub tests: Option<u64>,
    /// Atomic operations on memory that all threads see.
    pub atomics: Option<u64>,
    /// Bytes that threads ask for, before any cache.
    pub bytes_read: Option<u64>,
    /// Bytes that threads write, before any cache.
    pub bytes_written: Option<u64>,
}

impl Report {
    /// A report that accounts for every path of a scene, of which so many were drawn; the rest of the fields
    /// is empty.
    pub fn of(method: &'static str, scene: &Scene, drawn: u64) -> Self {
        let layout = scene.layout();
        Self {
            method,
            total: scene.path_count() as u64,
            drawn,
            culled: scene.draw_order().len() as u64 - drawn,
            hidden: scene.hidden_count() as u64,
            refused: layout.refused.len() as u64,
            ..Self::default()
        }
    }

    /// Adds what another strip of the same picture says.
    pub fn join(&mut self, other: Self) {
        self.drawn += other.drawn;
        self.culled = self.culled.saturating_sub(other.drawn);
        Stage::merge(&mut self.stages, other.stages);
        self.lines += other.lines;
        self.peak_bytes = self.peak_bytes.max(other.peak_bytes);
        self.bands += other.bands;
    }

    /// Whether drawn + culled + hidden + refused = total: nothing was lost.
    pub fn accounts_for_all(&self) -> bool {
        self.drawn + self.culled + self.hidden + self.refused == self.total
    }

    /// Time of all stages.
    pub fn elapsed_ms(&self) -> f64 {
        self.stages.iter().map(|s| s.elapsed_ms).sum()
    }

    /// Time until the picture is complete where it was made: all stages but [`Stage::READ_BACK`].
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
    fn fetching_the_picture_is_no_part_of_a_frame() {
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
