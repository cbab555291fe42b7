//! Edits keep cached lines of other clusters, and cached tiles that they do not touch.

use std::sync::atomic::Ordering::Relaxed;

use guideway_layout::Geometry;
use guideway_scene::{Edit, Insertion, PathState};
use guideway_spline::Affine;

use super::*;
use crate::tiles::upload::scene_buffers::SceneBuffers;

/// A scene drawn with caches, and the same scene with the same history drawn without.
pub(super) struct Pair {
    pub(super) cached: PreparedTiles,
    pub(super) uncached: PreparedTiles,
    style: Style,
}

impl Pair {
    pub(super) fn new(tiles: &Tiles, scene: &Arc<Scene>, style: Style) -> Self {
        let mut uncached = prepared(tiles, scene);
        uncached.target.reuses_frames = false;
        Self {
            cached: prepared(tiles, scene),
            uncached,
            style,
        }
    }

    pub(super) fn edit(&mut self, edit: &Edit) {
        for prepared in [&mut self.cached, &mut self.uncached] {
            prepared.edit(edit).unwrap();
        }
    }

    /// Draws both, asserts equal pictures, and returns the report of the one with caches.
    #[track_caller]
    pub(super) fn check(&mut self, view: &View) -> (Frame, Report) {
        if let Some(buffers) = &mut self.cached.scene.buffers {
            let counts = |buffers: &SceneBuffers| -> Vec<u32> {
                let counts = buffers.whole_paths.iter();
                counts.map(|count| count.load(Relaxed)).collect()
            };
            let known = counts(buffers);
            buffers.count_whole_paths(0..known.len());
            assert_eq!(counts(buffers), known);
        }
        let (frame, report) = picture(&mut self.cached, view, &self.style);
        let (expected, _) = picture(&mut self.uncached, view, &self.style);
        let wrong = frame.pixels().iter().zip(expected.pixels());
        let wrong = wrong.filter(|(a, b)| a != b).count();
        assert_eq!(wrong, 0, "wrong pixels of {view:?}");
        (frame, report)
    }
}

fn has_stage(report: &Report, name: &str) -> bool {
    report.stages.iter().any(|stage| stage.name == name)
}

/// Rows of the paths whose hull center is nearest to a place.
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

/// Edits of few paths each, near the center: small and large moves, more points, hide, show,
/// remove, insert.
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
            written: Arc::default(),
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
fn edit_refreshes_only_the_lines_of_its_clusters() {
    let Some(tiles) = tiles() else { return };
    let density = style(Shading::Density(ToneMap::Log));
    for (scene, style, has_few) in [
        (mixed(3000, 0.6), Style::default(), false),
        (plain(3000, 0.6), density, true),
    ] {
        let mut pair = Pair::new(&tiles, &scene, style);
        let view = |step: usize| view([50.0, 30.0], 3.0 + 0.01 * step as f64);
        // The first frame may enable occlusion, and then caches no lines.
        for step in 0..2 {
            // Flattened by one workgroup per cluster, or by several.
            pair.cached.target.has_few_clusters = has_few;
            pair.check(&view(step));
        }
        let (mut refreshed, mut overflows) = (0, 0);
        for (edit, step) in edits(&scene).iter().zip(1..) {
            // Views of one LOD, never the previous view, so that no picture is reused.
            let (before, report) = pair.check(&view(2 * step));
            assert!(!has_stage(&report, "invalidate"));
            pair.edit(edit);
            let (after, report) = pair.check(&view(2 * step + 1));
            assert!(before != after);
            let is_refreshed = has_stage(&report, "invalidate");
            refreshed += usize::from(is_refreshed);
            overflows += usize::from(is_refreshed && has_stage(&report, "cull"));
        }
        // The first new lines may exceed the line buffers, which then grow.
        assert!(refreshed >= 6 && overflows <= 1, "{refreshed} {overflows}");
        // Two edits, and a view of another LOD in between.
        let [first, second] = [0, 7].map(|i| edits(&scene)[i].clone());
        pair.edit(&first);
        pair.edit(&second);
        assert!(has_stage(&pair.check(&view(30)).1, "invalidate"));
        pair.edit(&first);
        let nearer = super::view([50.0, 30.0], 9.0);
        pair.check(&nearer);
        pair.check(&view(31));
    }
}

