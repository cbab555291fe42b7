//! Points of 16 bits, and exact ones where a view comes near: the view alone says which are drawn.

use std::collections::BTreeSet;

use guideway_scene::Edit;
use guideway_scene::Work;
use guideway_spline::Affine;

use super::kernels::is_in_step;
use super::params::{Cluster, Points};
use super::*;

/// Paths close to each other, some of several strokes (two of them to and fro in the middle of [`near`]), and one path
/// two kilometers away: steps are small beside the whole.
fn dense(paths: u32, reach_m: f64) -> Layout {
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

fn scene(layout: Layout) -> Arc<Scene> {
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

/// In one color, and in many.
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

/// With floats for all points.
fn exact(tiles: &Tiles, scene: &Arc<Scene>) -> PreparedTiles {
    let mut exact = prepared(tiles, scene);
    exact.bring(exact.packing.exact()).unwrap();
    assert_eq!(exact.facts.greatest_step_m, 0.0);
    exact
}

/// So near that rounding would show wherever one looks.
fn near() -> View {
    view([50.0, 30.0], 100.0)
}

/// From where all that is seen may be rounded.
fn afar() -> View {
    view([50.0, 30.0], 12.0)
}

/// Clusters whose exact points are there.
fn twins_of(prepared: &PreparedTiles) -> BTreeSet<u32> {
    let store = prepared.store.as_ref().unwrap();
    let all = 0..store.cluster_list.len() as u32;
    let Some(twins) = &store.twins else {
        return BTreeSet::new();
    };
    all.filter(|&at| twins.place(at).is_some()).collect()
}

fn rounded_clusters(prepared: &PreparedTiles) -> usize {
    let clusters = &prepared.store.as_ref().unwrap().cluster_list;
    let is_rounded = |c: &&Cluster| c.held() == Points::Rounded;
    clusters.iter().filter(is_rounded).count()
}

/// Mean and greatest difference of levels.
fn difference(a: &Frame, b: &Frame) -> (f64, u8) {
    let pairs = a.pixels().iter().flatten().zip(b.pixels().iter().flatten());
    let off: Vec<_> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
    let sum: f64 = off.iter().map(|off| f64::from(*off)).sum();
    (sum / off.len() as f64, off.into_iter().max().unwrap_or(0))
}

#[track_caller]
fn assert_alike((drawn, report): &(Frame, Report), (expected, of_expected): &(Frame, Report)) {
    assert!(drawn.pixels() == expected.pixels());
    assert_eq!(report.drawn, of_expected.drawn);
}

#[test]
fn rounding_does_not_show_from_afar_and_is_not_there_from_near() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    for scene in scenes() {
        let (mut rounded, mut exact) = (prepared(&tiles, &scene), exact(&tiles, &scene));
        let bytes = |prepared: &PreparedTiles| {
            let chunks = &prepared.store.as_ref().unwrap().chunks;
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
        // Not the same, or nothing would be rounded.
        let (drawn, expected) = pictures(&afar());
        let (mean, worst) = difference(&drawn, &expected);
        assert!(0.0 < mean && mean < 0.2 && worst <= 24, "{mean} {worst}");
        let (drawn, expected) = pictures(&near());
        assert!(drawn == expected);
    }
}

#[test]
fn what_was_looked_at_before_changes_no_bit() {
    let Some(tiles) = tiles() else { return };
    // Where threads run in step, which lines hide others depends on which workgroup came first.
    if is_in_step(&tiles.0.gpu) {
        assert_bits_stay(&tiles, |work| Work {
            tests: None,
            ..work
        });
        assert_bits_stay(&as_hardware(), |work| work);
    } else {
        assert_bits_stay(&tiles, |work| work);
    }
}

fn assert_bits_stay(tiles: &Tiles, but_order: impl Fn(Work) -> Work) {
    let style = Style::default();
    let density = super::style(Shading::Density(ToneMap::Log));
    for (scene, style) in scenes().into_iter().zip([style, density]) {
        // Some clusters are near from the middle distance, and others are not.
        let (beside, middle) = (view([20.0, 40.0], 80.0), view([50.0, 30.0], 32.0));
        let views = [afar(), near(), beside, middle];
        let new = views.map(|view| picture(&mut prepared(tiles, &scene), &view, &style));
        let mut used = prepared(tiles, &scene);
        for i in [0, 1, 0, 3, 1, 2, 3, 0, 1, 2] {
            assert_alike(&picture(&mut used, &views[i], &style), &new[i]);
        }
        let (some, all) = (twins_of(&used), rounded_clusters(&used));
        assert!(some.len() > 3 && some.len() < all / 2, "{}", some.len());
        // Counts are the same, too.
        let cancel = Cancel::default();
        let mut new = prepared(tiles, &scene);
        let count = |prepared: &mut PreparedTiles| prepared.count_work(&near(), &style, &cancel);
        let (of_used, of_new) = (count(&mut used).unwrap(), count(&mut new).unwrap());
        // Which lines are entered into lists together depends on which workgroup came first.
        let but_atomics = |work| Work {
            atomics: None,
            ..but_order(work)
        };
        assert_eq!(but_atomics(of_used), but_atomics(of_new));
    }
}

/// A device on which a buffer holds 2,048 exact points.
fn narrow() -> Tiles {
    limited(GpuOptions {
        storage_binding_bytes: Some(16 << 10),
        ..GpuOptions::default()
    })
}

/// Stars of so many clusters each, side by side, beside the path two kilometers away.
fn stars(clusters: u32, length_m: f64, centers: &[Point<f64>]) -> Arc<Scene> {
    let mut layout = dense(0, 1.0);
    for &center in centers {
        for path in 0..clusters * params::CLUSTER_STROKES {
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
fn twins_go_where_room_is_short_and_no_bit_changes() {
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
    // More than there is room for, though all lie on one row of tiles.
    let clusters = &free.store.as_ref().unwrap().cluster_list;
    let needed = twins_of(&free).into_iter();
    let points = needed.map(|at| clusters[at as usize].points);
    assert!(points.sum::<u32>() > 2 * 2048);
    let mut used = prepared(&narrow(), &scene);
    let (first, last) = (view([0.0, 0.0], 2000.0), view([0.3, 0.0], 2000.0));
    let afar = view([0.15, 0.0], 100.0);
    let mut gone = 0;
    for view in [afar, row, first, last, first, afar, row] {
        let before = twins_of(&used);
        let (drawn, _) = picture(&mut used, &view, &style);
        let (expected, _) = picture(&mut prepared(&tiles, &scene), &view, &style);
        assert!(drawn == expected, "{view:?}");
        gone += before.difference(&twins_of(&used)).count();
    }
    assert!(gone > 10, "{gone}");
}

#[test]
fn twins_are_counted_and_are_the_first_to_go() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (scene(dense(3000, 1.0)), Style::default());
    let views = [all(), near(), all(), near()];
    let new = views.map(|view| picture(&mut prepared(&tiles, &scene), &view, &style));
    let mut used = prepared(&tiles, &scene);
    picture(&mut used, &all(), &style);
    let before_bytes = used.memory.held_bytes();
    let (_, report) = picture(&mut used, &near(), &style);
    let twins = used.store.as_ref().unwrap().twins.as_ref().unwrap();
    let twins_bytes = twins.chunk.points.bytes();
    assert!(twins_bytes > 0 && used.memory.held_bytes() >= before_bytes + twins_bytes);
    assert!(report.peak_bytes >= before_bytes + twins_bytes);
    // What lines have room for is given back for twins, and twins go for lines.
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
fn a_tile_that_needs_more_than_there_is_room_for_is_refused_and_not_lost() {
    let Some(_) = tiles() else { return };
    // All clusters lie on one tile.
    let (scene, style) = (stars(12, 8.0, &[Point::default()]), Style::default());
    let mut used = prepared(&narrow(), &scene);
    let afar = view([0.0, 0.0], 10.0);
    let (expected, _) = picture(&mut used, &afar, &style);
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    let close = view([0.0, 0.0], 60.0);
    let drawn = used.render(&close, &style, &Cancel::default(), &mut frame);
    assert!(
        matches!(drawn, Err(RenderError::Budget { .. })),
        "{drawn:?}"
    );
    let (drawn, _) = picture(&mut used, &afar, &style);
    assert!(drawn == expected);
}

#[test]
fn edits_show_from_near_and_from_afar() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    let scene = scene(dense(3000, 1.0));
    let (mut rounded, mut exact) = (prepared(&tiles, &scene), exact(&tiles, &scene));
    let (before, _) = picture(&mut rounded, &near(), &style);
    let all_rounded = rounded_clusters(&rounded);
    // Whole paths and parted ones: a little, and turned so that their parts come in another order.
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
        // The same if they are made anew.
        rounded.store.as_mut().unwrap().twins = None;
        let (again, _) = picture(&mut rounded, &near(), &style);
        assert!(again == expected);
        let (drawn, _) = picture(&mut rounded, &all(), &style);
        let (expected, _) = picture(&mut exact, &all(), &style);
        let (mean, worst) = difference(&drawn, &expected);
        assert!(mean < 0.1 && worst <= 16, "{mean} {worst}");
    }
    assert_eq!(rounded_clusters(&rounded), all_rounded);
}
