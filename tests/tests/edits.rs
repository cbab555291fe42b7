//! Compares scenes edited in place with the oracle's picture of the edited scene, and tests undo.

use std::sync::Arc;

use guideway_cpu::Oracle;
use guideway_scene::density::ToneMap;
use guideway_scene::{
    Budget, Edit, EditOutcome, Frame, Gesture, Method, Prepared, RenderError, Report, Scene, Style,
    View,
};
use guideway_spline::{Affine, Point};
use guideway_tests::BoxError;
use guideway_tests::compare::{Tolerance, check};
use guideway_tests::devices::candidates;
use guideway_tests::edits::{Area, KINDS, gesture};
use guideway_tests::methods::{methods, render_view};
use guideway_tests::random::Lcg;
use guideway_tests::scenes::{long_curves, site};
use guideway_tests::sketch::{Drawing, Sketch};
use rayon::prelude::*;

/// A method under test.
struct TestedMethod {
    name: String,
    method: Box<dyn Method>,
    /// Limit of the difference from the oracle's picture of the edited scene. Not from the method's
    /// own picture of a newly prepared scene, because an edited scene has other clusters, and other
    /// rounding.
    tolerance: Tolerance,
    /// Limit of the difference from its first picture after the undo of all edits.
    undone: Tolerance,
}

fn tested_methods() -> Vec<TestedMethod> {
    let oracle: (_, Box<dyn Method>, _) = ("oracle".to_owned(), Box::new(Oracle), Tolerance::NONE);
    let on_processor = methods().into_iter().map(|candidate| {
        let name = candidate.method.info().name.to_owned();
        (name, candidate.method, candidate.tolerance)
    });
    // The thesis' methods refuse some of the edited scenes; `guideway-tree` tests its own edits.
    let on_device = candidates()
        .into_iter()
        .filter(|candidate| candidate.tolerance == Tolerance::STANDARD)
        .map(|candidate| (candidate.name, candidate.method, candidate.tolerance));
    let all = std::iter::once(oracle).chain(on_processor).chain(on_device);
    all.map(|(name, method, tolerance)| TestedMethod {
        undone: match name.as_str() {
            "oracle" => Tolerance::NONE,
            _ => Tolerance::ROUNDING,
        },
        name,
        method,
        tolerance,
    })
    .collect()
}

/// Random sequences of edits and gestures per method, unless a variable sets another number: a
/// software device takes half a second for each.
const SEQUENCES: u64 = 80;
const SEQUENCES_VARIABLE: &str = "GUIDEWAY_SEQUENCES";

fn sequences() -> u64 {
    let set = std::env::var(SEQUENCES_VARIABLE);
    set.map_or(SEQUENCES, |text| {
        text.parse().expect("a number of sequences")
    })
}

fn sketch() -> Sketch {
    Sketch::new(72, 48)
}

#[test]
fn edits_a_site_in_f32() {
    check_edits(&site(sketch().width(1.2), 400, 31).in_f32().build(), 1);
}

#[test]
fn edits_a_translucent_site_far_from_the_origin() {
    let sketch = sketch().px_per_m(20.0).at(7e6, -3e6);
    let drawing = site(sketch, 100, 32).common_color(0x2060_a080).build();
    check_edits(&drawing, 2);
}

#[test]
fn edits_the_density_of_long_curves() {
    let sketch = sketch().width(1.0).density(ToneMap::Log);
    check_edits(&long_curves(sketch, 30, 33).build(), 1);
}

#[test]
fn edits_curves_that_are_small_relative_to_the_scene() {
    // `gpu` rounds their points, and uses exact points in the magnified view.
    let sketch = long_curves(sketch().width(1.2), 80, 35);
    let drawing = sketch.line((3e4, 0.0), (3e4 + 9.0, 5.0)).build();
    check_edits(&drawing, 1);
}

#[test]
fn gestures_between_edits_leave_no_trace() {
    for tested in tested_methods() {
        if !shows_gestures(tested.method.as_ref()) {
            println!("SKIPPED: {} shows no gestures", tested.name);
            let must = ["oracle", "cpu", "gpu"].contains(&tested.name.as_str());
            assert!(!must, "{} must show gestures", tested.name);
            continue;
        }
        if tested.name == "oracle" {
            continue;
        }
        let failed = (0..sequences()).into_par_iter().find_map_any(|seed| {
            let error = tested.check_gestures(seed).err()?;
            Some(format!("{}, seed {seed}: {error}", tested.name))
        });
        assert_eq!(failed, None);
    }
}

