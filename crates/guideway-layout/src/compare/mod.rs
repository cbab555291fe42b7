//! Differences between two layouts: what a conversion lost, and what an engineer changed.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | match | identifiers, places and neighbors of two tables | pairs of rows, rows without a partner | `row_pairs`, `element_pairs`, `moved_pairs` |
//! | compare curves | two paths | greatest distance | `curve_distance` |
//! | compare columns | two tables, pairs of rows | differing cells by column | `columns`, `cells` |
//! | list changes | two layouts | [`Change`]s element by element | `changes`, `change` |
//! | write changes | a change | its values as text | `change_values` |
//! | compare tables | two layouts | [`Difference`]s | `paths`, `places`, `groups`, `difference` |

mod cells;
mod change;
mod change_values;
mod changes;
mod columns;
mod curve_distance;
mod difference;
mod element_pairs;
mod groups;
mod moved_pairs;
mod paths;
mod places;
mod row_pairs;

pub use self::change::{Change, ChangedValue, Changes, ElementChange, ElementChanges};
pub use self::change_values::ChangedTexts;
pub use self::changes::changes;
pub use self::difference::{CompareOptions, Difference};

use self::difference::Differences;
use self::row_pairs::RowPairs;
use crate::Layout;

/// Largest distance at which an element is at the same place, in meters: the coarsest step of the
/// formats.
const SAME_PLACE_M: f64 = 1e-3;

/// Compares two layouts. Returns what differs, by kind, in the order of the tables; nothing if they
/// mean the same.
///
/// Rows are matched by identifier, in order among equal ones; where no identifier of a table is
/// kept but most places are, by their order. Provenance, findings, places in the source text and
/// the order of columns do not count.
///
/// ```
/// use guideway_layout::{CompareOptions, Layout, differences};
/// use guideway_spline::Point;
///
/// let mut before = Layout::default();
/// before.nodes.push("dock", Point::new(0.0, 0.0), None);
/// let mut after = before.clone();
/// after.nodes.set_position_m(0, Point::new(0.0, 2.0));
/// let found = differences(&before, &after, &CompareOptions::default());
/// assert_eq!((found[0].what.as_str(), found[0].count), ("positions", 1));
/// ```
pub fn differences(a: &Layout, b: &Layout, options: &CompareOptions) -> Vec<Difference> {
    let mut found = Differences::default();
    let nodes = RowPairs::of(
        a.nodes.len(),
        b.nodes.len(),
        |row| a.nodes.id(row),
        |row| b.nodes.id(row),
        |row| a.nodes.position_m(row).distance(b.nodes.position_m(row)) <= SAME_PLACE_M,
    );
    let stations = RowPairs::of(
        a.stations.len(),
        b.stations.len(),
        |row| a.stations.id(row),
        |row| b.stations.id(row),
        |row| match (a.stations.position_m(row), b.stations.position_m(row)) {
            (Some(p), Some(q)) => p.distance(q) <= SAME_PLACE_M,
            _ => true,
        },
    );
    let rows = |layout: &Layout| layout.paths.len();
    let path_pairs = RowPairs::of(
        rows(a),
        rows(b),
        |row| a.paths.id(row as usize),
        |row| b.paths.id(row as usize),
        |row| paths::keeps_place([a, b], row as usize, SAME_PLACE_M),
    );
    paths::compare([a, b], &path_pairs, &nodes, options, &mut found);
    places::compare_nodes([a, b], &nodes, options, &mut found);
    places::compare_stations([a, b], &stations, &nodes, options, &mut found);
    let members = groups::MemberPairs {
        paths: &path_pairs,
        nodes: &nodes,
        stations: &stations,
    };
    groups::compare([a, b], &members, options, &mut found);
    found.into_vec()
}
