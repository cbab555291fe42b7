//! Tables 5.2 and 5.3 and figure 5.3: measures one scene in several views.

use guideway_scene::{FrameSize, RenderError, Scene, View};
use guideway_spline::{Bounds, Point};

use crate::reproduce::deadline::Deadline;
use crate::reproduce::run::{Reading, Results};
use crate::reproduce::session::Session;
use guideway_bench::{Dataset, zoomed_view};

/// Shares of pixels inside the bounds of the scene, as in the thesis.
const SHARES: [f64; 3] = [0.0, 0.5, 1.0];
/// Magnifications of figure 5.3; the smallest shows the whole scene.
pub(crate) const MAGNIFICATIONS: [f64; 4] = [0.1, 0.5, 1.0, 2.0];

/// Measures frame times against the share of pixels inside the bounds of the scene.
pub(crate) fn occupancy(
    session: &Session<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let views = |scene: &Scene| {
        let Some(bounds) = scene.bounds() else {
            return Ok(Vec::new());
        };
        let view = |share| {
            let view = panned(session.size, bounds, share)?;
            Ok((share_inside(&view, bounds), view))
        };
        SHARES.into_iter().map(view).collect()
    };
    sweep(
        session,
        time,
        "pixels inside the grid",
        &mut out.occupancy,
        SHARES.len(),
        views,
    )
}

/// Measures frame times against magnification.
pub(crate) fn zoom(
    session: &Session<'_>,
    time: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let views = |scene: &Scene| {
        let view = |magnification| {
            Ok((
                magnification,
                magnified(session.size, scene, magnification)?,
            ))
        };
        MAGNIFICATIONS.into_iter().map(view).collect()
    };
    let count = MAGNIFICATIONS.len();
    sweep(session, time, "magnification", &mut out.zoom, count, views)
}

fn sweep(
    session: &Session<'_>,
    time: Deadline,
    axis: &str,
    rows: &mut Vec<Reading>,
    count: usize,
    views: impl Fn(&Scene) -> Result<Vec<(f64, View)>, RenderError>,
) -> Result<(), RenderError> {
    let paths = |dataset| session.plan.view_paths(dataset);
    // The time limit cuts a case once, so only its last views are missing.
    let settled = |rows: &[Reading], (dataset, spec)| {
        Reading::settled(rows, dataset, paths(dataset), spec).min(count)
    };
    let mut open: Vec<_> = session.cases().collect();
    open.retain(|&case| settled(rows, case) < count);
    let mut left = open.len();
    for dataset in Dataset::ALL {
        let open: Vec<_> = open.iter().filter(|case| case.0 == dataset).collect();
        if open.is_empty() {
            continue;
        }
        let scene = session.scene(dataset, paths(dataset));
        let (positions, views): (Vec<f64>, Vec<View>) = views(&scene)?.into_iter().unzip();
        for &&(_, spec) in &open {
            session.show_progress(&format!("{axis}: {spec} on {}", dataset.name()));
            let done = settled(rows, (dataset, spec));
            let outcomes = session.measure_all(
                spec,
                &scene,
                views.get(done..).unwrap_or_default(),
                None,
                time.share(left),
            )?;
            for (&at, outcome) in positions.iter().skip(done).zip(outcomes) {
                Reading::new(dataset, paths(dataset), at, spec, outcome).put(rows);
            }
            left -= 1;
        }
    }
    Ok(())
}

/// A view filled by the bounds, then panned right until `share` of its pixels is inside.
fn panned(size: FrameSize, bounds: Bounds<f64>, share: f64) -> Result<View, RenderError> {
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let px_per_m = (width / bounds.size().x).max(height / bounds.size().y);
    let width_m = width / px_per_m;
    // The right edge of the bounds moves from the right edge of the view to the left one.
    let center = Point::new(bounds.max.x + width_m * (0.5 - share), bounds.center().y);
    View::new(size, center, px_per_m)
}

/// Share of the pixels with their center inside the bounds.
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

/// The view at a magnification: the whole scene at 10 % (most of it in the thesis), otherwise the
/// part about its densest point.
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
    fn panned_view_has_the_requested_share_inside() {
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
    fn ten_percent_shows_all_paths_and_every_view_shows_one() {
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