fn shows_gestures(method: &dyn Method) -> bool {
    let drawing = Sketch::new(16, 16).line((2.0, 2.0), (14.0, 9.0)).build();
    let gesture = Gesture {
        paths: [0].into(),
        by: Affine::translation(Point::new(0.1, 0.0)),
    };
    let shown = prepare(method, &drawing.scene()).show_gesture(Some(&gesture));
    shown.expect("the path is there") != EditOutcome::NotInPlace
}

/// Checks every step of an edit sequence with every method that edits in place.
fn check_edits(drawing: &Drawing, rounds: usize) {
    let sequence = EditSequence::new(drawing, rounds);
    for tested in tested_methods() {
        if !edits_in_place(tested.method.as_ref()) {
            println!("SKIPPED: {} does not edit in place", tested.name);
            let must = ["oracle", "cpu", "gpu"].contains(&tested.name.as_str());
            assert!(!must, "{} must edit in place", tested.name);
            continue;
        }
        if let Err(error) = tested.check(&sequence) {
            panic!("{}: {error}", tested.name);
        }
    }
}

fn edits_in_place(method: &dyn Method) -> bool {
    let drawing = Sketch::new(16, 16).line((2.0, 2.0), (14.0, 9.0)).build();
    let mut prepared = prepare(method, &drawing.scene());
    let nothing = Edit::Transform {
        paths: [0].into(),
        by: Affine::IDENTITY,
    };
    let edited = prepared.edit(&nothing).expect("the path is there");
    edited != EditOutcome::NotInPlace
}

/// A scene with rounds of edits of every kind, followed by the undo of all edits.
struct EditSequence {
    style: Style,
    views: Vec<View>,
    start: Scene,
    steps: Vec<Step>,
}

struct Step {
    /// Effect on the paths.
    effect: String,
    edit: Edit,
    /// The scene after the edit.
    scene: Scene,
    view: View,
    /// The oracle's picture of the view.
    expected: Frame,
}

impl EditSequence {
    fn new(drawing: &Drawing, rounds: usize) -> Self {
        let mut lcg = Lcg::new(34);
        let views = views(&drawing.view);
        let area = Area::of(&drawing.view);
        let start = drawing.scene();
        let mut sequence = Self {
            style: drawing.style,
            views,
            start: start.clone(),
            steps: Vec::new(),
        };
        let mut scene = start;
        let mut undo = Vec::new();
        for (effect, kind) in (0..rounds).flat_map(|_| KINDS) {
            let edit = kind(&scene, &area, &mut lcg);
            let back = scene.clone().edit_with_undo(&edit, |_| {});
            let back = back.expect("an edit that can be done");
            undo.push((format!("undo of {effect}"), back));
            sequence.push(effect.to_owned(), edit, &mut scene, &mut lcg);
        }
        while let Some((effect, edit)) = undo.pop() {
            sequence.push(effect, edit, &mut scene, &mut lcg);
        }
        sequence
    }

    fn push(&mut self, effect: String, edit: Edit, scene: &mut Scene, lcg: &mut Lcg) {
        scene.edit(&edit).expect("an edit that can be done");
        let view = self.views[lcg.below(self.views.len())];
        let mut oracle = prepare(&Oracle, scene);
        let (expected, _) = draw(oracle.as_mut(), &view, &self.style);
        self.steps.push(Step {
            effect,
            edit,
            scene: scene.clone(),
            view,
            expected,
        });
    }
}

impl TestedMethod {
    /// Applies every step in place; after the last, the pictures must equal the first ones.
    fn check(&self, sequence: &EditSequence) -> Result<(), BoxError> {
        let mut prepared = prepare(self.method.as_ref(), &sequence.start);
        let pictures = |prepared: &mut dyn Prepared| -> Vec<Frame> {
            let picture = |view| draw(prepared, view, &sequence.style).0;
            sequence.views.iter().map(picture).collect()
        };
        let before = pictures(prepared.as_mut());
        for (number, step) in sequence.steps.iter().enumerate() {
            self.check_step(step, &sequence.style, prepared.as_mut())
                .map_err(|error| {
                    let paths: Vec<u32> = step.edit.paths().collect();
                    format!("step {number}, {}, {paths:?}: {error}", step.effect)
                })?;
        }
        let after = pictures(prepared.as_mut());
        for (number, (before, after)) in before.iter().zip(&after).enumerate() {
            check(before, after, &self.undone)
                .map_err(|error| format!("view {number} after the undo of all edits: {error}"))?;
        }
        println!("{}: undo restores all bits: {}", self.name, before == after);
        Ok(())
    }