#[test]
fn flattens_all_lines_once_many_have_changed() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(6000, 1.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    // Capacity for all added lines.
    let capacity = Capacity {
        lines: 1 << 18,
        references: 1 << 20,
        has_ranks: false,
    };
    pair.cached.target.lines =
        Some(LineBuffers::new(&mut pair.cached.device.memory, capacity).unwrap());
    let view = |step: u32| view([50.0, 30.0], 3.0 + 0.004 * f64::from(step));
    pair.check(&view(0));
    let back_and_forth = |step: u32| Edit::Transform {
        paths: nearest(&scene, [50.0, 30.0], 60),
        by: Affine::translation(Point::new(
            if step.is_multiple_of(2) { 0.3 } else { -0.3 },
            0.0,
        )),
    };
    let mut full_passes = Vec::new();
    for step in 1..20 {
        pair.edit(&back_and_forth(step));
        if has_stage(&pair.check(&view(step)).1, "cull") {
            full_passes.push(step);
        }
    }
    assert!((1..10).contains(&full_passes.len()), "{full_passes:?}");
    // More than a quarter of the clusters at once.
    pair.edit(&Edit::Transform {
        paths: (0..6000).step_by(3).collect(),
        by: Affine::translation(Point::new(0.1, 0.2)),
    });
    let (_, report) = pair.check(&view(20));
    assert!(has_stage(&report, "cull") && !has_stage(&report, "invalidate"));
}

#[test]
fn edit_redraws_only_the_tiles_that_it_touches() {
    let Some(tiles) = tiles() else { return };
    let density = style(Shading::Density(ToneMap::Log));
    let narrow = limited(GpuOptions {
        workgroups_per_dimension: Some(8),
        ..GpuOptions::default()
    });
    let size = FrameSize::new(210, 130).unwrap();
    let here = View::new(size, Point::new(50.0, 30.0), 2.0).unwrap();
    for (tiles, scene, style, has_space) in [
        (&tiles, plain(1000, 1.0), density, true),
        // No space behind the cached lines; and buffers that hold only a part of the picture.
        (&tiles, mixed(1000, 1.0), Style::default(), false),
        (&narrow, mixed(1000, 1.0), Style::default(), false),
    ] {
        let mut pair = Pair::new(tiles, &scene, style);
        if has_space {
            let capacity = Capacity {
                lines: 1 << 18,
                references: 1 << 20,
                has_ranks: true,
            };
            pair.cached.target.lines =
                Some(LineBuffers::new(&mut pair.cached.device.memory, capacity).unwrap());
        }
        let (mut before, whole) = pair.check(&here);
        assert_eq!(whole.bands > 1, std::ptr::eq(tiles, &narrow));
        let nearer = View::new(size, Point::new(50.0, 30.0), 2.005).unwrap();
        let (mut parts, mut renewed) = (0, 0);
        for (edit, step) in edits(&scene).into_iter().zip(1_u32..) {
            pair.edit(&edit);
            let (after, report) = pair.check(&here);
            assert!(before != after, "{edit:?}");
            parts += usize::from(2 * report.lines < whole.lines);
            before = after;
            if step.is_multiple_of(3) {
                // Cached lines survived, but for those of edited clusters.
                let is_renewed = has_stage(&pair.check(&nearer).1, "invalidate");
                pair.check(&here);
                renewed += usize::from(is_renewed);
            }
        }
        assert!(
            (parts >= 6 && renewed > 0) || !has_space,
            "{parts} {renewed}"
        );
        // An edit out of sight draws nothing.
        let aside = View::new(size, Point::new(10.0, 10.0), 10.0).unwrap();
        pair.check(&aside);
        pair.edit(&edits(&scene)[0]);
        assert!(pair.check(&aside).1.lines == 0 || !has_space);
    }
}

#[test]
fn change_of_appearance_redraws_all() {
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
fn scrolls_an_edited_picture() {
    let Some(tiles) = tiles() else { return };
    let scene = mixed(3000, 2.0);
    let mut cached = prepared(&tiles, &scene);
    let style = Style::default();
    picture(&mut cached, &all(), &style);
    let mut uncached = prepared(&tiles, &scene);
    uncached.target.reuses_frames = false;
    for (edit, step) in edits(&scene).iter().zip(1..) {
        cached.edit(edit).unwrap();
        let moved = view(
            [50.0 + 2.5 * f64::from(step % 3), 30.0 - f64::from(step)],
            2.0,
        );
        let (frame, report) = picture(&mut cached, &moved, &style);
        assert!(has_stage(&report, "scroll"), "{edit:?}");
        uncached.edit(edit).unwrap();
        let (expected, _) = picture(&mut uncached, &moved, &style);
        // Rounding depends on the place in the picture: single samples differ.
        let worst = frame
            .pixels()
            .iter()
            .flatten()
            .zip(expected.pixels().iter().flatten());
        let worst = worst.map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst <= Some(8), "{worst:?} {edit:?}");
    }
}
