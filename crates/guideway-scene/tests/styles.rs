//! Counts of states, colors and widths after edits, against a look at every path.

use std::sync::Arc;

use guideway_layout::{Geometry, Layout, OwnStyle, Paths, TextColumn};
use guideway_scene::{Edit, Insertion, PathState, Rgba, Scene, SceneOptions};
use guideway_spline::{Point, Runs};

/// More than a task of any stage holds.
const MANY: u32 = 40_000;

fn scene(paths: u32) -> Scene {
    let ids: Vec<String> = (0..paths).map(|row| row.to_string()).collect();
    let ids: TextColumn = ids.iter().map(String::as_str).collect();
    let points = (0..4 * paths).map(|at| Point::new(at as f32, 0.0));
    let ends = (1..=paths).map(|row| 4 * row);
    let geometry = Geometry::from_f32(points.collect(), ends.collect());
    let layout = Layout {
        paths: Paths::from_columns(ids, geometry),
        ..Layout::default()
    };
    Scene::new(Arc::new(layout), &SceneOptions::default()).expect("options that fit any layout")
}

/// Compares with a look at every path.
#[track_caller]
fn check(scene: &Scene) {
    let rows = 0..scene.row_count() as u32;
    let of = |state: PathState| rows.clone().filter(move |row| scene.state(*row) == state);
    let shown: Vec<u32> = of(PathState::Shown).collect();
    assert!(scene.draws_by_rows());
    assert_eq!(scene.draw_order(), shown);
    assert_eq!(scene.shown_count(), shown.len());
    assert_eq!(scene.hidden_count(), of(PathState::Hidden).count());
    let removed = of(PathState::Removed).count();
    assert_eq!(scene.path_count(), scene.row_count() - removed);
    let first = shown.first().map_or(Rgba::BLACK, |&row| scene.color(row));
    let is_common = shown.iter().all(|&row| scene.color(row) == first);
    assert_eq!(scene.common_color(), is_common.then_some(first));
    let widths = || shown.iter().filter_map(|&row| scene.width_m(row));
    let widest_m = widths().reduce(f32::max);
    let narrowest_m = widths().reduce(f32::min);
    assert_eq!(scene.own_widths_m(), narrowest_m.zip(widest_m));
    assert_eq!(scene.widest_m(), widest_m);
    assert_eq!(scene.is_plain(), is_common && widest_m.is_none());
    let is_opaque = rows.clone().all(|row| scene.color(row).is_opaque());
    assert_eq!(scene.is_opaque(), is_opaque);
}

fn styles(rows: impl Iterator<Item = u32>, style: impl Fn(u32) -> OwnStyle) -> Edit {
    Edit::Restyle(rows.map(|row| (row, style(row))).collect())
}

fn states(rows: impl Iterator<Item = u32>, state: PathState) -> Edit {
    Edit::SetStates(rows.map(|row| (row, state)).collect())
}

fn style(width_m: Option<f32>, color_rgba: Option<u32>) -> OwnStyle {
    OwnStyle {
        width_m,
        color_rgba,
    }
}

/// Edits of `count` paths that change what all paths have in common, and what they have not.
fn edits(count: u32) -> Vec<Edit> {
    let all = || 0..count;
    let some = |step: usize| (0..count).step_by(step);
    let (red, glass) = (0xff00_00ff, 0x2060_a080);
    let insertion = |width_m| {
        let mut runs = Runs::default();
        runs.push_line(Point::default(), Point::new(1.0, 1.0));
        Insertion {
            runs,
            style: style(width_m, None),
            ..Insertion::default()
        }
    };
    vec![
        states(some(3), PathState::Hidden),
        styles(some(6), |_| style(Some(0.3), Some(red))),
        states(some(3), PathState::Shown),
        styles(some(12), |row| style(Some(0.3 + row as f32), None)),
        states(some(12), PathState::Removed),
        // In no order, and twice: the last one counts.
        states(some(2).chain(all().rev()), PathState::Hidden),
        states(all().rev().chain(some(4)), PathState::Shown),
        styles(all(), |_| style(None, Some(red))),
        styles(std::iter::once(count - 1), |_| style(None, Some(glass))),
        states(std::iter::once(count - 1), PathState::Hidden),
        Edit::Insert([insertion(None), insertion(Some(0.7))].into()),
        states([count, count + 1].into_iter(), PathState::Removed),
        states(all(), PathState::Removed),
        styles(all(), |row| style(None, Some(row << 8 | 0xff))),
        states(some(2), PathState::Shown),
        styles(all().chain(all()), |_| style(None, None)),
    ]
}

#[test]
fn counts_follow_edits_of_few_and_many_paths() {
    for count in [9, MANY] {
        let mut scene = scene(count);
        check(&scene);
        let start = scene.clone();
        let mut undo = Vec::new();
        for edit in edits(count) {
            undo.push(scene.edit_with_undo(&edit, |_| {}).unwrap());
            check(&scene);
        }
        // Counts that nobody asked for in between.
        let mut quiet = scene.clone();
        for edit in undo.iter().rev() {
            scene.edit(edit).unwrap();
            check(&scene);
            quiet.edit(edit).unwrap();
        }
        check(&quiet);
        for row in 0..count {
            let look = |of: &Scene| (of.color(row), of.width_m(row), of.state(row));
            assert_eq!(look(&scene), look(&start), "{row}");
        }
    }
}
