//! Checks units and the shapes of entities: arcs, ellipses, polylines and splines.

use super::{LINE, assert_near, drawing, text, vertices};
use crate::common::{codes, ends, read};
use guideway_layout::{Code, Layout};
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

#[test]
fn hatches_are_outlines_unless_other_entities_draw_them() {
    let head = "0 HATCH\n5 H\n8 WALLS\n10 0\n20 0\n30 0\n2 SOLID\n70 1\n71 0\n";
    let tail = "75 0\n76 1\n98 1\n10 9\n20 9\n";
    let hatch = |boundaries: &str| drawing("", "", &format!("{head}{boundaries}{tail}"));
    let square = "92 7\n72 0\n73 1\n93 4\n10 0\n20 0\n10 2\n20 0\n10 2\n20 1\n10 0\n20 1\n";
    let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (0.0, 0.0)];
    let corners = corners.map(|(x, y)| Point::new(x, y));
    let layout = hatch(&format!("91 1\n{square}97 0\n"));
    assert_eq!(vertices(&layout, "H"), corners);
    assert_eq!(codes(&layout), []);
    let layer = layout.paths.value(0, "layer").unwrap().to_string();
    assert_eq!(layer, "WALLS");
    // A writer that repeats the first corner at the end.
    let repeated = square.replace("93 4", "93 5") + "10 0\n20 0\n97 0\n";
    assert_eq!(vertices(&hatch(&format!("91 1\n{repeated}")), "H"), corners);
    // Boundaries of other entities, and around texts.
    for drawn in [
        format!("91 1\n{square}97 1\n330 2F\n"),
        format!("91 1\n{}97 0\n", square.replace("92 7", "92 10")),
    ] {
        assert_eq!(hatch(&drawn).paths.len(), 0, "{drawn}");
    }
    // A disc of two bulges in a square of edges, one of them clockwise.
    let disc = "92 2\n72 1\n73 1\n93 2\n10 1\n20 0\n42 1\n10 3\n20 0\n42 1\n97 0\n";
    let edges = "92 1\n93 3\n72 1\n10 0\n20 0\n11 4\n21 0\n\
                 72 2\n10 4\n20 1\n40 1\n50 270\n51 90\n73 1\n\
                 72 1\n10 4\n20 2\n11 0\n21 0\n97 0\n";
    let layout = hatch(&format!("91 2\n{disc}{edges}"));
    assert_eq!(layout.paths.len(), 2);
    assert!((layout.paths.get(0).length_m() - std::f64::consts::TAU).abs() < 1e-4);
    let length = 4.0 + std::f64::consts::PI + 20.0_f64.sqrt();
    assert!((layout.paths.get(1).length_m() - length).abs() < 1e-4);
    let (start, end) = ends(&layout, "H [2]");
    assert_eq!(start, end);
    // Edges that other kinds of curves interrupt are paths of their own.
    let mixed = "91 1\n92 1\n93 3\n\
                 72 3\n10 0\n20 0\n11 2\n21 0\n40 0.5\n50 0\n51 90\n73 1\n\
                 72 2\n10 0\n20 0\n40 1\n50 270\n51 360\n73 0\n\
                 72 4\n94 1\n73 0\n74 0\n95 4\n96 2\n40 0\n40 0\n40 1\n40 1\n\
                 10 1\n20 0\n10 2\n20 0\n97 0\n97 0\n";
    let layout = hatch(mixed);
    let of = |id: &str| ends(&layout, id);
    let [x1, x2, y1] = [(1.0, 0.0), (2.0, 0.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
    for (id, from, to) in [("H [1]", x2, y1), ("H [2]", y1, x1), ("H [3]", x1, x2)] {
        let (start, end) = of(id);
        assert!(
            start.distance(from) < 1e-9 && end.distance(to) < 1e-9,
            "{id} {start:?} {end:?}"
        );
    }
    // Mirrored by its plane.
    let mirrored = format!("91 1\n{square}97 0\n210 0\n220 0\n230 -1\n");
    let mirrored = vertices(&hatch(&mirrored), "H");
    assert_eq!(mirrored, corners.map(|p| Point::new(-p.x, p.y)));
    // Without a number of boundaries.
    let broken = hatch(&format!("{square}97 0\n"));
    assert_eq!(codes(&broken), [Code::MissingField]);
}

#[test]
fn knots_count_where_the_closed_flag_contradicts_them() {
    let points = "10 0\n20 0\n10 4\n20 0\n10 4\n20 4\n10 0\n20 4\n10 -2\n20 2\n";
    let spline = |kind: &str, flags: i32, knots: &[i32], points: &str| {
        let knots: String = knots.iter().map(|knot| format!("40 {knot}\n")).collect();
        let entity = format!("0 {kind}\n5 A\n70 {flags}\n71 3\n{knots}{points}");
        drawing("", "", &entity)
    };
    let apart = |layout: &Layout| {
        let (start, end) = ends(layout, "A");
        start.distance(end)
    };
    let (clamped, period) = ([0, 0, 0, 0, 1, 2, 2, 2, 2], [0, 1, 2, 3, 4, 5]);
    // All knots are there: the curve is as without the flag, as AutoCAD and ezdxf draw it.
    let flagged = spline("SPLINE", 11, &clamped, points);
    let open = spline("SPLINE", 8, &clamped, points);
    assert_eq!(vertices(&flagged, "A"), vertices(&open, "A"));
    assert_eq!(codes(&flagged), [Code::Implausible]);
    assert_eq!(codes(&open), []);
    // One period without the flag, and none at all with it.
    let unflagged = spline("SPLINE", 8, &period, points);
    assert_eq!(
        vertices(&unflagged, "A"),
        vertices(&spline("SPLINE", 11, &period, points), "A")
    );
    assert!(codes(&unflagged).contains(&Code::BadKnots));
    let without_knots = spline("SPLINE", 1, &[], points);
    assert!(apart(&without_knots) < 1e-12);
    assert!(codes(&without_knots).contains(&Code::MissingKnots));
    // Control points that are repeated already, and ends that are one point.
    let wrapped = format!("{points}10 0\n20 0\n10 4\n20 0\n10 4\n20 4\n");
    let again = spline("SPLINE", 1, &[], &wrapped);
    for (a, b) in vertices(&again, "A")
        .iter()
        .zip(vertices(&without_knots, "A"))
    {
        assert!(a.distance(b) < 1e-12, "{a:?} {b:?}");
    }
    let met = spline(
        "SPLINE",
        1,
        &clamped,
        &points.replace("10 -2\n20 2", "10 0\n20 0"),
    );
    assert!(apart(&met) < 1e-12);
    assert_eq!(codes(&met), []);
    // A helix is a spline, and has points of its own behind that.
    let turns = "100 AcDbHelix\n10 9\n20 9\n11 9\n21 9\n12 0\n22 0\n32 1\n40 1\n41 3\n42 1\n";
    let helix = spline("HELIX", 0, &clamped, &format!("{points}{turns}"));
    assert_eq!(vertices(&helix, "A"), vertices(&open, "A"));
    // Fit points alone.
    let fit = "11 0\n21 0\n11 4\n21 0\n11 4\n21 4\n";
    assert!(apart(&spline("SPLINE", 1, &[], fit)) < 1e-12);
    assert!(apart(&spline("SPLINE", 0, &[], fit)) > 5.0);
}
