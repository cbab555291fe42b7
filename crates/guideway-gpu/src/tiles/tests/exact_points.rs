//! Quantized points, and exact ones in near views: the view alone decides which are drawn.

use std::collections::BTreeSet;

use guideway_scene::Edit;
use guideway_scene::Work;
use guideway_spline::Affine;

use super::layouts::{Cluster, PointFormat};
use super::*;

/// Dense paths, some of several strokes (two of them in the center of [`near`]), and one path two
/// kilometers away: quantization steps are small beside the scene.
pub(super) fn dense(paths: u32, reach_m: f64) -> Layout {
    let mut layout = layout(paths, reach_m);
    for row in (0..paths).step_by(100) {
        let (at, step_m) = match row {
            0 => (Point::new(48.0, 30.0), 0.05),
            100 => (Point::new(52.0, 30.0), -0.05),
            _ => (layout.paths.get(row as usize).ends().unwrap().0, 0.05),
        };
        let wave = (0..80).map(f64::from);
        let control: Vec<_> = wave
            .map(|i| at + Point::new(step_m * i, (0.3 * i).sin()))
            .collect();
        push(&mut layout, |runs| runs.push(&control));
    }
    let far = Point::new(2000.0, 30.0);
    push(&mut layout, |runs| {
        runs.push_line(far, far + Point::new(1.0, 1.0));
    });
    layout
}

fn push(layout: &mut Layout, add: impl FnOnce(&mut Runs)) {
    let mut runs = Runs::default();
    add(&mut runs);
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
}

pub(super) fn scene(layout: Layout) -> Arc<Scene> {
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

/// Scenes of one color and of many.
fn scenes() -> [Arc<Scene>; 2] {
    let mut colored = dense(3000, 1.0);
    for path in 0..colored.paths.len() {
        let style = OwnStyle {
            color_rgba: Some((path as u32).wrapping_mul(0x9e37_79b9) | 0xff),
            ..OwnStyle::default()
        };
        colored.paths.set_own_style(path, style);
    }
    [scene(dense(3000, 1.0)), scene(colored)]
}

/// A scene with exact points only.
fn exact(tiles: &Tiles, scene: &Arc<Scene>) -> PreparedTiles {
    let mut exact = prepared(tiles, scene);
    let packing = exact.scene.packing.exact();
    exact.upload(packing).unwrap();
    assert_eq!(exact.scene.facts.greatest_step_m, 0.0);
    exact
}

/// A view so near that the rounding of all clusters would show.
fn near() -> View {
    view([50.0, 30.0], 100.0)
}

/// A view so far that no rounding shows.
fn far_view() -> View {
    view([50.0, 30.0], 12.0)
}

/// Clusters with exact points on the device.
pub(super) fn exact_clusters(prepared: &PreparedTiles) -> BTreeSet<u32> {
    let buffers = prepared.scene.buffers.as_ref().unwrap();
    let all = 0..buffers.cluster_list.len() as u32;
    let Some(exact) = &buffers.exact_points else {
        return BTreeSet::new();
    };
    all.filter(|&index| exact.first_point(index).is_some())
        .collect()
}

fn rounded_clusters(prepared: &PreparedTiles) -> usize {
    let clusters = &prepared.scene.buffers.as_ref().unwrap().cluster_list;
    let is_rounded = |c: &&Cluster| c.format() == PointFormat::Rounded;
    clusters.iter().filter(is_rounded).count()
}

/// Mean and greatest difference of channels.
pub(super) fn difference(a: &Frame, b: &Frame) -> (f64, u8) {
    let pairs = a.pixels().iter().flatten().zip(b.pixels().iter().flatten());
    let off: Vec<_> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
    let sum: f64 = off.iter().map(|off| f64::from(*off)).sum();
    (sum / off.len() as f64, off.into_iter().max().unwrap_or(0))
}

#[track_caller]
fn assert_same((drawn, report): &(Frame, Report), (expected, of_expected): &(Frame, Report)) {
    assert!(drawn.pixels() == expected.pixels());
    assert_eq!(report.drawn, of_expected.drawn);
}

#[test]
fn far_views_draw_rounded_points_and_near_views_exact_ones() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    for scene in scenes() {
        let (mut rounded, mut exact) = (prepared(&tiles, &scene), exact(&tiles, &scene));
        let bytes = |prepared: &PreparedTiles| {
            let chunks = &prepared.scene.buffers.as_ref().unwrap().point_buffers;
            chunks.iter().map(|chunk| chunk.points.bytes()).sum::<u64>()
        };
        assert!(bytes(&rounded) < bytes(&exact) * 11 / 20);
        assert!(rounded_clusters(&rounded) > 40 && rounded_clusters(&exact) == 0);
        let mut pictures = |view: &View| {
            let drawn = picture(&mut rounded, view, &style);
            let expected = picture(&mut exact, view, &style);
            assert_eq!(drawn.1.drawn, expected.1.drawn);
            (drawn.0, expected.0)
        };
        // A difference shows that points are rounded.
        let (drawn, expected) = pictures(&far_view());
        let (mean, worst) = difference(&drawn, &expected);
        assert!(0.0 < mean && mean < 0.2 && worst <= 24, "{mean} {worst}");
        let (drawn, expected) = pictures(&near());
        assert!(drawn == expected);
    }
}

