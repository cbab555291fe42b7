//! Tests a whole run and its report with fake methods of known cost.

#![expect(clippy::unwrap_used, reason = "helpers of tests may panic as tests do")]

mod fake;
mod page;
mod resume;

use std::cell::RefCell;

use fake::{FAKE, Fake};
use guideway_bench::{Dataset, StartError};
use guideway_reproduce::reproduce::{Limit, Plan, Run, Verdict, findings, reproduce};
use guideway_scene::{Cancel, Method};

/// A small plan, fast with fake methods.
fn plan(methods: &[&str]) -> Plan {
    Plan {
        methods: methods.iter().map(|&m| m.to_owned()).collect(),
        size_px: [64, 36],
        view_paths: [300, 200],
        sizes: vec![50, 100],
        repeats: 2,
        frames: 2,
        ..Plan::quick()
    }
}

fn run_with(plan: &Plan, cancel: &Cancel, fake: impl Fn(&str) -> Option<Fake>) -> Run {
    let start = |spec: &str| -> Result<Box<dyn Method>, StartError> {
        match fake(spec) {
            Some(fake) => Ok(Box::new(fake)),
            None => Err(StartError::new(format_args!(
                "{spec} needs a <device> & a driver"
            ))),
        }
    };
    reproduce(plan, &start, cancel, &|_| {}).unwrap()
}

#[test]
fn records_the_numbers_of_every_method() {
    let methods = ["grid", "grid+scan", "tessellation", "cpu"];
    let run = run_with(&plan(&methods), &Cancel::default(), |spec| match spec {
        "cpu" => None,
        "tessellation" => Some(Fake { b_ms: 0.05, ..FAKE }),
        "grid+scan" => Some(Fake {
            capacity: 1_000,
            ..FAKE
        }),
        _ => Some(FAKE),
    });
    assert!(!run.is_partial);
    assert_eq!(
        run.parts
            .iter()
            .filter(|p| p.is_cut || p.failure.is_some())
            .count(),
        0
    );

    // 60 frames per second: (1000 / 60 - 1) / 0.01 paths, or the capacity.
    for found in &run.results.most_paths {
        let (most, limit) = match found.row.method.as_str() {
            "grid" => (1_566, Limit::FrameTime),
            "grid+scan" => (1_000, Limit::Refused),
            "tessellation" => (313, Limit::FrameTime),
            _ => {
                assert_eq!((found.paths, found.limit), (None, Limit::Refused));
                continue;
            }
        };
        let paths = found.paths.unwrap();
        assert!(
            paths <= most && paths as f64 >= most as f64 * 0.98,
            "{found:?}"
        );
        assert_eq!(found.limit, limit);
        let measured = found.row.measured().unwrap();
        assert_eq!(measured.held_bytes, paths as u64 * 100);
    }

    // Every method has a row in each table, including the unavailable one.
    let results = &run.results;
    assert_eq!(results.occupancy.len(), 2 * 4 * 3);
    assert_eq!(results.zoom.len(), 2 * 4 * 4);
    assert_eq!(results.growth.len(), 2 * 4 * 2);
    assert_eq!(results.changes.len(), 2 * 4);
    assert_eq!(results.borders.len(), 4);
    let shares: Vec<f64> = results.occupancy[..3].iter().map(|r| r.at).collect();
    assert!(
        shares[0] == 0.0 && (shares[1] - 0.5).abs() < 0.02 && shares[2] == 1.0,
        "{shares:?}"
    );
    for reading in results
        .occupancy
        .iter()
        .chain(&results.zoom)
        .chain(&results.growth)
    {
        let expected_ms = match reading.row.method.as_str() {
            "cpu" => {
                assert!(reading.row.measured().is_none());
                continue;
            }
            "tessellation" => 1.0 + 0.05 * reading.paths as f64,
            _ => 1.0 + 0.01 * reading.paths as f64,
        };
        let measured = reading.row.measured().unwrap();
        // Without the read-back of the picture, which this method reports as slow.
        assert!(
            (measured.frame_ms.mean - expected_ms).abs() < 1e-9,
            "{reading:?}"
        );
        assert!((measured.prepare.ms - reading.paths as f64 * 4e-3).abs() < 1e-9);
    }

    let verdict = |title: &str| {
        let findings = findings(&run);
        findings.iter().find(|f| f.title == title).unwrap().verdict
    };
    assert_eq!(
        verdict("More paths per pixel than by tessellation"),
        Verdict::Holds
    );
    assert_eq!(verdict("Magnifying, per pixel"), Verdict::DoesNotHold);
    assert_eq!(verdict("Bottleneck of tessellation"), Verdict::NotMeasured);
}

#[test]
fn every_row_of_an_unavailable_method_has_the_reason() {
    let run = run_with(&plan(&["grid"]), &Cancel::default(), |_| None);
    let why = "grid needs a <device> & a driver";
    assert_eq!(run.methods[0].why_not.as_deref(), Some(why));
    assert_eq!(run.results.most_paths[0].reason.as_deref(), Some(why));
    assert!(run.results.pictures.is_empty());
    for reading in &run.results.growth {
        let outcome = format!("{:?}", reading.row.outcome);
        assert!(outcome.contains("needs a <device>"), "{outcome}");
    }
}

#[test]
fn a_stopped_run_keeps_its_measurements() {
    let cancel = Cancel::default();
    let parts = RefCell::new(Vec::new());
    let progress = |what: &str| {
        parts.borrow_mut().push(what.to_owned());
        if what.starts_with("growth") {
            cancel.set();
        }
    };
    let start = |_: &str| -> Result<Box<dyn Method>, StartError> { Ok(Box::new(FAKE)) };
    let run = reproduce(&plan(&["grid"]), &start, &cancel, &progress).unwrap();
    assert!(run.is_partial && parts.borrow().len() > 5);
    assert_eq!(run.results.zoom.len(), 2 * 4);
    assert_eq!(run.results.most_paths.len(), 2);
    assert!(run.results.growth.is_empty());
    assert!(run.parts.last().unwrap().failure.is_some());
}

#[test]
fn marks_parts_beyond_the_time_limit() {
    let plan = Plan {
        minutes: 1e-9,
        ..plan(&["grid"])
    };
    let run = run_with(&plan, &Cancel::default(), |_| Some(FAKE));
    assert!(!run.is_partial);
    for name in [
        "frame time against magnification",
        "most paths at 60 frames a second",
    ] {
        let part = run.parts.iter().find(|p| p.name == name).unwrap();
        assert!(part.is_cut, "{part:?}");
    }
    let found = &run.results.most_paths[0];
    assert_eq!((found.dataset, found.limit), (Dataset::D1, Limit::Time));
    let outcome = format!("{:?}", run.results.zoom[0].row.outcome);
    assert!(outcome.contains("time for this part was over"), "{outcome}");
}
