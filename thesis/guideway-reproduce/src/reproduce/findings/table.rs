//! Table 5.1 and its memory.

use super::{Judgment, in_all};
use crate::reproduce::names::{GRID, TESSELLATION};
use crate::reproduce::run::{MostPaths, Reading};
use crate::reproduce::{Limit, Results, Run};
use guideway_bench::format::{count, digits, megabytes, times};
use guideway_bench::{Dataset, Measured};

pub(super) fn more_paths(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (grid, tessellation) = (
            found(run, dataset, GRID)?,
            found(run, dataset, TESSELLATION)?,
        );
        let both = (grid.paths.unwrap_or(0), tessellation.paths.unwrap_or(0));
        // Two that are not told apart by what was tried say nothing.
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
    // Only a search that came to its end says how many.
    own.find(|m| m.limit != Limit::Time && (m.paths.is_some() || m.limit == Limit::TooSlow))
}

fn shown(run: &Run, found: &MostPaths) -> String {
    let Some(paths) = found.paths else {
        let least = run.plan.search.least;
        return format!("fewer than {}", count(least as u64));
    };
    let paths = count(paths as u64);
    match found.limit {
        Limit::Ceiling => format!("at least {paths}, the most that were tried"),
        Limit::Refused => format!("{paths}, where it refused more"),
        _ => paths,
    }
}

pub(super) fn more_memory(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [grid, tessellation]) = at_most_paths(run, dataset, [GRID, TESSELLATION])?;
        let ratio = grid.peak_bytes as f64 / tessellation.peak_bytes.max(1) as f64;
        let evidence = format!(
            "{} with {} paths: {GRID} {} MB at its peak, {TESSELLATION} {} MB ({} as much).",
            dataset.name(),
            count(paths as u64),
            digits(megabytes(grid.peak_bytes)),
            digits(megabytes(tessellation.peak_bytes)),
            times(ratio),
        );
        Some((ratio > 1.0, evidence))
    }))
}

/// What several methods measured at the greatest number of paths that all of them drew.
pub(super) fn at_most_paths<'a, const N: usize>(
    run: &'a Run,
    dataset: Dataset,
    methods: [&str; N],
) -> Option<(usize, [&'a Measured; N])> {
    let curves = methods.map(|method| Results::curve(&run.results.growth, dataset, method));
    let at = |paths: usize| {
        let point = |curve: &Vec<(&'a Reading, &'a Measured)>| {
            curve
                .iter()
                .find(|(r, _)| r.paths == paths)
                .map(|&(_, m)| m)
        };
        let points: Vec<&'a Measured> = curves.iter().filter_map(point).collect();
        points.try_into().ok().map(|points| (paths, points))
    };
    curves[0]
        .iter()
        .rev()
        .find_map(|(reading, _)| at(reading.paths))
}
