//! Drawn lines, arcs and curves: nodes at their ends, tangents at nodes, properties of a template.

use guideway_document::{
    Document, Drawing, DrawnCurve, EdgeTemplate, PathSet, PropertyRef, ShapeError,
};
use guideway_layout::{Direction, Layout, Level, Value};
use guideway_scene::Table;
use guideway_spline::Point;
use guideway_spline::bezier::{end_direction, start_direction};
use guideway_spline::construct::ConstructError;
use guideway_spline::uniform::to_bezier;

use crate::site::{document_of, is_near, p};

fn empty() -> Document {
    document_of(Layout::default())
}

fn drawing(points_m: &[Point<f64>], curve: DrawnCurve) -> Drawing {
    Drawing {
        points_m: points_m.to_vec(),
        curve,
        template: EdgeTemplate::default(),
    }
}

/// Directions in which a path begins and ends.
fn tangents(document: &Document, row: usize) -> [Point<f64>; 2] {
    let path = document.layout().paths.get(row);
    let segments = path
        .runs()
        .flat_map(|run| run.segments().collect::<Vec<_>>());
    let beziers: Vec<_> = segments.map(|segment| to_bezier(&segment)).collect();
    [
        start_direction(&beziers[0]).expect("a curve with a length"),
        end_direction(&beziers[beziers.len() - 1]).expect("a curve with a length"),
    ]
}

fn ends(document: &Document, row: usize) -> [Option<u32>; 2] {
    let path = document.layout().paths.get(row);
    [path.start_node(), path.end_node()]
}

#[test]
fn lines_make_a_node_per_point_and_close_at_a_point_of_their_own() {
    let mut document = empty();
    // A double click gives the last point twice.
    let square = [
        p(0.0, 0.0),
        p(5.0, 0.0),
        p(5.0, 5.0),
        p(0.0, 0.0),
        p(0.0, 0.0),
    ];
    let new = document.draw(&drawing(&square, DrawnCurve::Lines)).unwrap();
    assert_eq!((new.paths.len(), new.nodes.len()), (3, 3));
    let all = [0, 1, 2].map(|row| ends(&document, row));
    assert_eq!(
        all,
        [[Some(0), Some(1)], [Some(1), Some(2)], [Some(2), Some(0)]]
    );
    assert_eq!(document.undo(), Some("draw"));
    assert_eq!(document.existing(Table::Nodes).count(), 0, "it is one step");
    document.redo();
    // The next line uses a node that is there.
    let spur = [p(5.0, 5.0), p(9.0, 5.0)];
    document.draw(&drawing(&spur, DrawnCurve::Lines)).unwrap();
    assert_eq!(ends(&document, 3), [Some(2), Some(3)]);
}

#[test]
fn paths_are_split_where_a_drawn_one_meets_them() {
    let mut document = empty();
    let lines = [p(0.0, 0.0), p(10.0, 0.0)];
    document.draw(&drawing(&lines, DrawnCurve::Lines)).unwrap();
    document
        .draw(&drawing(&[p(4.0, -3.0), p(4.0, 3.0)], DrawnCurve::Lines))
        .unwrap();
    assert_eq!(document.split_shown_at(p(7.0, 1.0)).unwrap(), None);
    assert_eq!(
        document.split_shown_at(p(10.0, 0.0)).unwrap(),
        None,
        "its end"
    );
    let node = document.split_shown_at(p(4.0, 0.0)).unwrap().unwrap();
    assert_eq!(document.existing(Table::Paths).count(), 4, "both paths");
    assert_eq!(document.index().paths_at(node).count(), 4);
    let spur = drawing(&[p(4.0, 0.0), p(6.0, 2.0)], DrawnCurve::Smooth);
    assert_eq!(spur.ends_m(), [p(4.0, 0.0), p(6.0, 2.0)]);
    document.draw(&spur).unwrap();
    assert_eq!(document.index().paths_at(node).count(), 5);
}

