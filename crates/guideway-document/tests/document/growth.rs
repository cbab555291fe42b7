//! Growth: edits of n rows cost O(n), and so does their undo. An exponent, never seconds.

use std::time::{Duration, Instant};

use guideway_document::{Document, Elements, Neighbors, PropertyRef};
use guideway_layout::{Layout, NewPath, Value};
use guideway_scene::Table;
use guideway_spline::{Affine, Runs};

use crate::site::{document_of, p};

/// Sizes of the documents.
const SIZES: [usize; 3] = [10_000, 30_000, 90_000];

/// A chain of paths, each with a vehicle type.
fn chain(count: usize) -> Document {
    let mut layout = Layout::default();
    let at = |row: usize| p(row as f64, 0.0);
    layout.nodes.push("n0", at(0), None);
    for row in 0..count {
        let end = layout
            .nodes
            .push(&format!("n{}", row + 1), at(row + 1), None);
        let mut runs = Runs::default();
        runs.push_line(at(row), at(row + 1));
        layout.paths.push(&NewPath {
            id: &format!("p{row}"),
            runs: &runs,
            start_node: Some(end - 1),
            end_node: Some(end),
            vehicle_types: &["tug"],
            ..NewPath::default()
        });
    }
    document_of(layout)
}

/// The shortest of some times.
fn fastest(mut work: impl FnMut() -> Duration) -> Duration {
    (0..5).map(|_| work()).min().expect("several times")
}

/// As many edits of a size as touch the rows of the largest size once: other programs that run
/// beside take the same share of each size.
fn repeats(size: usize) -> u32 {
    (SIZES[2] / size) as u32
}

/// Slope of the line through (log size, log time) with the least squared distances.
fn exponent(times: [Duration; 3]) -> f64 {
    let x = SIZES.map(|n| (n as f64).ln());
    let y = times.map(|time| time.as_secs_f64().ln());
    let [mean_x, mean_y] = [x, y].map(|values| values.iter().sum::<f64>() / 3.0);
    let covariance: f64 = x
        .iter()
        .zip(y)
        .map(|(x, y)| (x - mean_x) * (y - mean_y))
        .sum();
    covariance / x.iter().map(|x| (x - mean_x).powi(2)).sum::<f64>()
}

#[test]
fn exponents_tell_linear_from_quadratic() {
    let times = |power: i32| SIZES.map(|n| Duration::from_secs_f64((n as f64).powi(power) * 1e-9));
    assert!((exponent(times(1)) - 1.0).abs() < 1e-6);
    assert!((exponent(times(2)) - 2.0).abs() < 1e-6);
}

#[test]
fn edits_of_all_rows_and_their_undo_grow_linearly() {
    let speed = |vehicle_type| PropertyRef {
        of: Table::Paths,
        name: "maxSpeed",
        vehicle_type,
    };
    let all = |document: &Document| document.existing(Table::Paths).collect();
    type Edit<'a> = Box<dyn Fn(&mut Document) + 'a>;
    let edits: [(&str, Edit<'_>); 4] = [
        (
            "set for all types",
            Box::new(|document| {
                let value = Some(Value::Float(1.0));
                document
                    .set_property(speed(None), &all(document), value)
                    .unwrap();
            }),
        ),
        (
            "set for one type",
            Box::new(|document| {
                let value = Some(Value::Float(1.0));
                document
                    .set_property(speed(Some("tug")), &all(document), value)
                    .unwrap();
            }),
        ),
        (
            "set vehicle types",
            Box::new(|document| {
                let types = ["tug", "fork"];
                document
                    .set_vehicle_types(Table::Paths, &all(document), &types)
                    .unwrap();
            }),
        ),
        (
            "move",
            Box::new(|document| {
                let paths = Elements::of_paths(all(document));
                let by = Affine::translation(p(1.0, 2.0));
                document
                    .transform("move", &paths, by, Neighbors::Follow)
                    .unwrap();
            }),
        ),
    ];
    for (name, edit) in edits {
        let mut undo = [Duration::ZERO; 3];
        let mut done = [Duration::ZERO; 3];
        for (size, (undo, done)) in SIZES.into_iter().zip(undo.iter_mut().zip(&mut done)) {
            let mut document = chain(size);
            *undo = Duration::MAX;
            *done = fastest(|| {
                let mut took = [Duration::ZERO; 2];
                for _ in 0..repeats(size) {
                    let started = Instant::now();
                    edit(&mut document);
                    took[0] += started.elapsed();
                    let started = Instant::now();
                    document.undo().unwrap();
                    took[1] += started.elapsed();
                }
                *undo = (*undo).min(took[1] / repeats(size));
                took[0] / repeats(size)
            });
        }
        let (done, undo) = (exponent(done), exponent(undo));
        assert!(
            done < 1.4 && undo < 1.4,
            "{name}: {done:.2}, undo {undo:.2}"
        );
    }
}
