//! Seeded random edits of every kind, equal on every machine.

use std::collections::BTreeSet;
use std::sync::Arc;

use guideway_layout::{Geometry, OwnStyle};
use guideway_scene::{Edit, Gesture, Insertion, PathState, Scene, View};
use guideway_spline::{Affine, Point, Runs};

use crate::random::Lcg;

/// The area for random curves.
pub struct Area {
    low: Point<f64>,
    size: Point<f64>,
}

impl Area {
    /// The area of a view.
    pub fn of(view: &View) -> Self {
        let seen = view.world_bounds();
        Self {
            low: seen.min,
            size: seen.size(),
        }
    }

    fn point(&self, lcg: &mut Lcg) -> Point<f64> {
        let (x, y) = (lcg.between(-0.1, 1.1), lcg.between(-0.1, 1.1));
        self.low + Point::new(x * self.size.x, y * self.size.y)
    }

    /// A random step of up to a share of the area.
    fn step(&self, share: f64, lcg: &mut Lcg) -> Point<f64> {
        let mut along = |side: f64| lcg.between(-share, share) * side;
        Point::new(along(self.size.x), along(self.size.y))
    }

    /// A curve of one to three unconnected runs.
    fn curve(&self, lcg: &mut Lcg) -> Runs {
        let mut runs = Runs::default();
        for _ in 0..1 + lcg.below(3) {
            let mut at = self.point(lcg);
            let points = 4 + lcg.below(12);
            let run: Vec<_> = (0..points)
                .map(|_| {
                    at = at + self.step(0.05, lcg);
                    at
                })
                .collect();
            runs.push(&run);
        }
        runs
    }
}

/// Creates a valid edit of a scene.
pub type Kind = fn(&Scene, &Area, &mut Lcg) -> Edit;

/// All kinds of edits, each with its effect on the paths.
pub const KINDS: [(&str, Kind); 9] = [
    ("turned and moved", |scene, area, lcg| {
        let turn = Affine::rotation(lcg.between(-0.3, 0.3), area.point(lcg));
        let shift = Affine::translation(area.step(0.2, lcg));
        Edit::Transform {
            paths: rows(scene, lcg),
            by: turn.then(shift),
        }
    }),
    // Some far outside the views, where they stay until the undo.
    ("moved far away", |scene, area, lcg| Edit::Transform {
        paths: rows(scene, lcg),
        by: Affine::translation(area.step(1.0, lcg) * 10_f64.powi(lcg.below(5) as i32)),
    }),
    // With an unchanged number of points.
    ("bent", |scene, area, lcg| {
        let paths = rows(scene, lcg);
        let geometry = scene.layout().paths.geometry();
        let mut curves = Geometry::default();
        for &path in paths.iter() {
            let mut runs = Runs::default();
            for run in geometry.runs(path as usize) {
                let bent: Vec<_> = run.iter().map(|p| p + area.step(0.02, lcg)).collect();
                runs.push(&bent);
            }
            curves.push(&runs);
        }
        Edit::Reshape {
            paths,
            curves: Arc::new(curves),
            written: Arc::default(),
        }
    }),
    ("given other curves", |scene, area, lcg| {
        let paths = rows(scene, lcg);
        let mut curves = Geometry::default();
        paths.iter().for_each(|_| curves.push(&area.curve(lcg)));
        Edit::Reshape {
            paths,
            curves: Arc::new(curves),
            written: Arc::default(),
        }
    }),
    ("restyled", |scene, area, lcg| {
        let styles = rows(scene, lcg)
            .iter()
            .map(|&path| (path, own_style(area, lcg)))
            .collect();
        Edit::Restyle(styles)
    }),
    ("hidden", |scene, _, lcg| {
        set_states(scene, PathState::Hidden, lcg)
    }),
    ("removed", |scene, _, lcg| {
        set_states(scene, PathState::Removed, lcg)
    }),
    ("brought back", |scene, _, lcg| {
        let gone =
            (0..scene.row_count() as u32).filter(|&row| scene.state(row) != PathState::Shown);
        let back = gone.filter(|_| lcg.unit() < 0.5);
        Edit::SetStates(back.map(|row| (row, PathState::Shown)).collect())
    }),
    ("inserted", |_, area, lcg| {
        let insertions = (0..1 + lcg.below(6)).map(|number| Insertion {
            id: format!("N{number}"),
            runs: area.curve(lcg),
            style: own_style(area, lcg),
            ..Insertion::default()
        });
        Edit::Insert(insertions.collect())
    }),
];

/// A gesture of a share of the rows, up to all: moves them, and turns, mirrors or scales most.
pub fn gesture(scene: &Scene, area: &Area, lcg: &mut Lcg) -> Gesture {
    let share = [0.05, 0.5, 1.0][lcg.below(3)];
    let rows = 0..scene.row_count() as u32;
    let about = area.point(lcg);
    let turn = match lcg.below(4) {
        0 => Affine::IDENTITY,
        1 => Affine::rotation(lcg.between(-3.0, 3.0), about),
        2 => Affine::mirror(about, Point::new(1.0, lcg.between(-2.0, 2.0))),
        _ => Affine::scale(lcg.between(0.3, 1.8), lcg.between(0.3, 1.8), about),
    };
    Gesture {
        paths: rows.filter(|_| lcg.unit() < share).collect(),
        by: turn.then(Affine::translation(area.step(0.3, lcg))),
    }
}

/// Up to 5 % of the rows, including removed ones.
fn rows(scene: &Scene, lcg: &mut Lcg) -> Arc<[u32]> {
    let all = scene.row_count();
    let count = 1 + lcg.below(all / 20 + 1);
    let some: BTreeSet<u32> = (0..count).map(|_| lcg.below(all) as u32).collect();
    some.into_iter().collect()
}

fn set_states(scene: &Scene, state: PathState, lcg: &mut Lcg) -> Edit {
    Edit::SetStates(rows(scene, lcg).iter().map(|&row| (row, state)).collect())
}

fn own_style(area: &Area, lcg: &mut Lcg) -> OwnStyle {
    let opacity = if lcg.below(4) == 0 { 0x90 } else { 0xff };
    let color = (lcg.below(0x100_0000) as u32) << 8 | opacity;
    let width_m = lcg.between(0.0, 0.03) * area.size.x;
    OwnStyle {
        width_m: (lcg.below(2) == 0).then_some(width_m as f32),
        color_rgba: (lcg.below(3) > 0).then_some(color),
    }
}

#[cfg(test)]
mod tests {
    use guideway_cpu::Oracle;
    use guideway_scene::{Budget, Frame, Method};

    use super::*;
    use crate::methods::render_view;
    use crate::scenes::site;
    use crate::sketch::Sketch;

    #[test]
    fn every_kind_changes_the_picture() {
        let drawing = site(Sketch::new(48, 32), 40, 1).build();
        let picture = |scene: &Scene| -> Frame {
            let prepared = Oracle.prepare(Arc::new(scene.clone()), &Budget::default());
            let shown = render_view(
                prepared.expect("memory enough").as_mut(),
                &drawing.view,
                &drawing.style,
            );
            shown.expect("the oracle draws everything").0
        };
        let area = Area::of(&drawing.view);
        let mut scene = drawing.scene();
        let mut lcg = Lcg::new(2);
        for (what, kind) in KINDS {
            let before = picture(&scene);
            let edit = kind(&scene, &area, &mut lcg);
            scene.edit(&edit).expect("an edit that can be done");
            assert!(before != picture(&scene), "{what}");
        }
    }
}