#[test]
fn arcs_lead_through_a_point_have_a_radius_or_continue_a_path() {
    let mut document = empty();
    let through = [p(0.0, 0.0), p(2.0, 0.0), p(1.0, -1.0)];
    document.draw(&drawing(&through, DrawnCurve::Arc)).unwrap();
    let [start, end] = tangents(&document, 0);
    assert!(
        is_near(start, p(0.0, -1.0)) && is_near(end, p(0.0, 1.0)),
        "half a circle"
    );
    let by_radius = [p(10.0, 0.0), p(12.0, 0.0)];
    for (radius_m, y) in [(1.0, -1.0), (-1.0, 1.0)] {
        let arc = document.preview(&drawing(&by_radius, DrawnCurve::ArcOfRadius(radius_m)));
        let middle = middle_of(&arc.unwrap());
        assert!(is_near(middle.unwrap(), p(11.0, y)), "{middle:?}");
    }
    let small = document.preview(&drawing(&by_radius, DrawnCurve::ArcOfRadius(0.9)));
    let Err(ShapeError::Curve { reason, .. }) = small else {
        panic!("the radius is too small");
    };
    assert!(matches!(
        reason,
        ConstructError::TooSmall { smallest: 1.0, .. }
    ));

    // An arc of two points goes on in the direction of the path at its start, or of that at its
    // end.
    let line = [p(20.0, 0.0), p(25.0, 0.0)];
    document.draw(&drawing(&line, DrawnCurve::Lines)).unwrap();
    let onward = [p(25.0, 0.0), p(27.0, 2.0)];
    let row = document.layout().paths.len();
    document.draw(&drawing(&onward, DrawnCurve::Arc)).unwrap();
    let [start, end] = tangents(&document, row);
    assert!(is_near(start, p(1.0, 0.0)) && is_near(end, p(0.0, 1.0)));
    let into = [p(18.0, -2.0), p(20.0, 0.0)];
    document.draw(&drawing(&into, DrawnCurve::Arc)).unwrap();
    let [start, end] = tangents(&document, row + 1);
    assert!(
        is_near(start, p(0.0, 1.0)) && is_near(end, p(1.0, 0.0)),
        "{start:?} {end:?}"
    );
    let alone = [p(0.0, 50.0), p(1.0, 51.0)];
    let refused = document.draw(&drawing(&alone, DrawnCurve::Arc));
    assert_eq!(refused.unwrap_err(), ShapeError::NoArc);
}

#[test]
fn curves_lead_through_their_points_and_on_from_the_path_at_their_start() {
    let mut document = empty();
    let line = [p(0.0, 0.0), p(5.0, 0.0)];
    document.draw(&drawing(&line, DrawnCurve::Lines)).unwrap();
    let points = [p(5.0, 0.0), p(8.0, 3.0), p(9.0, 7.0)];
    document
        .draw(&drawing(&points, DrawnCurve::Smooth))
        .unwrap();
    let nearest = guideway_document::nearest(document.layout(), 1, points[1], 1e-6).unwrap();
    assert!(nearest.distance_m < 1e-5, "{nearest:?}");
    let [start, _] = tangents(&document, 1);
    assert!(is_near(start, p(1.0, 0.0)), "{start:?}");
    assert_eq!(ends(&document, 1), [Some(1), Some(2)]);
    // One that leads back does not turn around in place.
    let back = [p(5.0, 0.0), p(2.0, 1.0)];
    document.draw(&drawing(&back, DrawnCurve::Smooth)).unwrap();
    let [start, _] = tangents(&document, 2);
    assert!(start.x < 0.0, "{start:?}");
}

#[test]
fn paths_get_the_properties_of_the_template_and_the_shown_level() {
    let level = |id: &str| Level {
        id: id.into(),
        ..Level::default()
    };
    let mut document = document_of(Layout {
        levels: vec![level("hall"), level("upper")],
        ..Layout::default()
    });
    let template = EdgeTemplate {
        direction: Direction::Both,
        max_speed: Some(1.0),
        vehicle_types: vec![("tugger".into(), Some(1.5)), ("stacker".into(), None)],
        ..EdgeTemplate::default()
    };
    let with_template = |points: [Point<f64>; 2]| Drawing {
        template: template.clone(),
        ..drawing(&points, DrawnCurve::Lines)
    };
    let first = with_template([p(0.0, 0.0), p(5.0, 0.0)]);
    document.draw(&first).unwrap();
    assert_eq!(
        document.template_of(0),
        EdgeTemplate {
            max_speed: None,
            vehicle_types: vec![("tugger".into(), Some(1.5)), ("stacker".into(), Some(1.0))],
            ..template.clone()
        }
    );
    let levels = |document: &Document, row: usize| {
        let path = document.layout().paths.get(row);
        let nodes = [path.start_node(), path.end_node()].map(Option::unwrap);
        let nodes = nodes.map(|node| document.layout().nodes.level(node));
        (path.level(), nodes)
    };
    assert_eq!(
        levels(&document, 0),
        (Some(0), [Some(0); 2]),
        "the first level"
    );
    document.show_level(Some(1));
    document
        .draw(&with_template([p(0.0, 0.0), p(0.0, 5.0)]))
        .unwrap();
    assert_eq!(
        levels(&document, 1),
        (Some(1), [Some(1); 2]),
        "no node of another level"
    );
    // Without a shown level, that of the node decides.
    document.show_level(None);
    document
        .draw(&with_template([p(0.0, 5.0), p(0.0, 9.0)]))
        .unwrap();
    assert_eq!(levels(&document, 2), (Some(1), [Some(1); 2]));
    // A speed for all types has no entries.
    let shared = Drawing {
        template: EdgeTemplate {
            max_speed: Some(0.7),
            ..EdgeTemplate::default()
        },
        ..drawing(&[p(9.0, 9.0), p(9.0, 12.0)], DrawnCurve::Lines)
    };
    document.draw(&shared).unwrap();
    let speed = document.layout().paths.attributes.value(3, "maxSpeed");
    assert_eq!(speed, Some(Value::Float(0.7)));
}

