//! What is kept over edits: lines of clusters and parts of pictures that they do not touch.

use guideway_layout::Geometry;
use guideway_scene::{Edit, Insertion, PathState};
use guideway_spline::Affine;

use super::*;

/// A scene drawn with all that is kept, and the same with the same history that keeps nothing.
struct Pair {
    kept: PreparedTiles,
    anew: PreparedTiles,
    style: Style,
}

impl Pair {
    fn new(tiles: &Tiles, scene: &Arc<Scene>, style: Style) -> Self {
        let mut anew = prepared(tiles, scene);
        anew.easel.keeps = false;
        Self {
            kept: prepared(tiles, scene),
            anew,
            style,
        }
    }

    fn edit(&mut self, edit: &Edit) {
        for prepared in [&mut self.kept, &mut self.anew] {
            prepared.edit(edit).unwrap();
        }
    }

    /// The picture, the same by both, and what is said of it by the one that keeps something.
    #[track_caller]
    fn check(&mut self, view: &View) -> (Frame, Report) {
        if let Some(store) = &mut self.kept.store {
            let known = store.whole_paths.clone();
            store.count_whole_paths(0..known.len());
            assert_eq!(store.whole_paths, known);
        }
        let (frame, report) = picture(&mut self.kept, view, &self.style);
        let (expected, _) = picture(&mut self.anew, view, &self.style);
        let wrong = frame.pixels().iter().zip(expected.pixels());
        let wrong = wrong.filter(|(a, b)| a != b).count();
        assert_eq!(wrong, 0, "wrong pixels of {view:?}");
        (frame, report)
    }
}

fn has_stage(report: &Report, name: &str) -> bool {
    report.stages.iter().any(|stage| stage.name == name)
}

/// Rows of paths whose first point is nearest to a place.
fn nearest(scene: &Scene, place: [f64; 2], count: usize) -> Arc<[u32]> {
    let place = Point::new(place[0], place[1]);
    let mut rows: Vec<u32> = scene.draw_order().to_vec();
    let distance = |row: u32| {
        let hull = scene.layout().paths.get(row as usize).hull_bounds();
        hull.unwrap().center().distance(place)
    };
    rows.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    rows[..count].into()
}

fn insertion(points: &[[f64; 2]], width_m: Option<f32>) -> Insertion {
    let mut runs = Runs::default();
    let points: Vec<_> = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
    runs.push(&points);
    Insertion {
        runs,
        style: OwnStyle {
            width_m,
            ..OwnStyle::default()
        },
        ..Insertion::default()
    }
}

/// Edits of few paths each, all about the middle: moved a little and far, of more points, hidden, shown, removed, inserted.
fn edits(scene: &Scene) -> Vec<Edit> {
    let some = |place, count| nearest(scene, place, count);
    let by = |x, y| Affine::translation(Point::new(x, y));
    let states = |paths: &Arc<[u32]>, state| {
        Edit::SetStates(paths.iter().map(|&path| (path, state)).collect())
    };
    let a_few = some([50.0, 30.0], 4);
    let bent = [44.0, 47.0, 50.0, 53.0, 50.0, 47.0, 44.0];
    let bent = |y: f64| bent.map(|x| Point::new(x, y + f64::abs(x - 47.0)));
    let curves = [bent(28.0), bent(29.0)].concat();
    vec![
        Edit::Transform {
            paths: some([51.0, 31.0], 3),
            by: by(0.4, -0.3),
        },
        Edit::Transform {
            paths: some([46.0, 33.0], 2),
            by: by(9.0, -7.0),
        },
        Edit::Reshape {
            paths: some([52.0, 28.0], 2),
            curves: Arc::new(Geometry::from_f64(curves, vec![7, 14])),
        },
        states(&a_few, PathState::Hidden),
        Edit::Insert(
            [insertion(
                &[[45.0, 25.0], [48.0, 31.0], [52.0, 29.0], [55.0, 35.0]],
                None,
            )]
            .into(),
        ),
        states(&a_few, PathState::Shown),
        states(&some([48.0, 29.0], 3), PathState::Removed),
        Edit::Transform {
            paths: some([51.0, 31.0], 3),
            by: by(-0.2, 0.5),
        },
    ]
}

