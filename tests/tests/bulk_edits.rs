//! An edit of many paths, which all threads share, leaves the picture of two edits of half as many.

use std::sync::Arc;

use guideway_cpu::Cpu;
use guideway_layout::OwnStyle;
use guideway_scene::{Budget, Edit, EditOutcome, Method, PathState, Prepared, Scene};
use guideway_spline::{Affine, Point};
use guideway_tests::compare::{Tolerance, check};
use guideway_tests::devices::{available_or_skip, tiles};
use guideway_tests::methods::render_view;
use guideway_tests::scenes::site;
use guideway_tests::sketch::Sketch;

/// More than half of this is too few for all threads.
const PATHS: u32 = 9_000;

/// New curves, each moved its own way: by this distance, or for a few of them far away.
fn moved(scene: &Scene, rows: &[u32], by_m: f64) -> Edit {
    let all = rows.iter().map(|&row| row as usize);
    let mut curves = scene.layout().paths.geometry().select(all);
    for (curve, &row) in rows.iter().enumerate() {
        let far = if row % 97 == 0 { 9.0 } else { by_m };
        let turn = f64::from(row);
        let by = Point::new(turn.cos(), turn.sin()) * far;
        curves.transform([curve], Affine::translation(by));
    }
    Edit::Reshape {
        paths: rows.into(),
        curves: Arc::new(curves),
        written: Arc::default(),
    }
}

fn with_state(rows: &[u32], state: PathState) -> Edit {
    Edit::SetStates(rows.iter().map(|&row| (row, state)).collect())
}

fn restyled(rows: &[u32]) -> Edit {
    let style = |row: u32| OwnStyle {
        width_m: Some(0.5 + (row % 5) as f32 * 0.3),
        color_rgba: Some(row.wrapping_mul(0x9e37_79b9) | 0xff),
    };
    Edit::Restyle(rows.iter().map(|&row| (row, style(row))).collect())
}

/// A name, rows of paths, and an edit of them.
type Step<'a> = (&'a str, &'a [u32], &'a dyn Fn(&[u32]) -> Edit);

fn edited(prepared: &mut dyn Prepared, edit: &Edit) {
    let outcome = prepared.edit(edit).expect("a valid edit");
    assert_ne!(outcome, EditOutcome::NotInPlace);
}

#[test]
fn an_edit_of_many_paths_equals_edits_of_some() {
    let drawing = site(Sketch::new(96, 64).width(1.2), PATHS as usize, 7).build();
    let scene = Arc::new(drawing.scene());
    let mut methods: Vec<Box<dyn Method>> = vec![Box::new(Cpu)];
    if let Some(tiles) = available_or_skip(tiles()) {
        methods.push(Box::new(tiles));
    }
    // In no order, and not all of them.
    let rows: Vec<u32> = (0..PATHS)
        .map(|i| i * 7 % PATHS)
        .filter(|row| row % 9 > 0)
        .collect();
    let (some, half) = (&rows[rows.len() / 10..], &rows[..rows.len() / 2 + 7]);
    let steps: [Step<'_>; 5] = [
        ("moved", &rows, &|rows| moved(&scene, rows, 0.3)),
        ("hidden", some, &|rows| with_state(rows, PathState::Hidden)),
        ("moved while hidden", half, &|rows| moved(&scene, rows, 0.9)),
        ("shown", &rows, &|rows| with_state(rows, PathState::Shown)),
        ("restyled", &rows, &|rows| restyled(rows)),
    ];
    for method in methods {
        let prepare = || method.prepare(Arc::clone(&scene), &Budget::default());
        let [mut at_once, mut by_halves] = [(); 2].map(|()| prepare().expect("a small scene"));
        let mut before = None;
        for (name, rows, step) in &steps {
            edited(at_once.as_mut(), &step(rows));
            for half in rows.chunks(rows.len().div_ceil(2)) {
                edited(by_halves.as_mut(), &step(half));
            }
            let pictures = [at_once.as_mut(), by_halves.as_mut()]
                .map(|prepared| render_view(prepared, &drawing.view, &drawing.style))
                .map(|drawn| drawn.expect("a small picture").0);
            let method = method.info().name;
            // Paths that moved far are in clusters of other edits, with other rounding.
            if let Err(error) = check(&pictures[0], &pictures[1], &Tolerance::ROUNDING) {
                panic!("{method}: {name}: {error}");
            }
            assert!(
                before.as_ref() != Some(&pictures[0]),
                "{method}: {name} shows"
            );
            before = Some(pictures.into_iter().next().expect("two pictures"));
        }
    }
}
