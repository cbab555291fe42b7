//! Notes on a view that shows less than its reader expects: nothing, or levels over each other.

use guideway::compose::Rendered;
use guideway::layout::{Layout, shown_text};
use guideway::scene::Scene;
use guideway::spline::Bounds;

/// Notes on what a picture does not show.
pub(super) fn view_notes(scene: &Scene, rendered: &Rendered, has_level: bool) -> Vec<String> {
    let report = &rendered.report;
    if report.drawn == 0 && report.culled > 0 {
        return vec![away(scene.bounds())];
    }
    let hidden = (!has_level).then(|| hidden_levels(scene.layout()));
    hidden.flatten().into_iter().collect()
}

fn away(bounds: Option<Bounds<f64>>) -> String {
    let place = bounds.map_or_else(String::new, |b| {
        format!(
            "; they lie from ({:.1}, {:.1}) to ({:.1}, {:.1}) m",
            b.min.x, b.min.y, b.max.x, b.max.y
        )
    });
    format!("no path is in this view{place}: omit --center and --scale to see all of them")
}

/// Levels that lie one over the other are one drawing in which the lower one may be hidden.
fn hidden_levels(layout: &Layout) -> Option<String> {
    if layout.levels.len() < 2 {
        return None;
    }
    let mut bounds = vec![None::<Bounds<f64>>; layout.levels.len()];
    for path in layout.paths.iter() {
        let of_level = path.level().and_then(|l| bounds.get_mut(l as usize));
        if let Some(of_level) = of_level {
            let own = path.hull_bounds().into_iter();
            *of_level = own.chain(*of_level).reduce(Bounds::union);
        }
    }
    let drawn = layout.levels.iter().zip(bounds);
    let drawn: Vec<_> = drawn
        .filter_map(|(level, own)| Some((level, own?)))
        .collect();
    let is_over = drawn.iter().enumerate().any(|(at, (_, a))| {
        let others = &drawn[at + 1..];
        others.iter().any(|(_, b)| overlap(a, b) > 0.5)
    });
    if !is_over {
        return None;
    }
    let names = drawn.iter().map(|(level, _)| level.name_or_id());
    let names: Vec<String> = names.map(|name| shown_text(name).into_owned()).collect();
    Some(format!(
        "levels lie over each other: {}; `--level NAME` draws one, `--level each` all of them",
        names.join(", ")
    ))
}

/// The area that two boxes share, as a share of the smaller one.
fn overlap(a: &Bounds<f64>, b: &Bounds<f64>) -> f64 {
    let width = a.max.x.min(b.max.x) - a.min.x.max(b.min.x);
    let height = a.max.y.min(b.max.y) - a.min.y.max(b.min.y);
    let area = |bounds: &Bounds<f64>| bounds.size().x * bounds.size().y;
    let smaller = area(a).min(area(b));
    match width > 0.0 && height > 0.0 && smaller > 0.0 {
        true => width * height / smaller,
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use guideway::spline::Point;

    use super::*;

    #[test]
    fn overlap_is_a_share_of_the_smaller_box() {
        let bounds = |x: f64, y: f64, side: f64| Bounds {
            min: Point::new(x, y),
            max: Point::new(x + side, y + side),
        };
        let hall = bounds(0.0, 0.0, 10.0);
        assert_eq!(overlap(&hall, &bounds(2.0, 2.0, 4.0)), 1.0);
        assert_eq!(overlap(&hall, &bounds(8.0, 0.0, 4.0)), 0.5);
        assert_eq!(overlap(&hall, &bounds(11.0, 0.0, 4.0)), 0.0);
        assert_eq!(overlap(&hall, &bounds(1.0, 1.0, 0.0)), 0.0);
    }
}
