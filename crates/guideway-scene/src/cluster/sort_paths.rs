//! [`sort_paths`]: orders the paths of a layout along a Hilbert curve.

use guideway_layout::Layout;
use guideway_spline::Bounds;

use super::hilbert_order;

/// Sorts the paths of a layout along a Hilbert curve, and its nodes likewise, so that each part of
/// a file has elements near each other. Ranks keep the draw order: they count the paths in that
/// order.
///
/// Cost: O(n log n), and the memory of a second layout meanwhile.
pub fn sort_paths(layout: &mut Layout) {
    let paths = &mut layout.paths;
    let count = paths.len();
    let mut drawn: Vec<usize> = (0..count).collect();
    if let Some(ranks) = paths.rank() {
        drawn.sort_by_key(|&row| ranks[row]);
    }
    let mut ranks = vec![0; count];
    for (rank, row) in (0..).zip(drawn) {
        ranks[row] = rank;
    }
    paths.set_rank(ranks);
    let center = |row: usize| paths.get(row).hull_bounds().map(Bounds::center);
    let rows = hilbert_order(count, paths.hull_bounds(), center);
    layout.retain_paths(&wide(rows));
    layout.paths.set_hilbert_ordered();
    let nodes = &layout.nodes;
    let position = |row: usize| nodes.position_m(row as u32);
    let bounds = Bounds::of_points((0..nodes.len()).map(position));
    let rows = hilbert_order(nodes.len(), bounds, |row| Some(position(row)));
    let stations: Vec<usize> = (0..layout.stations.len()).collect();
    layout.retain_nodes_and_stations(&wide(rows), &stations);
}

fn wide(rows: Vec<u32>) -> Vec<usize> {
    rows.into_iter().map(|row| row as usize).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use guideway_layout::NewPath;
    use guideway_spline::{Point, Runs};

    use super::*;
    use crate::{Scene, SceneOptions};

    #[test]
    fn neighbors_follow_each_other_and_the_draw_order_stays() {
        let mut layout = Layout::default();
        // Columns of a grid, from left to right and back: the draw order is the order of the rows.
        for at in 0..1024_u32 {
            let (x, y) = (at * 37 % 32, at * 37 / 32 % 32);
            let mut runs = Runs::default();
            let from = Point::new(f64::from(x), f64::from(y));
            runs.push_line(from, from + Point::new(0.5, 0.5));
            let id = at.to_string();
            layout.paths.push(&NewPath {
                id: &id,
                runs: &runs,
                ..NewPath::default()
            });
        }
        let drawn = |layout: &Layout| {
            let scene = Scene::new(Arc::new(layout.clone()), &SceneOptions::default());
            let scene = scene.expect("a scene");
            let ids = scene.draw_order().iter();
            let ids = ids.map(|&row| scene.layout().paths.id(row as usize).to_owned());
            ids.collect::<Vec<_>>()
        };
        let steps = |layout: &Layout| {
            let centers: Vec<_> = layout
                .paths
                .iter()
                .filter_map(|p| p.hull_bounds())
                .collect();
            let steps = centers.windows(2);
            let steps = steps.map(|pair| pair[0].center().distance(pair[1].center()));
            steps.sum::<f64>()
        };
        let (before, far) = (drawn(&layout), steps(&layout));
        sort_paths(&mut layout);
        assert_eq!(drawn(&layout), before);
        assert!(steps(&layout) < far / 4.0, "{far} {}", steps(&layout));
        // Ranks of before count, too.
        let ranks: Vec<i32> = (0..1024).map(|row| -(row / 2)).collect();
        layout.paths.set_rank(ranks);
        let before = drawn(&layout);
        sort_paths(&mut layout);
        assert_eq!(drawn(&layout), before);
    }

    #[test]
    fn nodes_are_sorted_too_and_paths_keep_theirs() {
        let mut layout = Layout::default();
        let at = |number: u32| Point::new(f64::from(number * 37 % 32), f64::from(number % 29));
        for number in 0..512 {
            layout
                .nodes
                .push(&format!("node-{number}"), at(number), None);
            let mut runs = Runs::default();
            runs.push_line(at(number), at(number) + Point::new(1.0, 0.0));
            layout.paths.push(&NewPath {
                id: &format!("path-{number}"),
                runs: &runs,
                start_node: Some(number),
                ..NewPath::default()
            });
        }
        let steps = |layout: &Layout| {
            let positions = (0..511).map(|row| [row, row + 1].map(|n| layout.nodes.position_m(n)));
            positions.map(|[a, b]| a.distance(b)).sum::<f64>()
        };
        let far = steps(&layout);
        assert!(!layout.paths.is_hilbert_ordered());
        sort_paths(&mut layout);
        assert!(layout.paths.is_hilbert_ordered());
        assert!(steps(&layout) < far / 4.0, "{far} {}", steps(&layout));
        for path in layout.paths.iter() {
            let node = path.start_node().map(|node| layout.nodes.id(node));
            assert_eq!(node, Some(path.id().replace("path", "node").as_str()));
        }
    }
}
