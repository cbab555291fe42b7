//! Opaque paths in many colors: the topmost path is visible for any list length and any ranks.

use guideway_layout::Value;
use guideway_scene::{Edit, PathState, Rgba};

use super::*;

/// An opaque color for each path, a width for some.
fn colored(mut layout: Layout) -> Layout {
    for path in 0..layout.paths.len() as u32 {
        let style = OwnStyle {
            width_m: (path % 3 == 0).then_some(0.4),
            color_rgba: Some(path.wrapping_mul(0x9e37_79b9) | 0xff),
        };
        layout.paths.set_own_style(path as usize, style);
    }
    layout
}

fn scene(layout: Layout) -> Arc<Scene> {
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

pub(super) fn opaque(layout: Layout) -> Arc<Scene> {
    scene(colored(layout))
}

/// One path fills a few meters with very many segments, below some paths and above most.
fn dominated_by_one_path() -> Layout {
    let mut layout = layout(200, 6.0);
    let control: Vec<_> = (0..2000)
        .map(|i| {
            let f = f64::from(i);
            Point::new(
                50.0 + (f * 0.618_034).fract() * 7.0,
                30.0 + (f * 0.754_878).fract() * 7.0,
            )
        })
        .collect();
    let mut runs = Runs::default();
    runs.push(&control);
    add(&mut layout, &runs);
    for i in 0..40 {
        let at = 47.0 + f64::from(i) * 0.3;
        let mut runs = Runs::default();
        runs.push_line(Point::new(at, 25.0), Point::new(at - 4.0, 40.0));
        add(&mut layout, &runs);
    }
    layout
}

#[test]
fn walls_stay_below_the_ways_after_edits() {
    let Some(tiles) = tiles() else { return };
    let mut layout = layout(400, 6.0);
    for row in (1..400).step_by(2) {
        let attributes = &mut layout.paths.attributes;
        attributes.set(row, "element", Value::Text("wall"));
    }
    let options = SceneOptions {
        has_gray_structure: true,
        ..SceneOptions::default()
    };
    let walls = Scene::new(Arc::new(layout.clone()), &options).unwrap();
    // The same by ranks and own colors.
    let Rgba { r, g, b, a } = walls.color(1);
    let gray = OwnStyle {
        width_m: None,
        color_rgba: Some(u32::from_be_bytes([r, g, b, a])),
    };
    for row in 0..400 {
        layout.paths.set_path_rank(row, 1 - row as i32 % 2);
        if row % 2 == 1 {
            layout.paths.set_own_style(row, gray);
        }
    }
    let style = Style::default();
    let by_ranks = scene(layout);
    let (expected, _) = picture(&mut prepared(&tiles, &by_ranks), &all(), &style);
    let mut walls = prepared(&tiles, &Arc::new(walls));
    let mut pictures = vec![picture(&mut walls, &all(), &style).0];
    for state in [PathState::Hidden, PathState::Shown] {
        let edit = Edit::SetStates((0..9).map(|row| (row, state)).collect());
        walls.edit(&edit).unwrap();
        pictures.push(picture(&mut walls, &all(), &style).0);
    }
    assert!(pictures[0] == expected && pictures[2] == expected && pictures[1] != expected);
}

/// A translucent path out of sight makes the method sort whole lists and use another kernel.
#[test]
fn batches_draw_the_same_as_sorted_lists() {
    let Some(tiles) = tiles() else { return };
    let far = view([50.0, 30.0], 0.5);
    for (name, layout, view) in [
        ("short lists", layout(600, 6.0), all()),
        ("long lists", layout(3000, 8.0), far),
        ("one path in most of a list", dominated_by_one_path(), all()),
    ] {
        let layout = colored(layout);
        let mut beside = layout.clone();
        let mut runs = Runs::default();
        runs.push_line(Point::new(400.0, 0.0), Point::new(400.0, 1.0));
        let out_of_sight = add(&mut beside, &runs);
        let style = OwnStyle {
            width_m: None,
            color_rgba: Some(0x80),
        };
        beside.paths.set_own_style(out_of_sight, style);
        for line_rule in [LineRule::default(), LineRule::Thesis] {
            let style = Style {
                line_rule,
                ..Style::default()
            };
            let (frame, _) = picture(&mut prepared(&tiles, &scene(layout.clone())), &view, &style);
            let (other, _) = picture(&mut prepared(&tiles, &scene(beside.clone())), &view, &style);
            // A larger scene has larger quantization steps: single samples differ.
            let pairs = frame.pixels().iter().zip(other.pixels());
            let differ = pairs.filter(|(a, b)| (0..3).any(|i| a[i].abs_diff(b[i]) > 8));
            let (differ, drawn) = (differ.count(), view.size().pixels());
            assert!(
                1000 * differ <= drawn,
                "{name}, {line_rule:?}: {differ} of {drawn}"
            );
        }
    }
}
