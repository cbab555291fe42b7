//! What a run writes down. The page and all tables are made from this alone.

use serde::{Deserialize, Serialize};

use super::{Limit, Plan, Trial};
use crate::{Dataset, Machine, Measured, Outcome, Row};

/// One run of `guideway reproduce`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Where it was measured.
    pub machine: Machine,
    /// When it began, RFC 3339 in UTC.
    pub started: String,
    /// How long it took.
    pub elapsed_s: f64,
    /// Whether it was stopped before its end.
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
    /// How long it took.
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
}
