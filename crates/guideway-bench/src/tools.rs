//! Measures the tools of a network on one plan: builds a network of it, checks it, routes in it,
//! and compares it with an edited copy.

use std::time::Instant;

use guideway_layout::{CheckOptions, CompareOptions, Layout, UserError, changes, check};
use guideway_network::{
    AnalyzeOptions, BuildError, BuildOptions, RouteError, RouteOptions, Router, analyze, build,
};
use serde::Serialize;

use crate::peak_memory;
use crate::plan::{plan, set_values};

/// Pieces per line of the plan that the network may have: far more than there are.
const MOST_PIECES: usize = 10;

/// The time and memory of one tool.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToolRow {
    /// Name of the tool.
    pub tool: &'static str,
    /// Paths of its input.
    pub paths: u64,
    /// Elements of its result: paths, findings, nodes of the network, parts of the route, changes.
    pub results: u64,
    /// Wall time in milliseconds.
    pub ms: f64,
    /// Peak of the memory of the process meanwhile, its input included, in bytes; `None` where the
    /// system does not tell.
    pub peak_bytes: Option<u64>,
}

/// A tool that failed on the plan.
#[derive(Debug, thiserror::Error)]
pub enum ToolError {
    /// No network could be made.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// No route was found.
    #[error(transparent)]
    Route(#[from] RouteError),
}

impl From<ToolError> for UserError {
    fn from(error: ToolError) -> Self {
        match error {
            ToolError::Build(error) => error.into(),
            ToolError::Route(error) => error.into(),
        }
    }
}

/// Measures all tools on a plan of a number of lines, welded and cut where they meet. The network
/// has half as many paths again.
///
/// # Errors
/// When a tool fails.
pub fn measure_tools(lines: usize) -> Result<Vec<ToolRow>, ToolError> {
    let mut rows = Vec::new();
    let drawing = plan(lines);
    let options = BuildOptions {
        split_junctions: true,
        split_crossings: true,
        max_pieces: MOST_PIECES * lines.max(1),
        ..BuildOptions::default()
    };
    let mut network = measured("network", drawing.paths.len(), &mut rows, || {
        let made = build(&drawing, &options)?;
        let paths = made.layout.paths.len();
        Ok::<_, BuildError>((made.layout, paths))
    })?;
    drop(drawing);
    let paths = network.paths.len();
    measured("check", paths, &mut rows, || {
        let mut found = check(&network, &CheckOptions::default());
        found.append(analyze(&network, &AnalyzeOptions::default()));
        Ok::<_, ToolError>(((), found.iter().count()))
    })?;
    let router = measured("router", paths, &mut rows, || {
        let router = Router::new(&network, None, &RouteOptions::default())?;
        Ok::<_, RouteError>((router, network.nodes.len()))
    })?;
    measured("route", paths, &mut rows, || {
        let last = network.nodes.len() as u32 - 1;
        let ends = [0, last].map(|row| router.place(network.nodes.id(row)));
        let [from, to] = ends;
        let route = router.route(&from?, &to?)?;
        Ok::<_, RouteError>(((), route.rows.len()))
    })?;
    drop(router);
    let edited = edited(&mut network);
    measured("diff", paths, &mut rows, || {
        let found = changes(&network, &edited, &CompareOptions::default());
        Ok::<_, ToolError>(((), found.elements.len()))
    })?;
    Ok(rows)
}

/// Gives each path eight values, and returns a copy with eight others.
fn edited(network: &mut Layout) -> Layout {
    let paths = network.paths.len();
    let mut edited = network.clone();
    set_values(&mut network.paths.attributes, paths, 1.0);
    set_values(&mut edited.paths.attributes, paths, 1.5);
    edited
}

/// Runs a tool and appends its row. The tool returns its result and the number of its elements.
fn measured<T, E>(
    tool: &'static str,
    paths: usize,
    rows: &mut Vec<ToolRow>,
    run: impl FnOnce() -> Result<(T, usize), E>,
) -> Result<T, E> {
    let is_reset = peak_memory::reset();
    let start = Instant::now();
    let (result, results) = run()?;
    let ms = start.elapsed().as_secs_f64() * 1e3;
    rows.push(ToolRow {
        tool,
        paths: paths as u64,
        results: results as u64,
        ms,
        peak_bytes: peak_memory::bytes().filter(|_| is_reset),
    });
    Ok(result)
}
