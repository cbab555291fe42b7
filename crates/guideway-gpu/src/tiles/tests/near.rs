//! Points of 16 bits, and exact ones where a view comes near.

use guideway_scene::Edit;
use guideway_spline::Affine;

use super::*;

/// Short bent paths close to each other, and one two kilometres away: steps are small beside the whole.
fn dense(has_colors: bool) -> Arc<Scene> {
    let mut layout = layout(3000, 1.0);
    let mut runs = Runs::default();
    runs.push_line(Point::new(2000.0, 30.0), Point::new(2001.0, 31.0));
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    for path in (0..3001).filter(|_| has_colors) {
        let style = OwnStyle {
            color_rgba: Some((path as u32).wrapping_mul(0x9e37_79b9) | 0xff),
            ..OwnStyle::default()
        };
        layout.paths.set_own_style(path, style);
    }
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

/// The same with floats for all points.
fn exact(tiles: &Tiles, scene: &Arc<Scene>) -> PreparedTiles {
    let mut exact = prepared(tiles, scene);
    exact.bring(0.0).unwrap();
    exact
}

/// Mean and greatest difference of levels.
fn difference(a: &Frame, b: &Frame) -> (f64, u8) {
    let pairs = a.pixels().iter().flatten().zip(b.pixels().iter().flatten());
    let off: Vec<_> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
    let sum: f64 = off.iter().map(|off| f64::from(*off)).sum();
    (sum / off.len() as f64, off.into_iter().max().unwrap_or(0))
}

fn point_bytes(prepared: &PreparedTiles) -> u64 {
    let chunks = &prepared.store.as_ref().unwrap().chunks;
    chunks.iter().map(|chunk| chunk.point_words.bytes()).sum()
}

/// Clusters with points of 16 bits, with any stroke that is drawn.
fn coarse_clusters(prepared: &PreparedTiles) -> usize {
    let store = prepared.store.as_ref().unwrap();
    let is_coarse = |cluster: &&params::Cluster| {
        let first = cluster.first_stroke as usize;
        let strokes = &store.stroke_list[first..first + cluster.strokes as usize];
        cluster.step_m > 0.0 && strokes.iter().any(|stroke| stroke.is_drawn())
    };
    store.cluster_list.iter().filter(is_coarse).count()
}

#[test]
fn points_of_half_the_size_show_the_same_from_afar_and_become_exact_near_by() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    for scene in [dense(false), dense(true)] {
        let mut coarse = prepared(&tiles, &scene);
        let mut exact = exact(&tiles, &scene);
        assert!(point_bytes(&coarse) < point_bytes(&exact) * 11 / 20);
        let all_coarse = coarse_clusters(&coarse);
        assert!(all_coarse > 40 && coarse_clusters(&exact) == 0);
        let compare = |coarse: &mut PreparedTiles, exact: &mut PreparedTiles, view: &View| {
            let (drawn, report) = picture(coarse, view, &style);
            let (expected, of_exact) = picture(exact, view, &style);
            assert_eq!(report.drawn, of_exact.drawn);
            difference(&drawn, &expected)
        };
        // From afar.
        let (mean, worst) = compare(&mut coarse, &mut exact, &all());
        assert!(mean < 0.1 && worst <= 16, "{mean} {worst}");
        assert_eq!(coarse_clusters(&coarse), all_coarse);
        // So near that what is seen becomes exact, and nothing else.
        let near = view([50.0, 30.0], 100.0);
        let mut kept_coarse = prepared(&tiles, &scene);
        kept_coarse.facts.step_m = 0.0;
        let (rounded, _) = compare(&mut kept_coarse, &mut exact, &near);
        let (mean, worst) = compare(&mut coarse, &mut exact, &near);
        assert!(
            mean < rounded / 4.0 && worst <= 12,
            "{mean} {worst}, {rounded}"
        );
        let left = coarse_clusters(&coarse);
        assert!(
            left < all_coarse && left > all_coarse / 2,
            "{left} of {all_coarse}"
        );
        // Questions see the same.
        let tops = |prepared: &mut PreparedTiles| {
            let tops = prepared.top_paths(&near, &style, &Cancel::default());
            tops.unwrap().unwrap()
        };
        let (a, b) = (tops(&mut coarse), tops(&mut exact));
        let others = a.iter().zip(&b).filter(|(a, b)| a != b).count();
        assert!(others * 200 < a.len(), "{others}");
        // And back, where some are exact and some are not.
        let (mean, worst) = compare(&mut coarse, &mut exact, &all());
        assert!(mean < 0.1 && worst <= 16, "{mean} {worst}");
    }
}

#[test]
fn moved_paths_of_16_bits_are_where_they_are_moved_to() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    let scene = dense(false);
    let mut coarse = prepared(&tiles, &scene);
    let all_coarse = coarse_clusters(&coarse);
    for offset in [Point::new(0.7, -0.4), Point::new(40.0, 0.0)] {
        let edit = Edit::Transform {
            paths: (0..3000).step_by(7).collect(),
            by: Affine::translation(offset),
        };
        coarse.edit(&edit).unwrap();
        let moved = Arc::clone(&coarse.scene);
        let (drawn, _) = picture(&mut coarse, &all(), &style);
        let (expected, _) = picture(&mut exact(&tiles, &moved), &all(), &style);
        let (mean, worst) = difference(&drawn, &expected);
        assert!(mean < 0.1 && worst <= 16, "{mean} {worst}");
    }
    assert_eq!(coarse_clusters(&coarse), all_coarse);
}

#[test]
fn all_becomes_exact_once_most_was_seen_from_near() {
    let Some(tiles) = tiles() else { return };
    let mut layout = layout(16_000, 1.0);
    let mut runs = Runs::default();
    runs.push_line(Point::new(2000.0, 30.0), Point::new(2001.0, 31.0));
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap());
    let mut coarse = prepared(&tiles, &scene);
    assert!(coarse_clusters(&coarse) > 200);
    let size = FrameSize::new(6000, 3600).unwrap();
    let large = View::new(size, Point::new(50.0, 30.0), 60.0).unwrap();
    coarse.come_near(&large, &Style::default()).unwrap();
    assert_eq!(coarse_clusters(&coarse), 0);
    assert!(coarse.places.is_none());
}

#[test]
fn what_has_no_room_to_become_exact_is_refused_and_not_lost() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (dense(false), Style::default());
    let (expected, report) = picture(&mut prepared(&tiles, &scene), &all(), &style);
    let budget = Budget {
        memory_bytes: report.peak_bytes + 1024,
        ..Budget::default()
    };
    let shared = Arc::clone(&tiles.0);
    let mut tight = PreparedTiles::new(shared, Arc::clone(&scene), &budget).unwrap();
    let near = view([50.0, 30.0], 100.0);
    let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
    for _ in 0..2 {
        let drawn = tight.render(&near, &style, &Cancel::default(), &mut frame);
        assert!(
            matches!(drawn, Err(RenderError::Budget { .. })),
            "{drawn:?}"
        );
        let (drawn, _) = picture(&mut tight, &all(), &style);
        assert!(drawn.pixels() == expected.pixels());
    }
}
