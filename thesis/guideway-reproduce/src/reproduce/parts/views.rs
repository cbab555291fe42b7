//! Tables 5.2 and 5.3 and figure 5.3: one scene from several views.

use guideway_scene::Scene;
use guideway_scene::{FrameSize, RenderError, View};
use guideway_spline::{Bounds, Point};

use crate::reproduce::lab::{Deadline, Lab};
use crate::reproduce::run::{Reading, Results};
use guideway_bench::Dataset;
use guideway_bench::zoomed_view;

/// Shares of pixels inside the box that the thesis measures at.
const SHARES: [f64; 3] = [0.0, 0.5, 1.0];
/// Magnifications of figure 5.3; at the least, everything is seen.
pub(crate) const MAGNIFICATIONS: [f64; 4] = [0.1, 0.5, 1.0, 2.0];

/// Frame times against the share of pixels inside the box of all curves.
pub(crate) fn occupancy(
    lab: &Lab<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let views = |scene: &Scene| {
        let Some(bounds) = scene.bounds() else {
            return Ok(Vec::new());
        };
        let view = |share| {
            let view = panned(lab.size, bounds, share)?;
            Ok((share_inside(&view, bounds), view))
        };
        SHARES.into_iter().map(view).collect()
    };
    sweep(
        lab,
        time,
        "pixels inside the grid",
        &mut out.occupancy,
        SHARES.len(),
        views,
    )
}

/// Frame times against magnification.
pub(crate) fn zoom(lab: &Lab<'_>, time: Deadline, out: &mut Results) -> Result<(), RenderError> {
    let views = |scene: &Scene| {
        let view = |magnification| Ok((magnification, magnified(lab.size, scene, magnification)?));
        MAGNIFICATIONS.into_iter().map(view).collect()
    };
    let count = MAGNIFICATIONS.len();
    sweep(lab, time, "magnification", &mut out.zoom, count, views)
}

fn sweep(
    lab: &Lab<'_>,
    time: Deadline,
    what: &str,
    rows: &mut Vec<Reading>,
    count: usize,
    views: impl Fn(&Scene) -> Result<Vec<(f64, View)>, RenderError>,
) -> Result<(), RenderError> {
    let paths = |dataset| lab.plan.view_paths(dataset);
    // The time runs out but once, so what a case lacks are its last views.
    let settled = |rows: &[Reading], (dataset, spec)| {
        Reading::settled(rows, dataset, paths(dataset), spec).min(count)
    };
    let mut open: Vec<_> = lab.cases().collect();
    open.retain(|&case| settled(rows, case) < count);
    let mut left = open.len();
    for dataset in Dataset::ALL {
        let open: Vec<_> = open.iter().filter(|case| case.0 == dataset).collect();
        if open.is_empty() {
            continue;
        }
        let scene = lab.scene(dataset, paths(dataset));
        let (places, views): (Vec<f64>, Vec<View>) = views(&scene)?.into_iter().unzip();
        for &&(_, spec) in &open {
            lab.tell(&format!("{what}: {spec} on {}", dataset.name()));
            let done = settled(rows, (dataset, spec));
            let outcomes = lab.measure_all(
                spec,
                &scene,
                views.get(done..).unwrap_or_default(),
                time.share(left),
            )?;
            for (&at, outcome) in places.iter().skip(done).zip(outcomes) {
                Reading::new(dataset, paths(dataset), at, spec, outcome).put(rows);
            }
            left -= 1;
        }
    }
    Ok(())
}

/// A view that the box fills, panned until only a share of it is inside.
fn panned(size: FrameSize, bounds: Bounds<f64>, share: f64) -> Result<View, RenderError> {
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let px_per_m = (width / bounds.size().x).max(height / bounds.size().y);
    let width_m = width / px_per_m;
    // The box's right edge moves from the picture's right edge to its left one.
    let center = Point::new(bounds.max.x + width_m * (0.5 - share), bounds.center().y);
    View::new(size, center, px_per_m)
}

/// Share of the pixels whose centers are inside the box.
fn share_inside(view: &View, bounds: Bounds<f64>) -> f64 {
    let size = view.size();
    let center_m =
        |x: u32, y: u32| view.world_from_pixel(Point::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
    let columns = (0..size.width())
        .filter(|&x| (bounds.min.x..=bounds.max.x).contains(&center_m(x, 0).x))
        .count();
    let rows = (0..size.height())
        .filter(|&y| (bounds.min.y..=bounds.max.y).contains(&center_m(0, y).y))
        .count();
    (columns * rows) as f64 / size.pixels() as f64
}

/// The view of a magnification. The thesis sees most of its dataset at 10 %; here it is all, and at any other
/// what is around the busiest place.
pub(crate) fn magnified(
    size: FrameSize,
    scene: &Scene,
    magnification: f64,
) -> Result<View, RenderError> {
    zoomed_view(size, scene, magnification / MAGNIFICATIONS[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panning_leaves_the_share_that_was_asked_for() {
        let size = FrameSize::new(200, 100).unwrap();
        for (width_m, height_m) in [(400.0, 100.0), (30.0, 300.0)] {
            let bounds = Bounds {
                min: Point::new(-7.0, 50.0),
                max: Point::new(-7.0 + width_m, 50.0 + height_m),
            };
            for share in SHARES {
                let view = panned(size, bounds, share).unwrap();
                assert!(
                    (share_inside(&view, bounds) - share).abs() < 0.006,
                    "{share}"
                );
            }
        }
    }

    #[test]
    fn everything_is_seen_at_ten_percent_and_some_path_at_any() {
        let scene = Dataset::D1.scene(3_000);
        let size = FrameSize::new(640, 360).unwrap();
        let all = magnified(size, &scene, 0.1).unwrap();
        let bounds = scene.bounds().unwrap();
        assert_eq!(
            share_inside(&panned(size, bounds, 1.0).unwrap(), bounds),
            1.0
        );
        assert!(all.world_bounds().contains(bounds.min));
        for magnification in MAGNIFICATIONS {
            let view = magnified(size, &scene, magnification).unwrap();
            let seen = view.world_bounds();
            let is_seen = |p: Bounds<f64>| p.intersects(seen);
            let mut hulls = scene.layout().paths.iter().filter_map(|p| p.hull_bounds());
            assert!(hulls.any(is_seen));
            let times = view.px_per_m() / all.px_per_m();
            assert!((times - magnification * 10.0).abs() < 1e-9);
        }
    }
}
