//! Judges the claims on the most paths and on memory, by table 5.1 and the growth part.

use super::judgment::{Judgment, at_most_paths, in_all};
use crate::reproduce::names::{GRID, TESSELLATION};
use crate::reproduce::run::MostPaths;
use crate::reproduce::{Limit, Run};
use guideway_bench::Dataset;
use guideway_bench::format::{count, digits, megabytes, times};

pub(super) fn more_paths(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (grid, tessellation) = (
            found(run, dataset, GRID)?,
            found(run, dataset, TESSELLATION)?,
        );
        let both = (grid.paths.unwrap_or(0), tessellation.paths.unwrap_or(0));
        // Equal counts, as at the ceiling of the search, are no evidence.
        if both.0 == both.1 {
            return None;
        }
        let names = format!(
            "{}: {GRID} {}, {TESSELLATION} {}",
            dataset.name(),
            shown(run, grid),
            shown(run, tessellation)
        );
        let ratio = match both {
            (a, b) if a > 0 && b > 0 => format!(" ({} as many)", times(a as f64 / b as f64)),
            _ => String::new(),
        };
        Some((both.0 > both.1, format!("{names}{ratio}.")))
    }))
}

fn found<'a>(run: &'a Run, dataset: Dataset, method: &str) -> Option<&'a MostPaths> {
    let all = run.results.most_paths.iter();
    let mut own = all.filter(|m| m.dataset == dataset && m.row.method == method);
    // Only a finished search states the most paths.
    own.find(|m| m.limit != Limit::Time && (m.paths.is_some() || m.limit == Limit::TooSlow))
}

fn shown(run: &Run, found: &MostPaths) -> String {
    let Some(paths) = found.paths else {
        let least = run.plan.search.least;
        return format!("fewer than {}", count(least as u64));
    };
    let paths = count(paths as u64);
    match found.limit {
        Limit::Ceiling => format!("at least {paths}, the ceiling of the search"),
        Limit::Refused => format!("{paths}, and it refused more"),
        _ => paths,
    }
}

pub(super) fn more_memory(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [grid, tessellation]) = at_most_paths(run, dataset, [GRID, TESSELLATION])?;
        let ratio = grid.peak_bytes as f64 / tessellation.peak_bytes.max(1) as f64;
        let evidence = format!(
            "{} with {} paths: {GRID} {} MB at the peak, {TESSELLATION} {} MB ({} as much).",
            dataset.name(),
            count(paths as u64),
            digits(megabytes(grid.peak_bytes)),
            digits(megabytes(tessellation.peak_bytes)),
            times(ratio),
        );
        Some((ratio > 1.0, evidence))
    }))
}
