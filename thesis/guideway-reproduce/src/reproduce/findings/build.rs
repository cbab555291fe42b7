//! Judges the claims on building the grid and what the thesis proposes instead, by the phase times
//! of the growth part and by layouts that change.

use super::judgment::{Judgment, at_most_paths, in_all};
use crate::reproduce::names::{
    BIN, COUNT, GRID, GRID_RADIUS, GRID_SCAN, KEYS, PREFIX_SUM, QUADTREE, QUADTREE_TILES, SAMPLE,
    SORT, TEST_PIXELS, TREE, TREE_TILES,
};
use crate::reproduce::{Results, Run};
use guideway_bench::format::{count, digits, percent, time, times};
use guideway_bench::{Dataset, Measured};

fn phase_ms(measured: &Measured, phase: &str) -> Option<f64> {
    let stage = measured.prepare.stages.iter().find(|s| s.name == phase)?;
    Some(stage.ms)
}

/// Sum of the four phases of the build, without the host work before them.
fn phases_ms(measured: &Measured) -> Option<f64> {
    let phases = [SAMPLE, COUNT, PREFIX_SUM, BIN];
    phases
        .into_iter()
        .map(|phase| phase_ms(measured, phase))
        .sum()
}

pub(super) fn sampling(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let curve = Results::curve(&run.results.growth, dataset, GRID);
        let (few, many) = (curve.first()?, curve.last()?);
        let (few_ms, many_ms) = (phase_ms(few.1, SAMPLE)?, phase_ms(many.1, SAMPLE)?);
        if few.0.paths >= many.0.paths || few_ms <= 0.0 || many_ms <= 0.0 {
            return None;
        }
        let more = many.0.at / few.0.at;
        // Exponent p of time ~ paths^p.
        let power = (many_ms / few_ms).ln() / more.ln();
        let evidence = format!(
            "{}: from {} to {} paths the time grows from {} to {}, as the number of paths to the \
             power of {}.",
            dataset.name(),
            count(few.0.paths as u64),
            count(many.0.paths as u64),
            time(few_ms),
            time(many_ms),
            digits(power),
        );
        Some(((0.75..=1.25).contains(&power), evidence))
    }))
}

pub(super) fn contention(run: &Run) -> Judgment {
    let both = |dataset| {
        let (paths, [measured]) = at_most_paths(run, dataset, [GRID])?;
        Some((paths, phase_ms(measured, COUNT)? + phase_ms(measured, BIN)?))
    };
    let ((paths, d1_ms), (same, d2_ms)) = (both(Dataset::D1)?, both(Dataset::D2)?);
    if paths != same || d1_ms <= 0.0 {
        return None;
    }
    let evidence = format!(
        "With {} paths both phases take {} on D1 and {} on D2, {} as long.",
        count(paths as u64),
        time(d1_ms),
        time(d2_ms),
        times(d2_ms / d1_ms),
    );
    Some((d2_ms >= d1_ms * 1.1, evidence))
}

pub(super) fn prefix_sum(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [measured]) = at_most_paths(run, dataset, [GRID])?;
        let mut phases = Vec::new();
        for phase in [SAMPLE, COUNT, PREFIX_SUM, BIN] {
            phases.push((phase, phase_ms(measured, phase)?));
        }
        let fastest = phases.iter().min_by(|a, b| a.1.total_cmp(&b.1))?.0;
        let all: Vec<String> = phases
            .iter()
            .map(|(phase, ms)| format!("{phase} {}", time(*ms)))
            .collect();
        let evidence = format!(
            "{} with {} paths: {}; the fastest is {fastest}.",
            dataset.name(),
            count(paths as u64),
            all.join(", "),
        );
        Some((fastest == PREFIX_SUM, evidence))
    }))
}

pub(super) fn scan(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [naive, scan]) = at_most_paths(run, dataset, [GRID, GRID_SCAN])?;
        let (naive_ms, scan_ms) = (phase_ms(naive, PREFIX_SUM)?, phase_ms(scan, PREFIX_SUM)?);
        let build_ms = phases_ms(naive)?;
        if scan_ms <= 0.0 || build_ms <= 0.0 {
            return None;
        }
        let evidence = format!(
            "{} with {} paths: {} as written, {} with a scan ({} as fast). As written, it takes {} \
             of the {} of all four phases.",
            dataset.name(),
            count(paths as u64),
            time(naive_ms),
            time(scan_ms),
            times(naive_ms / scan_ms),
            percent(naive_ms / build_ms),
            time(build_ms),
        );
        Some((naive_ms > scan_ms, evidence))
    }))
}