#[test]
fn an_edit_leaves_the_lines_of_what_it_does_not_touch() {
    let Some(tiles) = tiles() else { return };
    let density = style(Shading::Density(ToneMap::Log));
    for (scene, style, has_few) in [
        (plain(6000, 4.0), Style::default(), false),
        (plain(6000, 4.0), Style::default(), true),
        (mixed(6000, 4.0), Style::default(), false),
        (plain(6000, 4.0), density, true),
    ] {
        let mut pair = Pair::new(&tiles, &scene, style);
        let view = |step: usize| view([50.0, 30.0], 3.0 + 0.01 * step as f64);
        // The first frame may try to make do with less room, and then keeps no lines: that depends on what is hidden by chance.
        for step in 0..2 {
            // Made by one workgroup a cluster, or by several.
            pair.kept.easel.has_few = has_few;
            pair.check(&view(step));
        }
        let mut struck = 0;
        for (edit, step) in edits(&scene).iter().zip(1..) {
            // Views of one level, never the one before, so that no part of a picture is kept.
            let (before, report) = pair.check(&view(2 * step));
            assert!(!has_stage(&report, "strike"));
            pair.edit(edit);
            let (after, report) = pair.check(&view(2 * step + 1));
            assert!(before != after);
            struck += usize::from(has_stage(&report, "strike"));
            assert!(!has_stage(&report, "cull") || !has_stage(&report, "strike"));
        }
        assert!(struck >= 6, "{struck}");
        // Two edits, and a view of another level.
        let [first, second] = [0, 7].map(|i| edits(&scene)[i].clone());
        pair.edit(&first);
        let nearer = super::view([50.0, 30.0], 9.0);
        pair.edit(&second);
        assert!(has_stage(&pair.check(&view(30)).1, "strike"));
        pair.edit(&first);
        pair.check(&nearer);
        pair.check(&view(31));
    }
}

#[test]
fn lines_are_made_anew_once_many_are_others() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(6000, 4.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    // With room for all that is added.
    let room = Size {
        lines: 1 << 18,
        references: 1 << 20,
        has_ranks: false,
    };
    pair.kept.easel.room = Some(Room::new(&mut pair.kept.memory, room).unwrap());
    let view = |step: u32| view([50.0, 30.0], 3.0 + 0.005 * f64::from(step));
    pair.check(&view(0));
    let to_and_fro = |step: u32| Edit::Transform {
        paths: nearest(&scene, [50.0, 30.0], 60),
        by: Affine::translation(Point::new(
            if step.is_multiple_of(2) { 0.3 } else { -0.3 },
            0.0,
        )),
    };
    let mut anew = Vec::new();
    for step in 1..20 {
        pair.edit(&to_and_fro(step));
        if has_stage(&pair.check(&view(step)).1, "cull") {
            anew.push(step);
        }
    }
    assert!((1..10).contains(&anew.len()), "{anew:?}");
    // More than a quarter at once.
    pair.edit(&Edit::Transform {
        paths: (0..6000).step_by(3).collect(),
        by: Affine::translation(Point::new(0.1, 0.2)),
    });
    let (_, report) = pair.check(&view(20));
    assert!(has_stage(&report, "cull") && !has_stage(&report, "strike"));
}

