//! Judges the claims on frame times and coverage, by the views, growth and border parts.

use super::judgment::{Judgment, at_most_paths, in_all};
use crate::reproduce::names::{CULL, GRID, GRID_RADIUS, TESSELLATION, TESSELLATION_COMPACT};
use crate::reproduce::{Reading, Results, Run};
use guideway_bench::format::{count, digits, percent, time, times};
use guideway_bench::{Dataset, Measured};

/// Smallest ratio of two times that counts as a change. Chosen: above the noise of repeated runs.
const NOTABLE: f64 = 1.1;

pub(super) fn occupancy(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let curve = Results::curve(&run.results.occupancy, dataset, GRID);
        let [none, half, all] = &curve[..] else {
            return None;
        };
        let ms = [none, half, all].map(|(_, m)| m.frame_ms.mean);
        let evidence = format!(
            "{}: {} with {} of the pixels inside, {} with {}, {} with {}.",
            dataset.name(),
            time(ms[0]),
            percent(none.0.at),
            time(ms[1]),
            percent(half.0.at),
            time(ms[2]),
            percent(all.0.at),
        );
        Some((ms[0] < ms[1] && ms[1] < ms[2], evidence))
    }))
}

pub(super) fn zoom_of_grid(run: &Run) -> Judgment {
    zoom(run, GRID)
}

pub(super) fn zoom_of_tessellation(run: &Run) -> Judgment {
    zoom(run, TESSELLATION)
}

fn zoom(run: &Run, method: &str) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let curve = Results::curve(&run.results.zoom, dataset, method);
        let (far, near) = (curve.first()?, curve.last()?);
        if far.0.at >= near.0.at {
            return None;
        }
        let ratio = far.1.frame_ms.mean / near.1.frame_ms.mean;
        let holds = ratio >= NOTABLE;
        let change = if holds {
            format!("{} as fast", times(ratio))
        } else if ratio > 1.0 / NOTABLE {
            "no faster".to_owned()
        } else {
            format!("{} as long", times(1.0 / ratio))
        };
        let evidence = format!(
            "{}: {} at {}, {} at {}: {change}.{}",
            dataset.name(),
            time(far.1.frame_ms.mean),
            percent(far.0.at),
            time(near.1.frame_ms.mean),
            percent(near.0.at),
            tests(far, near),
        );
        Some((holds, evidence))
    }))
}

/// The counted work of both views, or the culled paths for a method without counts.
fn tests(far: &(&Reading, &Measured), near: &(&Reading, &Measured)) -> String {
    match (far.1.work.tests_a_pixel, near.1.work.tests_a_pixel) {
        (Some(far_tests), Some(near_tests)) => format!(
            " Each pixel tests {} lines at {} and {} at {}: all lines of its cell.",
            digits(far_tests),
            percent(far.0.at),
            digits(near_tests),
            percent(near.0.at),
        ),
        _ => format!(
            " At the largest magnification, {} of {} paths are outside the view.",
            count(near.1.paths.outside),
            count(near.1.paths.total)
        ),
    }
}

pub(super) fn bottleneck(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [each, one]) =
            at_most_paths(run, dataset, [TESSELLATION, TESSELLATION_COMPACT])?;
        let (each_ms, one_ms) = (each.frame_ms.mean, one.frame_ms.mean);
        let holds = each_ms < one_ms * NOTABLE;
        let meaning = if holds {
            "One command for the same patches is no faster, so commands are not the bottleneck."
        } else {
            "The patches are the same, so the difference is the cost of one indirect command per \
             path."
        };
        let evidence = format!(
            "{} with {} paths: {} with one command per path, {} with one for all. {meaning}",
            dataset.name(),
            count(paths as u64),
            time(each_ms),
            time(one_ms),
        );
        Some((holds, evidence))
    }))
}

pub(super) fn culling(run: &Run) -> Judgment {
    in_all(Dataset::ALL.map(|dataset| {
        let (paths, [measured]) = at_most_paths(run, dataset, [TESSELLATION])?;
        let cull_ms = measured.stages.iter().find(|s| s.name == CULL)?.ms;
        let share = cull_ms / measured.frame_ms.median;
        let evidence = format!(
            "{} with {} paths: culling takes {} of {}, {}.",
            dataset.name(),
            count(paths as u64),
            time(cull_ms),
            time(measured.frame_ms.median),
            percent(share),
        );
        Some((share <= 0.1, evidence))
    }))
}

pub(super) fn overlap(run: &Run) -> Judgment {
    let (paths, [d1]) = at_most_paths(run, Dataset::D1, [TESSELLATION])?;
    let (same, [d2]) = at_most_paths(run, Dataset::D2, [TESSELLATION])?;
    if paths != same {
        return None;
    }
    let (d1_ms, d2_ms) = (d1.frame_ms.mean, d2.frame_ms.mean);
    let ratio = (d1_ms / d2_ms).max(d2_ms / d1_ms);
    let evidence = format!(
        "With {} paths: {} on D1, {} on D2; a ratio of {}.",
        count(paths as u64),
        time(d1_ms),
        time(d2_ms),
        digits(ratio),
    );
    Some((ratio <= 1.25, evidence))
}

pub(super) fn borders(run: &Run) -> Judgment {
    let lost = |method: &str| {
        let all = run.results.borders.iter();
        all.filter(|b| b.method == method).find_map(|b| b.lost)
    };
    let (written, with_radius) = (lost(GRID)?, lost(GRID_RADIUS)?);
    // A method with an almost empty picture is no evidence about borders.
    if with_radius > 0.5 {
        return None;
    }
    // Derived: rounding to 8 bits changes the coverage by up to a thousandth.
    let holds = written - with_radius < 1e-3;
    let meaning = if holds {
        "Entering lines by their radius has no effect."
    } else {
        "A stroke extends beyond the box of its line by the radius; a cell in between that does \
         not list the line lacks this part."
    };
    let evidence = format!(
        "{} of the coverage of the oracle is missing with lines entered by their box, {} with \
         lines entered by their radius. {meaning}",
        percent(written),
        percent(with_radius),
    );
    Some((holds, evidence))
}