pub(super) fn dynamic(run: &Run) -> Judgment {
    let frame_ms = run.plan.search.target_ms;
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [measured]) = at_most_paths(run, dataset, [GRID])?;
        let (build_ms, draw_ms) = (phases_ms(measured)?, measured.frame_ms.mean);
        let holds = build_ms + draw_ms > frame_ms;
        let meaning = if !holds {
            "Both fit into one frame: each edit can rebuild the grid."
        } else if build_ms > frame_ms {
            "The build alone exceeds the time of a frame."
        } else {
            "Each fits into one frame, but not both together."
        };
        let evidence = format!(
            "{} with {} paths: {} for the four phases of the build and {} to draw, of {} per \
             frame. {meaning}",
            dataset.name(),
            count(paths as u64),
            time(build_ms),
            time(draw_ms),
            time(frame_ms),
        );
        Some((holds, evidence))
    }))
}

/// Sum of stages of a frame; `None` if the method lacks one.
fn stages_ms(measured: &Measured, names: &[&str]) -> Option<f64> {
    let stage = |name: &&str| measured.stages.iter().find(|s| s.name == *name);
    names.iter().map(|name| Some(stage(name)?.ms)).sum()
}

/// Distance tests per pixel by the grid and by another method, if both count.
fn tests(grid: &Measured, name: &str, other: &Measured) -> String {
    match (grid.work.tests_a_pixel, other.work.tests_a_pixel) {
        (Some(of_grid), Some(own)) => format!(
            " A pixel tests {} lines by {GRID_RADIUS} and {} by {name}.",
            digits(of_grid),
            digits(own)
        ),
        _ => String::new(),
    }
}

pub(super) fn quadtree(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [grid, quadtree]) = at_most_paths(run, dataset, [GRID_RADIUS, QUADTREE])?;
        let build_ms = [phases_ms(grid)?, stages_ms(quadtree, &[KEYS, SORT])?];
        let query_ms = [
            stages_ms(grid, &[TEST_PIXELS])?,
            stages_ms(quadtree, &[TEST_PIXELS])?,
        ];
        let tiles = at_most_paths(run, dataset, [QUADTREE_TILES]).filter(|tiles| tiles.0 == paths);
        let tiles = tiles.and_then(|(_, [tiles])| stages_ms(tiles, &[TEST_PIXELS]));
        let tiles = tiles.map(|ms| format!(", {} by {QUADTREE_TILES}", time(ms)));
        let evidence = format!(
            "{} with {} paths: built in {} by {GRID_RADIUS}, in {} by {QUADTREE}; queried in {} \
             and {}{}.{}",
            dataset.name(),
            count(paths as u64),
            time(build_ms[0]),
            time(build_ms[1]),
            time(query_ms[0]),
            time(query_ms[1]),
            tiles.unwrap_or_default(),
            tests(grid, QUADTREE, quadtree),
        );
        let holds = build_ms[1] < build_ms[0] && query_ms[1] > query_ms[0];
        Some((holds, evidence))
    }))
}

pub(super) fn tree(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let changed = |method| {
            let curve = Results::curve(&run.results.changes, dataset, method);
            curve
                .last()
                .map(|&(reading, measured)| (reading.paths, measured))
        };
        let ((paths, grid), (same, tree)) = (changed(GRID_RADIUS)?, changed(TREE)?);
        if paths != same {
            return None;
        }
        let update_ms =
            [&grid.update_ms, &tree.update_ms].map(|update| Some(update.as_ref()?.mean));
        let [Some(grid_ms), Some(tree_ms)] = update_ms else {
            return None;
        };
        let tiles = changed(TREE_TILES)
            .map(|(_, tiles)| format!(", {} by {TREE_TILES}", time(tiles.frame_ms.mean)));
        let note = tree.notes.iter().find(|note| note.contains("unbalanced"));
        let balance = note.map_or(
            "No leaf of the tree is more than twice as deep as in a balanced one.",
            String::as_str,
        );
        let evidence = format!(
            "{} with {} paths that all move: updated in {} by {GRID_RADIUS}, in {} by {TREE}; \
             whole frames take {} and {}{}.{} {balance}",
            dataset.name(),
            count(paths as u64),
            time(grid_ms),
            time(tree_ms),
            time(grid.frame_ms.mean),
            time(tree.frame_ms.mean),
            tiles.unwrap_or_default(),
            tests(grid, TREE, tree),
        );
        Some((tree_ms < grid_ms, evidence))
    }))
}
