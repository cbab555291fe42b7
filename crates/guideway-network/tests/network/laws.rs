//! Laws of `build` over random drawings.

use guideway_layout::Layout;
use guideway_network::{BuildOptions, Network};
use proptest::prelude::*;

use crate::sketch::{assert_ends_meet, drawing, edges_mm, network, split};

/// Lines between points of a coarse grid, each a little off its place.
fn lines() -> impl Strategy<Value = Vec<[f64; 4]>> {
    let coordinate =
        (0_i32..8, -10_i32..=10).prop_map(|(n, off)| f64::from(n) + f64::from(off) * 1e-3);
    prop::collection::vec(prop::array::uniform4(coordinate), 1..30)
}

/// Level and upright lines between points of a grid.
fn streets() -> impl Strategy<Value = Vec<[f64; 4]>> {
    let street =
        (any::<bool>(), 0_i32..8, 0_i32..8, 1_i32..8).prop_map(|(is_level, a, b, length)| {
            let [a, b, end] = [a, b, a + length].map(f64::from);
            if is_level {
                [a, b, end, b]
            } else {
                [b, a, b, end]
            }
        });
    prop::collection::vec(street, 1..30)
}

fn made(lines: &[[f64; 4]], options: &BuildOptions) -> Network {
    network(&drawing(lines), options)
}

fn length_m(layout: &Layout) -> f64 {
    let runs = layout.paths.iter().flat_map(|path| path.runs());
    runs.map(|run| guideway_spline::run_length(&run.iter().collect::<Vec<_>>(), 1e-6))
        .sum()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 64,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn edges_end_at_their_nodes(lines in lines()) {
        let made = made(&lines, &split());
        assert_ends_meet(&made.layout);
        let used: std::collections::HashSet<u32> = made.layout.paths.iter()
            .flat_map(|p| [p.start_node().unwrap(), p.end_node().unwrap()]).collect();
        prop_assert_eq!(used.len(), made.layout.nodes.len());
        prop_assert_eq!(made.report.edges, made.layout.paths.len() as u64);
    }

    #[test]
    fn without_splits_no_line_is_lost(lines in lines()) {
        let options = BuildOptions { split_junctions: false, split_crossings: false, ..split() };
        let made = made(&lines, &options);
        let report = &made.report;
        let kept = report.edges + report.vanished + report.repeated + report.dots;
        prop_assert_eq!(kept, lines.len() as u64);
        prop_assert!(report.largest_move_m <= 0.1);
    }

    #[test]
    fn a_network_is_built_to_itself(streets in streets()) {
        let once = made(&streets, &split());
        let twice = network(&once.layout, &split());
        prop_assert_eq!(edges_mm(&once.layout), edges_mm(&twice.layout));
        prop_assert!((length_m(&once.layout) - length_m(&twice.layout)).abs() < 1e-3);
    }
}
