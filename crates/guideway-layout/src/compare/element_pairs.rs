//! Matches the elements of two layouts: by identifier, then by place.

use guideway_spline::Point;

use super::difference::CompareOptions;
use super::row_pairs::RowPairs;
use crate::Layout;

/// A place as a key: a position in steps of the tolerance.
pub(super) type PlaceKey = [i64; 2];

pub(super) fn place_key(position_m: Point<f64>, options: &CompareOptions) -> PlaceKey {
    // Coarser than the tolerance, so that rounding rarely separates equal places.
    let step_m = (options.tolerance_m * 16.0).max(1e-6);
    [position_m.x, position_m.y].map(|c| (c / step_m).round() as i64)
}

/// Returns the identifier of a level.
pub(super) fn level_id(layout: &Layout, level: Option<u32>) -> Option<&str> {
    Some(layout.levels.get(level? as usize)?.id.as_str())
}

/// Matches the nodes of two layouts.
pub(super) fn match_nodes<'a>([a, b]: [&'a Layout; 2], options: &CompareOptions) -> RowPairs {
    let mut pairs = RowPairs::by_id(
        a.nodes.len(),
        b.nodes.len(),
        |row| a.nodes.id(row),
        |row| b.nodes.id(row),
    );
    let key = |layout: &'a Layout, row: u32| {
        let level = level_id(layout, layout.nodes.level(row));
        Some((place_key(layout.nodes.position_m(row), options), level))
    };
    pairs.match_rest(|row| key(a, row), |row| key(b, row));
    pairs
}

/// Matches the stations of two layouts.
pub(super) fn match_stations<'a>([a, b]: [&'a Layout; 2], options: &CompareOptions) -> RowPairs {
    let mut pairs = RowPairs::by_id(
        a.stations.len(),
        b.stations.len(),
        |row| a.stations.id(row),
        |row| b.stations.id(row),
    );
    let key = |layout: &'a Layout, row: u32| {
        let level = level_id(layout, layout.stations.level(row));
        let position = layout.stations.position_m(row)?;
        Some((place_key(position, options), level))
    };
    pairs.match_rest(|row| key(a, row), |row| key(b, row));
    pairs
}

/// Matches the paths of two layouts.
pub(super) fn match_paths<'a>([a, b]: [&'a Layout; 2], options: &CompareOptions) -> RowPairs {
    let mut pairs = RowPairs::by_id(
        a.paths.len(),
        b.paths.len(),
        |row| a.paths.id(row as usize),
        |row| b.paths.id(row as usize),
    );
    let key = |layout: &'a Layout, row: u32| {
        let path = layout.paths.get(row as usize);
        let (start, end) = path.ends()?;
        let points: Vec<Point<f64>> = path
            .runs()
            .flat_map(|run| run.iter().collect::<Vec<_>>())
            .collect();
        let middle = points[points.len() / 2];
        let places = [start, middle, end].map(|p| place_key(p, options));
        Some((places, level_id(layout, path.level())))
    };
    pairs.match_rest(|row| key(a, row), |row| key(b, row));
    pairs
}
