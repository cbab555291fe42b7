//! A scene that a method changed in place looks as the same scene made ready anew.

use std::sync::Arc;

use guideway_cpu::Oracle;
use guideway_scene::density::ToneMap;
use guideway_scene::{Budget, EditOutcome, Frame, Method, Prepared, Report, Style, View};
use guideway_scene::{Edit, Scene};
use guideway_spline::{Affine, Point};
use guideway_tests::compare::{Tolerance, check};
use guideway_tests::devices::candidates;
use guideway_tests::edits::{Area, KINDS};
use guideway_tests::methods::{methods, show};
use guideway_tests::random::Lcg;
use guideway_tests::scenes::{long_curves, site};
use guideway_tests::sketch::{Drawing, Sketch};

/// A method under test.
struct Contender {
    name: String,
    method: Box<dyn Method>,
    /// How far from the oracle's picture of the changed scene it may be. A method lays out a changed scene
    /// otherwise than a new one, and then rounds otherwise, so its own picture of that is no measure.
    tolerance: Tolerance,
    /// How far from its first picture it may be when all is undone.
    undone: Tolerance,
}

fn contenders() -> Vec<Contender> {
    let oracle: (_, Box<dyn Method>, _) = ("oracle".to_owned(), Box::new(Oracle), Tolerance::NONE);
    let on_processor = methods().into_iter().map(|candidate| {
        let name = candidate.method.info().name.to_owned();
        (name, candidate.method, candidate.tolerance)
    });
    let on_device = candidates()
        .into_iter()
        .map(|candidate| (candidate.name, candidate.method, candidate.tolerance));
    let all = std::iter::once(oracle).chain(on_processor).chain(on_device);
    all.map(|(name, method, tolerance)| Contender {
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

fn sketch() -> Sketch {
    Sketch::new(72, 48)
}

#[test]
fn a_site_in_f32() {
    tell(&site(sketch().width(1.2), 400, 31).in_f32().build(), 1);
}

#[test]
fn a_translucent_site_far_from_the_origin() {
    let sketch = sketch().px_per_m(20.0).at(7e6, -3e6);
    let drawing = site(sketch, 100, 32).common_color(0x2060_a080).build();
    tell(&drawing, 2);
}

#[test]
fn the_density_of_long_curves() {
    let sketch = sketch().width(1.0).density(ToneMap::Log);
    tell(&long_curves(sketch, 30, 33).build(), 1);
}

#[test]
fn curves_that_are_small_beside_their_scene() {
    // `gpu` rounds their points, and draws exact ones in the view from near.
    let sketch = long_curves(sketch().width(1.2), 80, 35);
    let drawing = sketch.line((3e4, 0.0), (3e4 + 9.0, 5.0)).build();
    tell(&drawing, 1);
}

/// Every method that edits in place shows every step of a story, and after all is undone what it showed first.
fn tell(drawing: &Drawing, rounds: usize) {
    let story = Story::new(drawing, rounds);
    for contender in contenders() {
        if !edits_in_place(contender.method.as_ref()) {
            println!("SKIPPED: {} does not edit in place", contender.name);
            let must = ["oracle", "cpu", "gpu"].contains(&contender.name.as_str());
            assert!(!must, "{} edited in place before", contender.name);
            continue;
        }
        if let Err(error) = contender.play(&story) {
            panic!("{}: {error}", contender.name);
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

/// A scene and what becomes of it: rounds of edits of every kind, and then all of them undone.
struct Story {
    style: Style,
    views: Vec<View>,
    start: Scene,
    steps: Vec<Step>,
}

struct Step {
    /// What becomes of some paths.
    what: String,
    edit: Edit,
    /// With the edit.
    scene: Scene,
    /// One of the story's views of it.
    view: View,
    judged: Frame,
}

impl Story {
    fn new(drawing: &Drawing, rounds: usize) -> Self {
        let mut lcg = Lcg::new(34);
        let views = views(&drawing.view);
        let area = Area::of(&drawing.view);
        let start = drawing.scene();
        let mut story = Self {
            style: drawing.style,
            views,
            start: start.clone(),
            steps: Vec::new(),
        };
        let mut scene = start;
        let mut undo = Vec::new();
        for (what, kind) in (0..rounds).flat_map(|_| KINDS) {
            let edit = kind(&scene, &area, &mut lcg);
            let back = scene.clone().edit_with_undo(&edit, |_| {});
            let back = back.expect("an edit that can be done");
            undo.push((format!("no longer {what}"), back));
            story.take(what.to_owned(), edit, &mut scene, &mut lcg);
        }
        while let Some((what, edit)) = undo.pop() {
            story.take(what, edit, &mut scene, &mut lcg);
        }
        story
    }

    fn take(&mut self, what: String, edit: Edit, scene: &mut Scene, lcg: &mut Lcg) {
        scene.edit(&edit).expect("an edit that can be done");
        let view = self.views[lcg.below(self.views.len())];
        let mut judge = prepare(&Oracle, scene);
        let (judged, _) = draw(judge.as_mut(), &view, &self.style);
        self.steps.push(Step {
            what,
            edit,
            scene: scene.clone(),
            view,
            judged,
        });
    }
}

impl Contender {
    /// Takes every step in place, and ends where it began.
    fn play(&self, story: &Story) -> Result<(), String> {
        let mut prepared = prepare(self.method.as_ref(), &story.start);
        let pictures = |prepared: &mut dyn Prepared| -> Vec<Frame> {
            let picture = |view| draw(prepared, view, &story.style).0;
            story.views.iter().map(picture).collect()
        };
        let before = pictures(prepared.as_mut());
        for (number, step) in story.steps.iter().enumerate() {
            self.take(step, &story.style, prepared.as_mut())
                .map_err(|error| {
                    let paths: Vec<u32> = step.edit.paths().collect();
                    format!("step {number}, {}, {paths:?}: {error}", step.what)
                })?;
        }
        let after = pictures(prepared.as_mut());
        for (number, (before, after)) in before.iter().zip(&after).enumerate() {
            check(before, after, &self.undone)
                .map_err(|error| format!("view {number} with all undone: {error}"))?;
        }
        println!("{}: undone to the bit: {}", self.name, before == after);
        Ok(())
    }

    fn take(&self, step: &Step, style: &Style, prepared: &mut dyn Prepared) -> Result<(), String> {
        let edited = prepared.edit(&step.edit).map_err(|e| e.to_string())?;
        if edited == EditOutcome::NotInPlace {
            return Err("not in place, as edits before were".to_owned());
        }
        let (actual, report) = draw(prepared, &step.view, style);
        account(&report, &step.scene)?;
        check(&step.judged, &actual, &self.tolerance).map(drop)
    }
}

fn account(report: &Report, scene: &Scene) -> Result<(), String> {
    let is_whole = report.accounts_for_all()
        && report.total == scene.path_count() as u64
        && report.hidden == scene.hidden_count() as u64;
    match is_whole {
        true => Ok(()),
        false => Err(format!("not every path is accounted for: {report:?}")),
    }
}

fn prepare(method: &dyn Method, scene: &Scene) -> Box<dyn Prepared> {
    let prepared = method.prepare(Arc::new(scene.clone()), &Budget::default());
    prepared.expect("there is memory enough for a small scene")
}

fn draw(prepared: &mut dyn Prepared, view: &View, style: &Style) -> (Frame, Report) {
    show(prepared, view, style).expect("a small scene is no trouble")
}

/// All of a drawing, the same a few whole pixels beside, a part of it from near, and all from afar.
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
