//! Judges the claims on building the grid, by the phase times of the growth part.

use super::judgment::{Judgment, at_most_paths, in_all};
use crate::reproduce::names::{BIN, COUNT, GRID, GRID_SCAN, PREFIX_SUM, SAMPLE};
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
