//! Edits of many paths: the bytes that they upload, and pictures equal to those of a fresh
//! preparation.

use guideway_layout::Geometry;
use guideway_scene::{Edit, PathState};
use guideway_spline::Affine;

use super::edits::Pair;
use super::exact_points::{dense, exact_clusters, scene};
use super::*;

#[test]
fn paths_that_are_shown_again_upload_no_points() {
    let Some(tiles) = tiles() else { return };
    let scene = mixed(1600, 2.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    let paths: Arc<[u32]> = (0..1600).step_by(10).collect();
    let states = |state| Edit::SetStates(paths.iter().map(|&path| (path, state)).collect());
    let [hide, show] = [PathState::Removed, PathState::Shown].map(states);
    let (before, _) = pair.check(&all());
    let bytes = |pair: &mut Pair, edit: &Edit| match pair.cached.edit(edit).unwrap() {
        EditOutcome::InPlace { moved_bytes } => {
            pair.uncached.edit(edit).unwrap();
            moved_bytes
        }
        EditOutcome::NotInPlace => panic!("not in place"),
    };
    // A stroke per path.
    let most = 160 * 4;
    assert!(bytes(&mut pair, &hide) <= most);
    assert!(pair.check(&all()).0 != before);
    assert!(bytes(&mut pair, &show) <= most);
    assert!(pair.check(&all()).0 == before);
    // Edited while they are hidden, they get their new points at once.
    let moved = Edit::Transform {
        paths: Arc::clone(&paths),
        by: Affine::translation(Point::new(0.5, 0.0)),
    };
    bytes(&mut pair, &hide);
    assert!(bytes(&mut pair, &moved) > most);
    assert!(bytes(&mut pair, &show) <= most);
    let (shown, _) = pair.check(&all());
    let mut other = Pair::new(&tiles, &scene, Style::default());
    other.edit(&moved);
    assert!(other.check(&all()).0 == shown && shown != before);
}

#[test]
fn edit_that_packs_the_scene_again_equals_a_fresh_preparation_to_the_bit() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (plain(70_000, 0.2), Style::default());
    let mut edited = prepared(&tiles, &scene);
    picture(&mut edited, &all(), &style);
    let turn = Edit::Transform {
        paths: (0..70_000).collect(),
        by: Affine::rotation(0.4, Point::new(50.0, 30.0)),
    };
    let mut after = Scene::clone(&scene);
    let undo = after.edit_with_undo(&turn, |_| {}).unwrap();
    edited.edit(&turn).unwrap();
    let mut fresh = prepared(&tiles, &Arc::new(after));
    for view in [all(), view([50.0, 30.0], 40.0)] {
        let (drawn, _) = picture(&mut edited, &view, &style);
        assert!(drawn == picture(&mut fresh, &view, &style).0);
    }
    edited.edit(&undo).unwrap();
    let (drawn, _) = picture(&mut edited, &all(), &style);
    assert!(drawn == picture(&mut prepared(&tiles, &scene), &all(), &style).0);
}

#[test]
fn paths_shown_again_in_a_near_view_have_their_exact_points() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (scene(dense(3000, 1.0)), Style::default());
    let near = view([50.0, 30.0], 100.0);
    let states = |state| Edit::SetStates((0..3000).step_by(2).map(|row| (row, state)).collect());
    let mut edited = prepared(&tiles, &scene);
    edited.edit(&states(PathState::Hidden)).unwrap();
    let (half, _) = picture(&mut edited, &near, &style);
    assert!(!exact_clusters(&edited).is_empty());
    edited.edit(&states(PathState::Shown)).unwrap();
    let (drawn, _) = picture(&mut edited, &near, &style);
    let mut fresh = prepared(&tiles, &scene);
    assert!(drawn == picture(&mut fresh, &near, &style).0 && drawn != half);
}

