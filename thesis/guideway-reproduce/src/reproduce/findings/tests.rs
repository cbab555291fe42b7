//! Tests of the findings: each claim with results that confirm it and results that refute it.

use guideway_scene::Clock;

use super::*;
use crate::reproduce::{Border, Limit, MostPaths, Plan, Reading, Results, Run};
use guideway_bench::{Dataset, Measured, Outcome, Prepare, Row, StageTime, Summary, WorkCounts};

fn run(results: Results) -> Run {
    Run {
        sessions: Vec::new(),
        is_partial: false,
        plan: Plan::quick(),
        methods: Vec::new(),
        parts: Vec::new(),
        results,
    }
}

fn frame(ms: f64) -> Measured {
    Measured {
        frame_ms: Summary::of(&[ms]).unwrap(),
        ..Measured::default()
    }
}

/// A measurement with the given times of sampling, counting, prefix sum and binning.
fn build(phases_ms: [f64; 4]) -> Measured {
    let names = ["sample", "count", "prefix sum", "bin"];
    let stage = |(name, ms)| StageTime::new(name, Clock::Device, ms);
    Measured {
        prepare: Prepare {
            ms: phases_ms.iter().sum(),
            stages: names.into_iter().zip(phases_ms).map(stage).collect(),
            ..Prepare::default()
        },
        ..frame(1.0)
    }
}

fn reading(dataset: Dataset, method: &str, at: f64, measured: Measured) -> Reading {
    let outcome = Outcome::Measured(Box::new(measured));
    Reading::new(dataset, at as usize, at, method, outcome)
}

fn growth(readings: Vec<Reading>) -> Results {
    Results {
        growth: readings,
        ..Results::default()
    }
}

fn most(method: &str, paths: Option<usize>, limit: Limit) -> MostPaths {
    MostPaths {
        dataset: Dataset::D1,
        paths,
        limit,
        reason: None,
        trials: Vec::new(),
        row: Row {
            method: method.into(),
            outcome: Outcome::NotMeasured(String::new()),
        },
    }
}

/// Judges one claim by results that confirm it, and by results that refute it.
fn judge(title: &str, holds: Results, fails: Results, words: &[&str]) {
    for (results, verdict) in [(holds, Verdict::Holds), (fails, Verdict::DoesNotHold)] {
        let findings = findings(&run(results));
        let finding = findings.iter().find(|f| f.title == title).expect("a claim");
        assert_eq!(finding.verdict, verdict, "{finding:?}");
        for word in words {
            assert!(finding.evidence.contains(word), "{word} in {finding:?}");
        }
    }
}

#[test]
fn an_empty_run_has_no_verdicts() {
    for finding in findings(&run(Results::default())) {
        assert_eq!(finding.verdict, Verdict::NotMeasured, "{finding:?}");
    }
}

#[test]
fn more_paths() {
    let table = |grid, tessellation| Results {
        most_paths: vec![grid, tessellation],
        ..Results::default()
    };
    let found = |method, paths| most(method, Some(paths), Limit::FrameTime);
    judge(
        "More paths per pixel than by tessellation",
        table(found("grid", 1_000_000), found("tessellation", 250_000)),
        table(
            found("grid", 1_000_000),
            most("tessellation", Some(4_000_000), Limit::Ceiling),
        ),
        &["1,000,000", "times as many"],
    );
    // Even the fewest paths are too many for one of them.
    judge(
        "More paths per pixel than by tessellation",
        table(
            found("grid", 500),
            most("tessellation", None, Limit::TooSlow),
        ),
        table(
            most("grid", None, Limit::TooSlow),
            found("tessellation", 500),
        ),
        &["fewer than 100", "500"],
    );
    // Two at the ceiling, or one whose search did not end, do not compare.
    for (a, b) in [
        (
            most("grid", Some(9), Limit::Ceiling),
            most("tessellation", Some(9), Limit::Ceiling),
        ),
        (most("grid", Some(9), Limit::Time), found("tessellation", 5)),
        (most("grid", None, Limit::Refused), found("tessellation", 5)),
    ] {
        assert_eq!(findings(&run(table(a, b)))[0].verdict, Verdict::NotMeasured);
    }
}

