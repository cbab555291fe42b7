//! The record of a run, as `run.json` stores it. The page and all tables derive from it alone.

use serde::{Deserialize, Serialize};

use super::names::PARTS;
use super::plan::Plan;
use super::search::{Limit, Trial};
use guideway_bench::{Dataset, Machine, Measured, Outcome, Row};

/// Reason of a row that the time limit left out; a continued run measures such rows.
pub(crate) const OUT_OF_TIME: &str = "the time for this part was over";

/// One run of `guideway reproduce`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Times and computers of the measurement: one entry per start or continuation.
    #[serde(rename = "sittings")]
    pub sessions: Vec<RunSession>,
    /// True if the user stopped the last session.
    pub is_partial: bool,
    /// Planned measurements.
    pub plan: Plan,
    /// The methods with their devices.
    pub methods: Vec<MethodFacts>,
    /// Parts of the run in order.
    pub parts: Vec<PartFacts>,
    /// Measurements.
    pub results: Results,
}

/// One session of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunSession {
    /// The measuring computer.
    pub machine: Machine,
    /// Start time, RFC 3339 in UTC.
    pub started: String,
    /// Duration in seconds.
    pub elapsed_s: f64,
}

/// One method of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MethodFacts {
    /// Name with options.
    pub method: String,
    /// Its device with the driver.
    pub device: Option<String>,
    /// Reason why it does not run.
    pub why_not: Option<String>,
}

/// One part of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartFacts {
    /// Name of the part.
    pub name: String,
    /// Duration in seconds, summed over all sessions.
    pub elapsed_s: f64,
    /// True if the time limit cut it.
    pub is_cut: bool,
    /// Error that ended it early.
    pub failure: Option<String>,
}

/// All measurements of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// Table 5.1.
    pub most_paths: Vec<MostPaths>,
    /// Tables 5.2 and 5.3: `at` is the share of pixels inside the box of all curves, from 0 to 1.
    pub occupancy: Vec<Reading>,
    /// Figure 5.3: `at` is the magnification, 0.1 where everything is seen.
    pub zoom: Vec<Reading>,
    /// Figures 5.4 and 5.5: `at` is the number of paths. Everything is seen; `prepare` is the mean
    /// of the plan's repeats.
    pub growth: Vec<Reading>,
    /// Every path moves before each frame; everything is seen.
    #[serde(default)]
    pub changes: Vec<Reading>,
    /// Coverage relative to the oracle, for lines across the borders of cells.
    pub borders: Vec<Border>,
    /// Figures 5.1, 5.2, 5.3, 5.6 and 5.7.
    pub pictures: Vec<Picture>,
}

/// One method at one point of a table or a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// The dataset.
    pub dataset: Dataset,
    /// Its number of paths.
    pub paths: usize,
    /// Position on the axis of the table or figure.
    pub at: f64,
    /// The measurement.
    #[serde(flatten)]
    pub row: Row,
}

/// The most paths that one method draws at 60 frames per second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MostPaths {
    /// The dataset.
    pub dataset: Dataset,
    /// The most paths; `None` when even the smallest trial takes too long.
    pub paths: Option<usize>,
    /// Reason why more paths are not possible.
    pub limit: Limit,
    /// Error of the method that refused more paths.
    pub reason: Option<String>,
    /// All trials in order.
    pub trials: Vec<Trial>,
    /// The measurement with the most paths.
    #[serde(flatten)]
    pub row: Row,
}

/// Coverage of one method relative to the oracle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Border {
    /// The method with its options.
    pub method: String,
    /// Missing share of the oracle's coverage.
    pub lost: Option<f64>,
    /// Surplus coverage, relative to the oracle's coverage.
    pub added: Option<f64>,
    /// Reason why it was not measured.
    pub why_not: Option<String>,
}

/// A picture of the page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    /// Number of its figure, such as `5.3`.
    pub figure: String,
    /// Content of the picture.
    pub caption: String,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Enlargement of each pixel on the page.
    pub enlarged: u32,
    /// The PNG file in base 64.
    pub png_base64: String,
}

impl Run {
    /// Duration of all sessions in seconds.
    pub fn elapsed_s(&self) -> f64 {
        self.sessions.iter().map(|session| session.elapsed_s).sum()
    }

    /// Returns `true` if every part is complete, so that [`super::resume`] has nothing to measure.
    pub fn is_whole(&self) -> bool {
        PARTS.iter().all(|part| self.has(part))
    }

    /// Returns `true` if a part is complete: neither cut nor failed.
    pub(super) fn has(&self, part: &str) -> bool {
        let is_whole = |facts: &PartFacts| !facts.is_cut && facts.failure.is_none();
        let mut own = self.parts.iter().filter(|facts| facts.name == part);
        own.any(is_whole)
    }

    /// Records the outcome of a part; durations of several sessions add up.
    pub(super) fn record(&mut self, facts: PartFacts) {
        match self.parts.iter_mut().find(|old| old.name == facts.name) {
            Some(old) => {
                let elapsed_s = old.elapsed_s + facts.elapsed_s;
                *old = PartFacts { elapsed_s, ..facts };
            }
            None => self.parts.push(facts),
        }
    }
}

impl Results {
    /// The measured readings of one method and dataset, sorted by position on the axis.
    pub(crate) fn curve<'a>(
        readings: &'a [Reading],
        dataset: Dataset,
        method: &str,
    ) -> Vec<(&'a Reading, &'a Measured)> {
        let own = readings
            .iter()
            .filter(|r| r.dataset == dataset && r.row.method == method);
        let mut curve: Vec<_> = own.filter_map(|r| Some((r, r.row.measured()?))).collect();
        curve.sort_by(|a, b| a.0.at.total_cmp(&b.0.at));
        curve
    }
}

impl Reading {
    pub(crate) fn new(
        dataset: Dataset,
        paths: usize,
        at: f64,
        method: &str,
        outcome: Outcome,
    ) -> Self {
        Self {
            dataset,
            paths,
            at,
            row: Row {
                method: method.to_owned(),
                outcome,
            },
        }
    }

    fn is_of(&self, dataset: Dataset, paths: usize, method: &str) -> bool {
        (self.dataset, self.paths, self.row.method.as_str()) == (dataset, paths, method)
    }

    /// Number of readings of one method and scene that the time limit did not leave out.
    pub(crate) fn settled(rows: &[Self], dataset: Dataset, paths: usize, method: &str) -> usize {
        let is_settled = |row: &&Self| {
            let left_out =
                matches!(&row.row.outcome, Outcome::NotMeasured(why) if why == OUT_OF_TIME);
            row.is_of(dataset, paths, method) && !left_out
        };
        rows.iter().filter(is_settled).count()
    }

    /// Replaces the reading at the same position, or appends.
    pub(crate) fn put(self, rows: &mut Vec<Self>) {
        let is_same = |row: &&mut Self| {
            // With a tolerance: the file may have rounded the number.
            let is_at = (row.at - self.at).abs() < 1e-9;
            is_at && row.is_of(self.dataset, self.paths, &self.row.method)
        };
        match rows.iter_mut().find(is_same) {
            Some(row) => *row = self,
            None => rows.push(self),
        }
    }
}
