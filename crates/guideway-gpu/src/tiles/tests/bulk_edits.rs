//! Edits of many paths: bytes that go up, and pictures as of a fresh preparation.

use guideway_scene::{Edit, PathState};
use guideway_spline::Affine;

use super::edits::Pair;
use super::exact_points::{dense, exact_clusters, scene};
use super::*;

#[test]
fn paths_that_are_shown_again_upload_no_points() {
    let Some(tiles) = tiles() else { return };
    let scene = mixed(6400, 2.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    let paths: Arc<[u32]> = (0..6400).step_by(10).collect();
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
    let most = 640 * 4;
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
fn edit_of_many_paths_equals_a_fresh_preparation_to_the_bit() {
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
    let scene = plain(6400, 2.0);
    let mut pair = Pair::new(&tiles, &scene, Style::default());
    pair.check(&all());
    let restyle = |pair: &mut Pair, style: &dyn Fn(u32) -> OwnStyle| {
        let rows = (0..6400).step_by(10);
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
    let [of_all, of_one, of_several] = [8, 4 * 640 + 8, 8 * 640 + 3 * 8];
    assert_eq!(
        restyle(&mut pair, &|_| colored(0xff00_00ff)),
        of_all + of_one
    );
    let three = |row: u32| colored([0x00ff_00ff, 0x0000_ffff, 0x0000_0080][row as usize / 10 % 3]);
    assert_eq!(restyle(&mut pair, &three), of_several);
    assert_eq!(restyle(&mut pair, &|_| OwnStyle::default()), of_one);
}
