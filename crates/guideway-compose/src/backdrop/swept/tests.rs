//! The cost of swept areas has a budget.

use guideway_envelope::Body;
use guideway_layout::NewPath;
use guideway_scene::FrameSize;
use guideway_spline::Runs;

use super::*;

/// Half turns of some centimeters: a long vehicle sweeps very many polygons along each.
fn half_turns(paths: usize) -> Layout {
    let mut layout = Layout::default();
    for i in 0..paths {
        let at = |x: f64, y: f64| Point::new(x + i as f64 * 1e-4, y);
        let mut runs = Runs::default();
        runs.push_bezier(&[at(0.0, 0.0), at(0.05, 0.0), at(0.05, 0.05), at(0.0, 0.05)]);
        layout.paths.push(&NewPath {
            id: &i.to_string(),
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout
}

fn visible(
    paths: usize,
    memory_bytes: u64,
    max_polygons: u64,
) -> Result<SweptReport, ComposeError> {
    let view = View::new(FrameSize::new(320, 200).unwrap(), Point::default(), 60.0).unwrap();
    let rows: Vec<u32> = (0..paths as u32).collect();
    let vehicle = EnvelopeSource::Vehicle(Body::vehicle(2.0, 1.2, 1.0));
    let budget = Budget {
        memory_bytes,
        ..Budget::default()
    };
    let limits = (&budget, max_polygons);
    let visible = VisibleAreas::within(&half_turns(paths), &rows, vehicle, &view, limits)?;
    Ok(visible.report)
}

#[test]
fn many_areas_are_coarser_instead_of_slower() {
    let finest_m = TOLERANCE_PX / 60.0;
    let few = visible(1, 1 << 30, MOST_POLYGONS).unwrap();
    assert!(
        (few.tolerance_m - finest_m).abs() < 1e-12 && few.polygons > 50,
        "{few:?}"
    );
    let half = 20 * few.polygons / 2;
    let many = visible(20, 1 << 30, half).unwrap();
    assert_eq!(many.drawn, 20);
    assert!(many.tolerance_m > finest_m, "{many:?}");
    assert!(
        many.polygons <= half && many.polygons > half / 8,
        "{many:?}"
    );
}

#[test]
fn memory_is_held_to_the_budget() {
    let little = visible(10, 200_000, MOST_POLYGONS).unwrap();
    assert!(little.tolerance_m > TOLERANCE_PX / 60.0, "{little:?}");
    let error = visible(10, 200, MOST_POLYGONS).unwrap_err();
    assert!(error.to_string().contains("swept areas"), "{error}");
}