#[test]
fn an_edit_of_a_view_that_stays_draws_the_tiles_that_it_touches() {
    let Some(tiles) = tiles() else { return };
    let density = style(Shading::Density(ToneMap::Log));
    let narrow = limited(GpuOptions {
        workgroups_per_dimension: Some(12),
        ..GpuOptions::default()
    });
    let size = FrameSize::new(420, 260).unwrap();
    let here = View::new(size, Point::new(50.0, 30.0), 4.0).unwrap();
    for (tiles, scene, style, has_room) in [
        (&tiles, plain(6000, 1.0), Style::default(), true),
        (&tiles, mixed(6000, 1.0), Style::default(), true),
        (&tiles, plain(6000, 1.0), density, true),
        // Where there is no room behind the lines that are kept, and where the picture is not held at once.
        (&tiles, mixed(6000, 1.0), Style::default(), false),
        (&narrow, mixed(6000, 1.0), Style::default(), false),
    ] {
        let mut pair = Pair::new(tiles, &scene, style);
        if has_room {
            let room = Size {
                lines: 1 << 18,
                references: 1 << 20,
                has_ranks: true,
            };
            pair.kept.easel.room = Some(Room::new(&mut pair.kept.memory, room).unwrap());
        }
        let (mut before, whole) = pair.check(&here);
        let nearer = View::new(size, Point::new(50.0, 30.0), 4.01).unwrap();
        let (mut parts, mut renewed) = (0, 0);
        for (edit, step) in edits(&scene).into_iter().zip(1_u32..) {
            pair.edit(&edit);
            let (after, report) = pair.check(&here);
            assert!(before != after, "{edit:?}");
            parts += usize::from(2 * report.lines < whole.lines);
            before = after;
            if step.is_multiple_of(3) {
                // Lines were kept all the time, but for what was touched.
                let is_renewed = has_stage(&pair.check(&nearer).1, "strike");
                pair.check(&here);
                renewed += usize::from(is_renewed);
            }
        }
        assert!(
            (parts >= 6 && renewed > 0) || !has_room,
            "{parts} {renewed}"
        );
        // Out of sight nothing is drawn.
        let aside = View::new(size, Point::new(10.0, 10.0), 20.0).unwrap();
        pair.check(&aside);
        pair.edit(&edits(&scene)[0]);
        assert!(pair.check(&aside).1.lines == 0 || !has_room);
    }
}

#[test]
fn what_changes_the_looks_of_all_draws_all_anew() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(3000, 2.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    let view = view([50.0, 30.0], 2.0);
    let (mut before, _) = pair.check(&view);
    let wide = insertion(
        &[[49.0, 30.0], [50.0, 30.0], [51.0, 30.0], [52.0, 30.0]],
        Some(3.0),
    );
    let look = OwnStyle {
        color_rgba: Some(0x2266_aaff),
        ..OwnStyle::default()
    };
    let rows = 0..scene.row_count() as u32;
    for edit in [
        Edit::Insert([wide].into()),
        Edit::Restyle([(7, look)].into()),
        Edit::Restyle(rows.map(|row| (row, look)).collect()),
    ] {
        pair.edit(&edit);
        let (after, _) = pair.check(&view);
        assert!(before != after, "{edit:?}");
        before = after;
    }
}

#[test]
fn a_picture_that_was_edited_can_be_moved() {
    let Some(tiles) = tiles() else { return };
    let scene = mixed(3000, 2.0);
    let mut kept = prepared(&tiles, &scene);
    let style = Style::default();
    picture(&mut kept, &all(), &style);
    for (edit, step) in edits(&scene).iter().zip(1..) {
        kept.edit(edit).unwrap();
        let moved = view(
            [50.0 + 2.5 * f64::from(step % 3), 30.0 - f64::from(step)],
            2.0,
        );
        let (frame, report) = picture(&mut kept, &moved, &style);
        assert!(has_stage(&report, "move"), "{edit:?}");
        let mut anew = prepared(&tiles, &scene);
        anew.easel.keeps = false;
        for edit in edits(&scene)[..step as usize].iter() {
            anew.edit(edit).unwrap();
        }
        let (expected, _) = picture(&mut anew, &moved, &style);
        // Rounding differs by the place in the picture: a sample here and there.
        let worst = frame
            .pixels()
            .iter()
            .flatten()
            .zip(expected.pixels().iter().flatten());
        let worst = worst.map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst <= Some(8), "{worst:?} {edit:?}");
    }
}
