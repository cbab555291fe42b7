use guideway_document::{PathSet, Query, QueryError};
use guideway_layout::Layout;

use crate::site::lanes;

fn rows(layout: &Layout, text: &str) -> Vec<u32> {
    let query = Query::parse(text, layout).unwrap_or_else(|error| panic!("{text}: {error}"));
    query.rows(layout).iter().collect()
}

#[test]
fn conditions_mean_what_they_say() {
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
        ("direction = \"both ways\"", vec![0, 3]),
        ("vehicle_type = tug", vec![1]),
        ("vehicle_type != tug", vec![0, 2, 3, 4, 5]),
        ("length_m > 9.9 AND length_m < 10.1", vec![0, 1, 2, 3, 4, 5]),
        ("level = 1", vec![]),
    ] {
        assert_eq!(rows(&layout, text), expected, "{text}");
    }
}

#[test]
fn a_query_that_makes_no_sense_says_where_and_what_would() {
    let layout = lanes(2);
    for (text, at, part) in [
        ("", 1, "a column is expected"),
        ("spede > 1", 1, "speed"),
        ("speed", 6, "an operator"),
        ("speed >", 8, "a value"),
        ("speed > 1 id", 11, "`and` or `or`"),
        ("(speed > 1", 11, "parenthesis"),
        ("zone = 'Hall", 8, "not closed"),
        ("speed ! 1", 7, "an operator"),
    ] {
        let error: QueryError = Query::parse(text, &layout).unwrap_err();
        assert_eq!(error.at, at, "{text}: {error}");
        assert!(error.what.contains(part), "{text}: {error}");
    }
}

#[test]
fn no_text_is_too_deep_to_refuse() {
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