#[test]
fn template_takes_over_what_another_path_can_have() {
    let mut document = document_of(Layout::default());
    let line = [p(0.0, 0.0), p(5.0, 0.0)];
    let template = EdgeTemplate {
        vehicle_types: vec![("tugger".into(), None)],
        ..EdgeTemplate::default()
    };
    let first = Drawing {
        template,
        ..drawing(&line, DrawnCurve::Lines)
    };
    document.draw(&first).unwrap();
    let row: PathSet = [0].into_iter().collect();
    let mut set = |vehicle_type: Option<&str>, name: &str, value: Value<'_>| {
        let property = PropertyRef {
            of: Table::Paths,
            vehicle_type,
            name,
        };
        document.set_property(property, &row, Some(value)).unwrap();
    };
    set(None, "name", Value::Text("the first"));
    set(None, "length", Value::Float(5.0));
    set(None, "corridor.leftWidth", Value::Float(0.5));
    set(Some("tugger"), "rotationAllowed", Value::Bool(true));
    let template = document.template_of(0);
    assert_eq!(
        template.further_names(),
        ["corridor.leftWidth", "rotationAllowed"]
    );
    let second = |template: &EdgeTemplate, y: f64| Drawing {
        template: template.clone(),
        ..drawing(&[p(0.0, y), p(5.0, y)], DrawnCurve::Lines)
    };
    document.draw(&second(&template, 2.0)).unwrap();
    assert_eq!(document.template_of(1), template);
    for name in ["name", "length"] {
        assert_eq!(document.layout().paths.value(1, name), None, "{name}");
    }
    let plain = template.clone().without_further();
    assert!(plain.further_names().is_empty());
    document.draw(&second(&plain, 4.0)).unwrap();
    assert_eq!(document.layout().paths.value(2, "corridor.leftWidth"), None);
    // A type that was renamed keeps its properties, one that was removed takes them along.
    let mut other = template.clone();
    assert!(other.rename_type("tugger", "tractor") && !other.rename_type("tugger", "a"));
    document.draw(&second(&other, 6.0)).unwrap();
    assert_eq!(document.template_of(3), other);
    other.vehicle_types.clear();
    document.draw(&second(&other, 8.0)).unwrap();
    assert!(document.template_of(4).properties_of_types.is_empty());
}

/// The point halfway along the first path.
fn middle_of(layout: &Layout) -> Option<Point<f64>> {
    let path = layout.paths.get(0);
    path.point_at(path.length_m() / 2.0)
}

#[test]
fn bezier_curves_have_their_control_points_between_nodes() {
    let mut document = empty();
    let points = [
        p(0.0, 0.0),
        p(4.0, 0.0),
        p(8.0, 4.0),
        p(8.0, 8.0),
        p(8.0, 14.0),
        p(2.0, 14.0),
    ];
    let curves = drawing(&points, DrawnCurve::Bezier);
    assert_eq!(curves.ends_m(), [points[0], points[3], points[5]]);
    let new = document.draw(&curves).unwrap();
    assert_eq!((new.paths.len(), new.nodes.len()), (2, 3));
    let [start, end] = tangents(&document, 0);
    assert!(is_near(start, p(1.0, 0.0)) && is_near(end, p(0.0, 1.0)));
    // The last one is quadratic: both of its tangents meet at its only control point.
    let [start, end] = tangents(&document, 1);
    assert!(is_near(start, p(0.0, 1.0)) && is_near(end, p(-1.0, 0.0)));
    assert_eq!(ends(&document, 1), [Some(1), Some(2)]);
}