/// Dense paths, and paths that lead there from a sparse area, which comes first along the Hilbert
/// curve. The clusters of the sparse area have exact points.
fn from_sparse_to_dense() -> Layout {
    let mut layout = layout(3000, 1.0);
    for row in 0..40 {
        let from = Point::new(-2000.0, 40.0 * f64::from(row));
        let control: Vec<_> = (0..200)
            .map(|i| {
                let share = f64::from(i) / 199.0;
                let to = Point::new(49.0 + 0.05 * f64::from(row), 30.0);
                let wave = Point::new(0.0, 0.3 * (0.3 * f64::from(i)).sin());
                to + (from - to) * share.powi(6) + wave
            })
            .collect();
        push(&mut layout, |runs| runs.push(&control));
    }
    layout
}

#[test]
fn near_views_find_the_parts_of_paths_with_rounded_and_exact_clusters() {
    let Some(tiles) = tiles() else { return };
    let scene = scene(from_sparse_to_dense());
    let (mut rounded, mut exact) = (prepared(&tiles, &scene), exact(&tiles, &scene));
    let all = rounded.scene.buffers.as_ref().unwrap().cluster_list.len();
    assert!((10..all).contains(&rounded_clusters(&rounded)));
    let style = Style::default();
    let (drawn, expected) = (
        picture(&mut rounded, &near(), &style),
        picture(&mut exact, &near(), &style),
    );
    assert!(!exact_clusters(&rounded).is_empty());
    assert_same(&drawn, &expected);
}

#[test]
fn earlier_views_do_not_change_the_picture() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    let density = super::style(Shading::Density(ToneMap::Log));
    for (scene, style) in scenes().into_iter().zip([style, density]) {
        // In the middle distance some clusters are near and others are not.
        let (beside, middle) = (view([20.0, 40.0], 80.0), view([50.0, 30.0], 32.0));
        let views = [far_view(), near(), beside, middle];
        let new = views.map(|view| picture(&mut prepared(&tiles, &scene), &view, &style));
        let mut used = prepared(&tiles, &scene);
        for i in [0, 1, 0, 3, 1, 2, 3, 0, 1, 2] {
            assert_same(&picture(&mut used, &views[i], &style), &new[i]);
        }
        let (some, all) = (exact_clusters(&used), rounded_clusters(&used));
        assert!(some.len() > 3 && some.len() < all / 2, "{}", some.len());
        let cancel = Cancel::default();
        let mut new = prepared(&tiles, &scene);
        let count = |prepared: &mut PreparedTiles| prepared.count_work(&near(), &style, &cancel);
        let (of_used, of_new) = (count(&mut used).unwrap(), count(&mut new).unwrap());
        // The number of atomics depends on the order of workgroups: they share histograms.
        let but_atomics = |work| Work {
            atomics: None,
            ..work
        };
        assert_eq!(but_atomics(of_used), but_atomics(of_new));
    }
}

/// A device whose bindings hold 2,048 exact points.
fn small_bindings() -> Tiles {
    limited(GpuOptions {
        storage_binding_bytes: Some(16 << 10),
        ..GpuOptions::default()
    })
}

/// Stars of `clusters` clusters each, side by side, and one path two kilometers away.
fn stars(clusters: u32, length_m: f64, centers: &[Point<f64>]) -> Arc<Scene> {
    let mut layout = dense(0, 1.0);
    for &center in centers {
        for path in 0..clusters * constants::CLUSTER_STROKES {
            let turn = f64::from(path);
            let end = Point::new(turn.cos(), turn.sin()) * (length_m / 2.0);
            push(&mut layout, |runs| {
                runs.push_line(center - end, center + end);
            });
        }
    }
    scene(layout)
}

#[test]
fn evicting_exact_points_does_not_change_the_picture() {
    let Some(tiles) = tiles() else { return };
    let centers = [0.0, 0.1, 0.2, 0.3].map(|x_m| Point::new(x_m, 0.0));
    let scene = stars(5, 0.02, &centers);
    let style = Style {
        line_rule: LineRule::Thesis,
        ..Style::default()
    };
    let row = view([0.15, 0.0], 600.0);
    let mut free = prepared(&tiles, &scene);
    picture(&mut free, &row, &style);
    // One row of tiles needs more points than fit.
    let clusters = &free.scene.buffers.as_ref().unwrap().cluster_list;
    let needed = exact_clusters(&free).into_iter();
    let points = needed.map(|at| clusters[at as usize].points);
    assert!(points.sum::<u32>() > 2 * 2048);
    let mut used = prepared(&small_bindings(), &scene);
    let (first, last) = (view([0.0, 0.0], 2000.0), view([0.3, 0.0], 2000.0));
    let far_view = view([0.15, 0.0], 100.0);
    let mut evicted = 0;
    for view in [far_view, row, first, last, first, far_view, row] {
        let before = exact_clusters(&used);
        let (drawn, _) = picture(&mut used, &view, &style);
        let (expected, _) = picture(&mut prepared(&tiles, &scene), &view, &style);
        assert!(drawn == expected, "{view:?}");
        evicted += before.difference(&exact_clusters(&used)).count();
    }
    assert!(evicted > 10, "{evicted}");
}