#[test]
fn styles_go_up_as_indices() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(1600, 2.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    pair.check(&all());
    let restyle = |pair: &mut Pair, style: &dyn Fn(u32) -> OwnStyle| {
        let rows = (0..1600).step_by(10);
        let edit = Edit::Restyle(rows.map(|row| (row, style(row))).collect());
        let bytes = match pair.cached.edit(&edit).unwrap() {
            EditOutcome::InPlace { moved_bytes } => moved_bytes,
            EditOutcome::NotInPlace => panic!("not in place"),
        };
        pair.uncached.edit(&edit).unwrap();
        let (drawn, _) = pair.check(&all());
        let mut after = Scene::clone(&pair.cached.scene.scene);
        after.edit(&edit).unwrap();
        let mut fresh = prepared(&tiles, &Arc::new(after));
        assert!(drawn == picture(&mut fresh, &all(), &Style::default()).0);
        bytes
    };
    let colored = |color: u32| OwnStyle {
        color_rgba: Some(color),
        ..OwnStyle::default()
    };
    // All paths get the style that they had, then some another one.
    let [of_all, of_one, of_several] = [8, 4 * 160 + 8, 8 * 160 + 3 * 8];
    assert_eq!(
        restyle(&mut pair, &|_| colored(0xff00_00ff)),
        of_all + of_one
    );
    let three = |row: u32| colored([0x00ff_00ff, 0x0000_ffff, 0x0000_0080][row as usize / 10 % 3]);
    assert_eq!(restyle(&mut pair, &three), of_several);
    assert_eq!(restyle(&mut pair, &|_| OwnStyle::default()), of_one);
}

#[test]
fn single_style_follows_a_translucent_scene() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(3000, 2.0);
    let style = OwnStyle {
        color_rgba: Some(0x2060_a080),
        ..OwnStyle::default()
    };
    let glass = Edit::Restyle((0..3000).map(|row| (row, style)).collect());
    let mut edited = prepared(&tiles, &scene);
    let (before, _) = picture(&mut edited, &all(), &Style::default());
    edited.edit(&glass).unwrap();
    let mut after = Scene::clone(&scene);
    after.edit(&glass).unwrap();
    let (drawn, _) = picture(&mut edited, &all(), &Style::default());
    let mut fresh = prepared(&tiles, &Arc::new(after));
    assert!(drawn == picture(&mut fresh, &all(), &Style::default()).0);
    assert!(drawn != before);
}

#[test]
fn row_that_an_edit_names_twice_is_drawn_once() {
    let Some(tiles) = tiles() else { return };
    let scene = mixed(300, 2.0);
    // Far from its strokes, with another number of points.
    let reshape = |paths: &[u32]| {
        let bend = [30.0, 40.0, 50.0, 60.0, 50.0].map(|x| Point::new(x, x / 3.0));
        let ends = (1..=paths.len() as u32).map(|count| 5 * count).collect();
        Edit::Reshape {
            paths: paths.into(),
            curves: Arc::new(Geometry::from_f64(bend.repeat(paths.len()), ends)),
            written: Arc::default(),
        }
    };
    let states =
        |paths: &[u32], state| Edit::SetStates(paths.iter().map(|&path| (path, state)).collect());
    let mut hidden = Scene::clone(&scene);
    hidden.edit(&states(&[7], PathState::Hidden)).unwrap();
    let show = |paths: &[u32]| states(paths, PathState::Shown);
    for (before, once, twice) in [
        (Arc::clone(&scene), reshape(&[7]), reshape(&[7, 7])),
        (Arc::new(hidden), show(&[7]), show(&[7, 7])),
    ] {
        let [one, two] = [&once, &twice].map(|edit| {
            let mut edited = prepared(&tiles, &before);
            picture(&mut edited, &all(), &Style::default());
            edited.edit(edit).unwrap();
            let (drawn, report) = picture(&mut edited, &all(), &Style::default());
            (drawn, report.drawn)
        });
        assert!(one == two);
    }
}
