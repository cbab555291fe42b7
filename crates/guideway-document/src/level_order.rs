//! The order of levels in lists: as the floors of a building.

use std::cmp::Ordering;

use guideway_layout::{Layout, Level};

use crate::query::natural_order;

/// The rows of the levels of a layout, the highest first. Those without a height come last, by
/// name: no format has another order of levels.
pub fn levels_by_height(layout: &Layout) -> Vec<u32> {
    let levels = &layout.levels;
    let mut rows: Vec<u32> = (0..levels.len() as u32).collect();
    rows.sort_by(|&a, &b| by_height(&levels[a as usize], &levels[b as usize]));
    rows
}

fn by_height(a: &Level, b: &Level) -> Ordering {
    let order = match (a.elevation_m, b.elevation_m) {
        (Some(a), Some(b)) => b.total_cmp(&a),
        (a, b) => b.is_some().cmp(&a.is_some()),
    };
    order.then_with(|| natural_order(a.name_or_id(), b.name_or_id()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_highest_level_is_the_first_and_those_without_a_height_the_last() {
        let level = |(id, elevation_m): (&str, Option<f64>)| Level {
            id: id.to_owned(),
            elevation_m,
            ..Level::default()
        };
        let all = [
            ("hall 10", None),
            ("ground", Some(0.0)),
            ("roof", Some(12.5)),
            ("hall 9", None),
            ("cellar", Some(-3.0)),
            ("gallery", Some(12.5)),
        ];
        let layout = Layout {
            levels: all.into_iter().map(level).collect(),
            ..Layout::default()
        };
        assert_eq!(levels_by_height(&layout), [5, 2, 1, 4, 3, 0]);
    }
}