#[test]
fn exact_points_are_charged_and_evicted_first() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (scene(dense(3000, 1.0)), Style::default());
    let views = [all(), near(), all(), near()];
    let new = views.map(|view| picture(&mut prepared(&tiles, &scene), &view, &style));
    let mut used = prepared(&tiles, &scene);
    picture(&mut used, &all(), &style);
    let before_bytes = used.device.memory.held_bytes();
    let (_, report) = picture(&mut used, &near(), &style);
    let buffers = used.scene.buffers.as_ref().unwrap();
    let exact = buffers.exact_points.as_ref().unwrap();
    let exact_bytes = exact.buffer.points.bytes();
    assert!(exact_bytes > 0 && used.device.memory.held_bytes() >= before_bytes + exact_bytes);
    assert!(report.peak_bytes >= before_bytes + exact_bytes);
    // Line buffers shrink for exact points, and exact points go for lines.
    let mut refused = 0;
    let enough_bytes = new[0].1.peak_bytes;
    let less_bytes = (4..=10).rev().map(|part| enough_bytes * part / 10);
    for memory_bytes in [enough_bytes + (400 << 10)].into_iter().chain(less_bytes) {
        let budget = Budget {
            memory_bytes,
            ..Budget::default()
        };
        let tight = PreparedTiles::new(Arc::clone(&tiles.0), Arc::clone(&scene), &budget);
        let Ok(mut tight) = tight else {
            continue;
        };
        for (view, (expected, of_expected)) in views.iter().zip(&new) {
            let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
            match tight.render(view, &style, &Cancel::default(), &mut frame) {
                Ok(report) => {
                    assert!(frame.pixels() == expected.pixels(), "{memory_bytes}");
                    assert!(report.peak_bytes <= memory_bytes);
                    let is_enough = memory_bytes >= enough_bytes;
                    assert!(
                        !is_enough || report.bands == of_expected.bands,
                        "{report:?}"
                    );
                }
                Err(RenderError::Budget { .. }) => refused += 1,
                Err(other) => panic!("{other}"),
            }
        }
        assert!(memory_bytes < enough_bytes || refused == 0);
    }
}

#[test]
fn rejects_a_tile_whose_exact_points_exceed_the_binding() {
    let Some(_) = tiles() else { return };
    // All clusters lie in one tile.
    let (scene, style) = (stars(12, 8.0, &[Point::default()]), Style::default());
    let mut used = prepared(&small_bindings(), &scene);
    let far_view = view([0.0, 0.0], 10.0);
    let (expected, _) = picture(&mut used, &far_view, &style);
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let close = view([0.0, 0.0], 60.0);
    let drawn = used.render(&close, &style, &Cancel::default(), &mut frame);
    assert!(
        matches!(drawn, Err(RenderError::Budget { .. })),
        "{drawn:?}"
    );
    let (drawn, _) = picture(&mut used, &far_view, &style);
    assert!(drawn == expected);
}

#[test]
fn edits_show_in_near_and_far_views() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    let scene = scene(dense(3000, 1.0));
    let (mut rounded, mut exact) = (prepared(&tiles, &scene), exact(&tiles, &scene));
    let (before, _) = picture(&mut rounded, &near(), &style);
    let all_rounded = rounded_clusters(&rounded);
    // Paths of one and of several strokes, moved slightly, and rotated so that parts change order.
    let paths: Arc<[u32]> = (0..3000).step_by(3).chain(3000..3030).collect();
    let turn = |by: f64| Affine::rotation(by, Point::new(50.0, 30.0));
    for by in [
        Affine::translation(Point::new(0.2, -0.1)),
        turn(0.01),
        turn(1.5),
        turn(1.6),
        turn(1.5),
    ] {
        let edit = Edit::Transform {
            paths: Arc::clone(&paths),
            by,
        };
        for prepared in [&mut rounded, &mut exact] {
            prepared.edit(&edit).unwrap();
        }
        let (drawn, _) = picture(&mut rounded, &near(), &style);
        assert!(drawn != before);
        let (expected, _) = picture(&mut exact, &near(), &style);
        assert!(drawn == expected);
        // The same after a new upload.
        rounded.scene.buffers.as_mut().unwrap().exact_points = None;
        let (again, _) = picture(&mut rounded, &near(), &style);
        assert!(again == expected);
        let (drawn, _) = picture(&mut rounded, &all(), &style);
        let (expected, _) = picture(&mut exact, &all(), &style);
        let (mean, worst) = difference(&drawn, &expected);
        assert!(mean < 0.1 && worst <= 16, "{mean} {worst}");
    }
    assert_eq!(rounded_clusters(&rounded), all_rounded);
}
