//! Zones: outlines of areas with a rule in gray, those that are convex with a pale tint.

use guideway_document::decorations::DecorationStyle;
use guideway_layout::Zone;
use guideway_scene::{DrawList, Scene, View};
use guideway_spline::Point;

/// Half the width of an outline, in points.
const HALF_WIDTH_POINTS: f64 = 0.75;
/// Opacity of outlines, of the color of texts.
const LINE_OPACITY: f64 = 0.55;
/// Opacity of the tint.
const TINT_OPACITY: f64 = 0.08;

/// The zones of the shown level.
pub(super) fn draw(scene: &Scene, view: &View, style: &DecorationStyle) -> DrawList {
    let mut list = DrawList::default();
    let zones = scene.layout().zones.iter();
    let shown = zones.filter(|zone| scene.shows_level(zone.level));
    let on_page = |zone: &Zone| -> Vec<Point<f64>> {
        let corners = zone.outline_m.iter();
        corners
            .map(|&corner| view.pixel_from_world(corner))
            .collect()
    };
    let outlines: Vec<_> = shown.map(on_page).collect();
    for outline in outlines.iter().filter(|outline| is_convex(outline)) {
        list.fill_polygon(style.ink.with_opacity(TINT_OPACITY), outline);
    }
    let line_color = style.ink.with_opacity(LINE_OPACITY);
    let half_px = HALF_WIDTH_POINTS * style.px_per_point;
    for outline in &outlines {
        let next = outline.iter().cycle().skip(1);
        for (&from, &to) in outline.iter().zip(next) {
            list.stroke_segment(line_color, [from, to], half_px);
        }
    }
    list
}

/// Returns `true` if all corners turn the same way, once around.
fn is_convex(outline: &[Point<f64>]) -> bool {
    let count = outline.len();
    let turn = |i: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| outline[(i + step) % count]);
        let (ab, bc) = (b - a, c - b);
        (ab.cross(bc), ab.dot(bc))
    };
    if count < 3 {
        return false;
    }
    let turns: Vec<(f64, f64)> = (0..count).map(turn).collect();
    let is_one_way = turns.iter().all(|(cross, _)| *cross >= 0.0)
        || turns.iter().all(|(cross, _)| *cross <= 0.0);
    let around: f64 = turns.iter().map(|(cross, dot)| cross.atan2(*dot)).sum();
    is_one_way && around.abs() < 1.5 * std::f64::consts::TAU
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use guideway_layout::{Layout, Zone};
    use guideway_scene::{FrameSize, Rgba, SceneOptions};

    use super::*;

    fn p(x: f64, y: f64) -> Point<f64> {
        Point::new(x, y)
    }

    #[test]
    fn convex_zones_have_a_tint_and_all_have_outlines() {
        let square = vec![p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)];
        let dent = vec![p(0.0, 0.0), p(2.0, 0.0), p(1.0, 0.5), p(0.0, 2.0)];
        let mut layout = Layout::default();
        for outline_m in [square, dent] {
            layout.zones.push(Zone {
                outline_m,
                ..Zone::default()
            });
        }
        let scene = Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap();
        let view = View::new(FrameSize::new(100, 100).unwrap(), p(1.0, 1.0), 20.0).unwrap();
        let list = draw(&scene, &view, &DecorationStyle::new(Rgba::WHITE, 1.0));
        let counts: Vec<_> = list.fills.iter().map(|fill| fill.polygons.len()).collect();
        assert_eq!(counts, [1, 8]);
    }

    #[test]
    fn a_star_that_winds_twice_is_not_convex() {
        let angle = |i: u32| f64::from(i * 2) * std::f64::consts::TAU / 5.0;
        let star: Vec<_> = (0..5).map(|i| p(angle(i).cos(), angle(i).sin())).collect();
        assert!(!is_convex(&star));
        assert!(!is_convex(&star[..2]));
    }
}
