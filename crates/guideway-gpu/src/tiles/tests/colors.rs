//! Opaque paths in many colors: what lies on top is seen, however long the lists and whatever the ranks.

use super::*;

/// Paths with a color each, opaque, and some with a width.
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

/// A path that goes up and down very often, within a few meters, below some others and above most.
fn crowded_by_one() -> Layout {
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

/// Where one path, out of sight, is translucent, lists are sorted as a whole and drawn by another kernel.
#[test]
fn they_are_drawn_as_if_lists_were_sorted_as_a_whole() {
    let Some(tiles) = tiles() else { return };
    let far = view([50.0, 30.0], 0.5);
    for (name, layout, view) in [
        ("short lists", layout(600, 6.0), all()),
        ("long lists", layout(6000, 8.0), far),
        ("one path in most of a list", crowded_by_one(), all()),
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
            // Points are rounded otherwise where a scene is larger: a sample here and there.
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
