//! Query language.

use guideway_document::{Column, PathSet, Query, QueryError};
use guideway_layout::Layout;
use guideway_scene::Table;

use crate::site::lanes;

fn rows(layout: &Layout, text: &str) -> Vec<u32> {
    let query = Query::parse(text, layout).unwrap_or_else(|error| panic!("{text}: {error}"));
    query.rows(layout).iter().collect()
}

#[test]
fn conditions_select_the_expected_paths() {
    let layout = lanes(6);
    for (text, expected) in [
        ("speed > 1", vec![3, 4, 5]),
        ("speed>=1.0", vec![2, 3, 4, 5]),
        ("speed < 0.5", vec![0]),
        ("speed <= 0.5", vec![0, 1]),
        ("speed = 1", vec![2]),
        ("speed != 1", vec![0, 1, 3, 4, 5]),
        ("zone = 'Hall A'", vec![0, 2, 4]),
        ("zone != \"Hall A\"", vec![1, 3, 5]),
        ("zone ~ hall and speed > 0", vec![2, 4]),
        ("not zone ~ a or id = path-2", vec![1, 2, 3, 5]),
        ("id = path-1 or id = path-3 and speed > 2", vec![1]),
        ("(id = path-1 or id = path-3) and speed > 1", vec![3]),
        ("direction = two-way", vec![0, 3]),
        ("vehicle_type = tug", vec![1]),
        ("vehicle_type != tug", vec![0, 2, 3, 4, 5]),
        ("length_m > 9.9 AND length_m < 10.1", vec![0, 1, 2, 3, 4, 5]),
        ("level = 1", vec![]),
    ] {
        assert_eq!(rows(&layout, text), expected, "{text}");
    }
}

#[test]
fn invalid_queries_name_position_and_remedy() {
    let layout = lanes(2);
    for (text, at, part) in [
        ("", 1, "expected a column"),
        ("spede > 1", 1, "speed"),
        ("speed", 6, "expected an operator"),
        ("speed >", 8, "expected a value"),
        ("speed > 1 id", 11, "`and` or `or`"),
        ("(speed > 1", 11, "parenthesis"),
        ("zone = 'Hall", 8, "not closed"),
        ("speed ! 1", 7, "expected an operator"),
    ] {
        let error: QueryError = Query::parse(text, &layout).unwrap_err();
        assert_eq!(error.at, at, "{text}: {error}");
        assert!(error.what.contains(part), "{text}: {error}");
    }
}

#[test]
fn rejects_deep_nesting_without_stack_overflow() {
    let layout = lanes(1);
    let deep = "(".repeat(100_000);
    assert!(
        Query::parse(&deep, &layout)
            .unwrap_err()
            .what
            .contains("deeper")
    );
    let nots = "not ".repeat(100_000) + "id = a";
    assert!(Query::parse(&nots, &layout).is_err());
    let wide = vec!["id = path-0"; 10_000].join(" or ");
    let query = Query::parse(&wide, &layout).unwrap();
    assert_eq!(query.rows(&layout), PathSet::from_iter([0]));
}

#[test]
fn nodes_and_stations_are_found_by_their_columns() {
    let layout = crate::site::square();
    let rows = |text: &str, of: Table| {
        let query = Query::parse_for(text, &layout, of).unwrap();
        query.rows(&layout).iter().collect::<Vec<u32>>()
    };
    assert_eq!(rows("x > 5", Table::Nodes), [1, 2]);
    assert_eq!(rows("y = 0 and id != a", Table::Nodes), [1]);
    assert_eq!(rows("vehicle_type = tug", Table::Nodes), [0, 1, 2, 3]);
    assert_eq!(rows("nodes ~ b", Table::Stations), [1]);
    assert_eq!(rows("start_node = b or end_node = b", Table::Paths), [0, 1]);
    let error = Query::parse_for("maxSpeed > 1", &layout, Table::Stations).unwrap_err();
    assert!(error.to_string().contains("nodes"), "{error}");
}

#[test]
fn rows_are_sorted_by_a_column() {
    let layout = lanes(12);
    let sorted = |column: Column, descending| {
        let mut rows: Vec<u32> = (0..12).collect();
        column.sort(&layout, Table::Paths, &mut rows, descending);
        rows
    };
    // By number, not letter by letter.
    assert!(sorted(Column::Id, false).is_sorted());
    let speed = Column::Attribute("speed".into());
    assert_eq!(sorted(speed.clone(), true)[..3], [11, 10, 9]);
    let zone = Column::Attribute("zone".into());
    let by_zone = sorted(zone, true);
    assert!(by_zone[..6].iter().all(|row| row.is_multiple_of(2)));
    assert!(
        by_zone[6..].iter().all(|row| !row.is_multiple_of(2)),
        "none is last"
    );
    assert_eq!(speed.unit(&layout, Table::Paths), None);
    assert_eq!(Column::Length.unit(&layout, Table::Paths), Some("m"));
    let names: Vec<String> = Column::all(&layout, Table::Paths)
        .iter()
        .map(|column| column.name().to_owned())
        .collect();
    assert_eq!(names[5..], ["start_node", "end_node", "speed", "zone"]);
}