#[test]
fn memory() {
    let table = |grid, tessellation| {
        let peak = |peak_bytes| Measured {
            peak_bytes,
            ..frame(1.0)
        };
        growth(vec![
            reading(Dataset::D1, "grid", 90.0, peak(grid)),
            reading(Dataset::D1, "tessellation", 90.0, peak(tessellation)),
        ])
    };
    let words = ["90 paths", "800 MB", "200 MB"];
    judge(
        "Memory",
        table(800_000_000, 200_000_000),
        table(200_000_000, 800_000_000),
        &words,
    );
}

#[test]
fn occupancy() {
    let table = |ms: [f64; 3]| Results {
        occupancy: [0.0, 0.5, 1.0]
            .into_iter()
            .zip(ms)
            .map(|(at, ms)| reading(Dataset::D2, "grid", at, frame(ms)))
            .collect(),
        ..Results::default()
    };
    let words = ["1.42 ms", "50 %", "D2"];
    judge(
        "Fewer pixels inside the grid",
        table([1.42, 4.9, 7.5]),
        table([1.42, 1.42, 1.42]),
        &words,
    );
}

#[test]
fn zoom() {
    let table = |method: &str, near_ms, tests_a_pixel| {
        let measured = |ms| Measured {
            work: WorkCounts {
                tests_a_pixel,
                ..WorkCounts::default()
            },
            ..frame(ms)
        };
        Results {
            zoom: vec![
                reading(Dataset::D1, method, 0.1, measured(16.0)),
                reading(Dataset::D1, method, 2.0, measured(near_ms)),
            ],
            ..Results::default()
        }
    };
    let grid = |ms| table("grid", ms, Some(1234.0));
    judge(
        "Magnifying, per pixel",
        grid(2.0),
        grid(15.0),
        &["16.0 ms", "200 %", "1234"],
    );
    judge("Magnifying, per pixel", grid(2.0), grid(40.0), &["16.0 ms"]);
    let tessellation = |ms| table("tessellation", ms, None);
    let words = ["paths are outside the view"];
    judge(
        "Magnifying, by tessellation",
        tessellation(1.0),
        tessellation(16.0),
        &words,
    );
}

#[test]
fn tessellation() {
    let table = |each_ms, one_ms, cull_ms, d2_ms| {
        let each = Measured {
            stages: vec![StageTime::new("cull", Clock::Device, cull_ms)],
            ..frame(each_ms)
        };
        growth(vec![
            reading(Dataset::D1, "tessellation", 90.0, each),
            reading(Dataset::D1, "tessellation-compact", 90.0, frame(one_ms)),
            reading(Dataset::D2, "tessellation", 90.0, frame(d2_ms)),
        ])
    };
    let holds = || table(10.0, 9.9, 0.5, 11.0);
    let fails = || table(10.0, 2.0, 5.0, 20.0);
    judge(
        "Bottleneck of tessellation",
        holds(),
        fails(),
        &["90 paths", "10.0 ms"],
    );
    judge("Culling is cheap", holds(), fails(), &["of 10.0 ms"]);
    judge(
        "Overlap and tessellation",
        holds(),
        fails(),
        &["10.0 ms on D1"],
    );
}

