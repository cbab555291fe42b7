//! What a run writes down. The page and all tables are made from this alone.

use serde::{Deserialize, Serialize};

use super::{Limit, Plan, Trial, pending};
use guideway_bench::{Dataset, Machine, Measured, Outcome, Row};

/// Why there is no measurement where the time did not do; a run that goes on measures such rows.
pub(crate) const OUT_OF_TIME: &str = "the time for this part was over";

/// One run of `guideway reproduce`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// When and where it was measured: once, and once more each time that it went on.
    pub sittings: Vec<Sitting>,
    /// Whether its last sitting was stopped before its end.
    pub is_partial: bool,
    /// What was to be measured.
    pub plan: Plan,
    /// The methods, and why some do not run.
    pub methods: Vec<MethodFacts>,
    /// Parts of the run, in order.
    pub parts: Vec<PartFacts>,
    /// What was measured.
    pub results: Results,
}

/// What was measured at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sitting {
    /// Where it was measured.
    pub machine: Machine,
    /// When it began, RFC 3339 in UTC.
    pub started: String,
    /// How long it took.
    pub elapsed_s: f64,
}

/// One method of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MethodFacts {
    /// Name with options.
    pub method: String,
    /// The device that it runs on, with its driver.
    pub device: Option<String>,
    /// Why it does not run here.
    pub why_not: Option<String>,
}

/// One part of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartFacts {
    /// What was measured in it.
    pub name: String,
    /// How long it took, in all sittings together.
    pub elapsed_s: f64,
    /// Whether its time was over before its end.
    pub is_cut: bool,
    /// Why it ended early, if it failed.
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
    /// Figures 5.4 and 5.5: `at` is the number of paths. Everything is seen; `prepare` is the mean of the
    /// plan's repeats.
    pub growth: Vec<Reading>,
    /// Coverage against the oracle's, for lines that lie across the borders of cells.
    pub borders: Vec<Border>,
    /// Figures 5.1, 5.2, 5.3, 5.6 and 5.7.
    pub pictures: Vec<Picture>,
}

/// One method at one point of a table or a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// What was drawn.
    pub dataset: Dataset,
    /// How many paths of it.
    pub paths: usize,
    /// Where on the axis.
    pub at: f64,
    /// What was measured.
    #[serde(flatten)]
    pub row: Row,
}

/// The most paths that one method draws at 60 frames a second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MostPaths {
    /// What was drawn.
    pub dataset: Dataset,
    /// The most paths; none when even the fewest tried take too long.
    pub paths: Option<usize>,
    /// Why there are not more.
    pub limit: Limit,
    /// What the method said when it refused more.
    pub reason: Option<String>,
    /// All counts tried.
    pub trials: Vec<Trial>,
    /// What was measured with that many paths.
    #[serde(flatten)]
    pub row: Row,
}

/// How much of the oracle's coverage one method shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Border {
    /// The method with its options.
    pub method: String,
    /// Share of the oracle's coverage that is missing.
    pub lost: Option<f64>,
    /// Coverage that the oracle has not, as a share of the oracle's.
    pub added: Option<f64>,
    /// Why it was not measured.
    pub why_not: Option<String>,
}

/// A picture of the page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    /// The figure it belongs to, such as `5.3`.
    pub figure: String,
    /// What it shows.
    pub caption: String,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Times that a page enlarges each pixel.
    pub enlarged: u32,
    /// The file, in base 64.
    pub png_base64: String,
}

impl Run {
    /// How long all sittings took.
    pub fn elapsed_s(&self) -> f64 {
        self.sittings.iter().map(|sitting| sitting.elapsed_s).sum()
    }

    /// Whether nothing is left that [`super::resume`] would measure.
    pub fn is_whole(&self) -> bool {
        pending(self).is_empty()
    }

    /// Whether a part was measured to its end.
    pub(super) fn has(&self, part: &str) -> bool {
        let is_whole = |facts: &PartFacts| !facts.is_cut && facts.failure.is_none();
        let mut own = self.parts.iter().filter(|facts| facts.name == part);
        own.any(is_whole)
    }

    /// Writes down what became of a part.
    pub(super) fn note(&mut self, facts: PartFacts) {
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
    /// The readings of one method and dataset, by where they are on the axis.
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

    /// How many readings of one method and scene there are that a longer time would not change.
    pub(crate) fn settled(rows: &[Self], dataset: Dataset, paths: usize, method: &str) -> usize {
        let is_settled = |row: &&Self| {
            let left_out = matches!(&row.row.outcome, Outcome::WhyNot(why) if why == OUT_OF_TIME);
            row.is_of(dataset, paths, method) && !left_out
        };
        rows.iter().filter(is_settled).count()
    }

    /// Puts a reading where one was left out before, or at the end.
    pub(crate) fn put(self, rows: &mut Vec<Self>) {
        let has_my_place = |row: &&mut Self| {
            // Not by its bits, which a file may have rounded.
            let is_at = (row.at - self.at).abs() < 1e-9;
            is_at && row.is_of(self.dataset, self.paths, &self.row.method)
        };
        match rows.iter_mut().find(has_my_place) {
            Some(row) => *row = self,
            None => rows.push(self),
        }
    }
}