    /// Applies random edits and undoes some, once with gestures in between and once without: the
    /// pictures are equal to the bit.
    fn check_gestures(&self, seed: u64) -> Result<(), BoxError> {
        let lcg = &mut Lcg::new(seed);
        let colors = [0, 0x2060_a0ff, 0x2060_a080][lcg.below(3)];
        let sketch = sketch().width(1.2);
        let sketch = site(sketch, 20 + lcg.below(60), seed);
        let drawing = match colors {
            0 => sketch.in_f32().build(),
            color => sketch.common_color(color).build(),
        };
        let (area, views) = (Area::of(&drawing.view), views(&drawing.view));
        let mut scene = drawing.scene();
        let [mut dragged, mut quiet] = [(), ()].map(|()| prepare(self.method.as_ref(), &scene));
        let mut undo = Vec::new();
        for step in 0..6 {
            // No view follows another one of its scale: scrolled pixels differ in rounding.
            let view = &views[[0, 2, 3][step % 3]];
            for _ in 0..lcg.below(3) {
                let gesture = gesture(&scene, &area, lcg);
                dragged.show_gesture(Some(&gesture))?;
                let Some((drawn, report)) = try_draw(dragged.as_mut(), view, &drawing.style)?
                else {
                    continue;
                };
                check_counts(&report, &scene)?;
                let mut oracle = prepare(&Oracle, &scene);
                oracle.show_gesture(Some(&gesture))?;
                let (expected, _) = draw(oracle.as_mut(), view, &drawing.style);
                check(&expected, &drawn, &self.tolerance).map_err(|error| {
                    format!(
                        "step {step}, {} paths by {:?}: {error}",
                        gesture.paths.len(),
                        gesture.by
                    )
                })?;
            }
            let (_, kind) = KINDS[lcg.below(KINDS.len())];
            let edit = match undo.pop().filter(|_| lcg.below(3) == 0) {
                Some(back) => back,
                None => kind(&scene, &area, lcg),
            };
            undo.push(scene.edit_with_undo(&edit, |_| {})?);
            for prepared in [&mut dragged, &mut quiet] {
                prepared.edit(&edit)?;
            }
            let drawn = try_draw(dragged.as_mut(), view, &drawing.style)?;
            let expected = try_draw(quiet.as_mut(), view, &drawing.style)?;
            if drawn.map(|(frame, _)| frame) != expected.map(|(frame, _)| frame) {
                return Err(format!("step {step}: a gesture has left a trace").into());
            }
        }
        Ok(())
    }

    fn check_step(
        &self,
        step: &Step,
        style: &Style,
        prepared: &mut dyn Prepared,
    ) -> Result<(), BoxError> {
        let edited = prepared.edit(&step.edit)?;
        if edited == EditOutcome::NotInPlace {
            return Err("not in place, unlike earlier edits".into());
        }
        let (actual, report) = draw(prepared, &step.view, style);
        check_counts(&report, &step.scene)?;
        check(&step.expected, &actual, &self.tolerance).map(drop)
    }
}

fn check_counts(report: &Report, scene: &Scene) -> Result<(), BoxError> {
    let is_whole = report.accounts_for_all()
        && report.total == scene.path_count() as u64
        && report.hidden == scene.hidden_count() as u64;
    match is_whole {
        true => Ok(()),
        false => Err(format!("the report does not count every path: {report:?}").into()),
    }
}

fn prepare(method: &dyn Method, scene: &Scene) -> Box<dyn Prepared> {
    let prepared = method.prepare(Arc::new(scene.clone()), &Budget::default());
    prepared.expect("there is memory enough for a small scene")
}

/// Draws a view; `None` if the method rejects it, as when paths were moved out of its precision.
fn try_draw(
    prepared: &mut dyn Prepared,
    view: &View,
    style: &Style,
) -> Result<Option<(Frame, Report)>, BoxError> {
    match render_view(prepared, view, style) {
        Err(RenderError::Unsupported { .. }) => Ok(None),
        drawn => Ok(Some(drawn?)),
    }
}

fn draw(prepared: &mut dyn Prepared, view: &View, style: &Style) -> (Frame, Report) {
    render_view(prepared, view, style).expect("a small scene can be drawn")
}

/// The view of a drawing, one shifted by whole pixels, one magnified, and one zoomed out.
fn views(all: &View) -> Vec<View> {
    let (center, scale) = (all.center_m(), all.px_per_m());
    let view = |shift_px: (f64, f64), zoom: f64| {
        let shift_m = Point::new(shift_px.0, shift_px.1) * (1.0 / scale);
        View::new(all.size(), center + shift_m, scale * zoom).expect("the view is usable")
    };
    vec![
        *all,
        view((5.0, -3.0), 1.0),
        view((-31.3, 12.1), 6.0),
        view((0.0, 0.0), 0.5),
    ]
}