#[test]
fn building() {
    let table = |few, many, scan, d2| {
        growth(vec![
            reading(Dataset::D1, "grid", 100.0, build(few)),
            reading(Dataset::D1, "grid", 1000.0, build(many)),
            reading(Dataset::D1, "grid+scan", 1000.0, build(scan)),
            reading(Dataset::D2, "grid", 1000.0, build(d2)),
        ])
    };
    let holds = || {
        table(
            [1.0, 1.0, 0.5, 1.0],
            [10.0, 5.0, 0.5, 5.0],
            [10.0, 5.0, 0.1, 5.0],
            [10.0, 9.0, 0.5, 9.0],
        )
    };
    let fails = || {
        table(
            [1.0, 1.0, 9.0, 1.0],
            [1.5, 1.0, 9.0, 1.0],
            [1.5, 1.0, 9.5, 1.0],
            [1.5, 1.0, 9.0, 1.0],
        )
    };
    judge("Sampling", holds(), fails(), &["from 100 to 1,000 paths"]);
    judge(
        "Overlap and the grid's build",
        holds(),
        fails(),
        &["1,000 paths"],
    );
    judge("Prefix sum", holds(), fails(), &["the fastest is"]);
    judge("A parallel prefix sum", holds(), fails(), &["as written"]);
    judge("Layouts that change", holds(), fails(), &["of 16.7 ms"]);
}

#[test]
fn proposals() {
    let framed = |stages: &[(&str, f64)], base: Measured| Measured {
        stages: stages
            .iter()
            .map(|&(name, ms)| StageTime::new(name, Clock::Device, ms))
            .collect(),
        ..base
    };
    let quadtree = |build_ms, query_ms| {
        let grid = framed(&[("test pixels", 3.0)], build([1.0, 1.0, 1.0, 1.0]));
        let stages = [("keys", 0.5), ("sort", build_ms), ("test pixels", query_ms)];
        growth(vec![
            reading(Dataset::D1, "grid+scan+radius", 90.0, grid),
            reading(Dataset::D1, "quadtree", 90.0, framed(&stages, frame(1.0))),
        ])
    };
    let words = ["in 4.00 ms", "90 paths"];
    judge(
        "A linear quadtree",
        quadtree(1.0, 9.0),
        quadtree(9.0, 9.0),
        &words,
    );
    judge(
        "A linear quadtree",
        quadtree(1.0, 9.0),
        quadtree(1.0, 1.0),
        &words,
    );
    let tree = |update_ms, notes: &[&str]| {
        let updated = |ms| Measured {
            update_ms: Summary::of(&[ms]),
            notes: notes.iter().map(|&note| note.to_owned()).collect(),
            ..frame(ms + 1.0)
        };
        Results {
            changes: vec![
                reading(Dataset::D2, "grid+scan+radius", 90.0, updated(5.0)),
                reading(Dataset::D2, "tree", 90.0, updated(update_ms)),
            ],
            ..Results::default()
        }
    };
    let words = ["all move", "in 5.00 ms", "twice as deep"];
    judge("An AABB tree", tree(1.0, &[]), tree(6.0, &[]), &words);
    let note = "The tree is unbalanced: level 41.";
    judge(
        "An AABB tree",
        tree(1.0, &[note]),
        tree(6.0, &[note]),
        &["level 41"],
    );
}

#[test]
fn borders() {
    let table = |written, with_radius| {
        let border = |method: &str, lost| Border {
            method: method.into(),
            lost: Some(lost),
            added: Some(0.0),
            why_not: None,
        };
        Results {
            borders: vec![
                border("grid", written),
                border("grid+scan+radius", with_radius),
            ],
            ..Results::default()
        }
    };
    judge(
        "Lines at the borders of cells",
        table(0.05, 0.05),
        table(0.08, 0.05),
        &["5 %"],
    );
}

#[test]
fn a_claim_must_hold_in_every_dataset() {
    let both = |d2_ms| Results {
        zoom: [(Dataset::D1, 1.0), (Dataset::D2, d2_ms)]
            .into_iter()
            .flat_map(|(dataset, near_ms)| {
                [(0.1, 10.0), (2.0, near_ms)]
                    .map(|(at, ms)| reading(dataset, "grid", at, frame(ms)))
            })
            .collect(),
        ..Results::default()
    };
    judge(
        "Magnifying, per pixel",
        both(1.0),
        both(10.0),
        &["D1:", "D2:"],
    );
}
