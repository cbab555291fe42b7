//! Checks units and the shapes of entities: arcs, ellipses, polylines and splines.

use super::{LINE, assert_near, drawing, text, vertices};
use crate::common::{codes, ends, read};
use guideway_layout::Code;
use guideway_spline::Point;

#[test]
fn converts_units_to_meters() {
    for (code, meters) in [
        (1, 0.0254),
        (2, 0.3048),
        (4, 0.001),
        (5, 0.01),
        (6, 1.0),
        (0, 0.001),
    ] {
        let layout = read(&text(&format!(
            "0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1015\n9 $INSUNITS\n70 {code}\n0 ENDSEC\n\
             0 SECTION\n2 ENTITIES\n0 LINE\n5 A\n10 0\n20 0\n11 1000\n21 0\n0 ENDSEC\n0 EOF"
        )));
        assert_near(ends(&layout, "A").1, 1000.0 * meters, 0.0);
        assert_eq!(
            layout.diagnostics.count(Code::AssumedUnit),
            u64::from(code == 0)
        );
        assert_eq!(layout.provenance.format_version, "2000 (AC1015)");
    }
}

#[test]
fn arcs_are_counter_clockwise_in_their_own_plane() {
    let arc = "0 ARC\n5 A\n10 10\n20 0\n40 2\n50 0\n51 90\n";
    let (start, end) = ends(&drawing("", "", arc), "A");
    assert_near(start, 12.0, 0.0);
    assert_near(end, 10.0, 2.0);
    // A downward extrusion mirrors x, including the center.
    let (start, end) = ends(
        &drawing("", "", &format!("{arc}210 0\n220 0\n230 -1\n")),
        "A",
    );
    assert_near(start, -12.0, 0.0);
    assert_near(end, -10.0, 2.0);
    // From 350 to 10 degrees: 20 degrees through 0.
    let layout = drawing("", "", "0 ARC\n5 A\n10 0\n20 0\n40 1\n50 350\n51 10\n");
    assert!(vertices(&layout, "A").iter().all(|p| p.x > 0.98));
}

#[test]
fn reads_elliptical_arcs_and_full_ellipses() {
    let ellipse = "0 ELLIPSE\n5 A\n10 1\n20 1\n11 0\n21 4\n40 0.5\n41 0\n42 1.5707963267948966\n";
    let (start, end) = ends(&drawing("", "", ellipse), "A");
    assert_near(start, 1.0, 5.0);
    assert_near(end, -1.0, 1.0);
    let full = drawing("", "", "0 ELLIPSE\n5 A\n10 0\n20 0\n11 4\n21 0\n40 0.5\n");
    for point in vertices(&full, "A") {
        let value = (point.x / 4.0).powi(2) + (point.y / 2.0).powi(2);
        assert!((value - 1.0).abs() < 1e-4);
    }
}

#[test]
fn reads_bulges_as_arcs_and_closes_polylines() {
    let polyline = "0 LWPOLYLINE\n5 A\n90 2\n70 1\n10 0\n20 0\n42 1\n10 4\n20 0\n42 0\n";
    let layout = drawing("", "", polyline);
    let all = vertices(&layout, "A");
    assert_near(all[0], 0.0, 0.0);
    assert_near(all[all.len() - 1], 0.0, 0.0);
    // A bulge of 1 is a half circle to the right of the chord, which is below it.
    assert!(all.iter().all(|p| p.y <= 1e-9));
    let center = Point::new(2.0, 0.0);
    let on_arc = |p: &&Point<f64>| p.y < -1.5 && (p.distance(center) - 2.0).abs() < 1e-4;
    assert!(all.iter().find(on_arc).is_some());
    let old =
        "0 POLYLINE\n5 A\n66 1\n70 1\n0 VERTEX\n10 0\n20 0\n42 1\n0 VERTEX\n10 4\n20 0\n0 SEQEND\n";
    assert_eq!(vertices(&drawing("", "", old), "A"), all);
}

#[test]
fn reads_rational_splines_and_fit_points() {
    // A quarter of a circle.
    let layout = drawing(
        "",
        "",
        "0 SPLINE\n5 A\n70 12\n71 2\n40 0\n40 0\n40 0\n40 1\n40 1\n40 1\n\
         41 1\n41 0.7071067811865476\n41 1\n10 1\n20 0\n30 0\n10 1\n20 1\n30 0\n10 0\n20 1\n30 0\n",
    );
    assert_eq!(codes(&layout), []);
    for point in vertices(&layout, "A") {
        assert!((point.norm() - 1.0).abs() < 1e-4, "{point:?}");
    }
    let through =
        "0 SPLINE\n5 A\n70 8\n71 3\n11 0\n21 0\n31 0\n11 5\n21 5\n31 0\n11 10\n21 0\n31 0\n";
    let layout = drawing("", "", through);
    assert_eq!(codes(&layout), [Code::ApproximateShape]);
    let all = vertices(&layout, "A");
    assert_eq!(all.len(), 3);
    assert_near(all[1], 5.0, 5.0);
}

#[test]
fn limits_the_control_points_of_a_small_file() {
    // Half circles of the largest radius need the most control points.
    let bend = |i: usize| format!("10 {}\n20 0\n42 1\n", (i % 2) as f64 * 9e8);
    let vertices: String = (0..200_000).map(bend).collect();
    let polyline = format!("0 LWPOLYLINE\n5 A\n{vertices}");
    let layout = drawing("", "", &format!("{polyline}{LINE}"));
    assert_eq!((layout.paths.len(), layout.refused.len()), (0, 2));
    assert_eq!(codes(&layout), [Code::Implausible]);
    // A huge bulge exceeds the coordinate limit before any conversion.
    let bend = |i: usize| format!("10 {i}\n20 0\n42 1e300\n");
    let vertices: String = (0..200_000).map(bend).collect();
    let polyline = format!("0 LWPOLYLINE\n5 B\n{vertices}");
    let layout = drawing("", "", &format!("{polyline}{LINE}"));
    assert_eq!(
        (layout.paths.len(), codes(&layout)),
        (1, vec![Code::OutOfRange])
    );
}
