//! Index, hit test, search, findings and measurements.

use guideway_document::measure::{bends, tightest_radius_m};
use guideway_document::{Element, Index, locate, nearest, pick, search};
use guideway_layout::{Layout, NewPath, Place};
use guideway_scene::LineRule;
use guideway_spline::{Bounds, Runs};
use proptest::prelude::*;

use crate::site::{lanes, p, scene_of};

const RULE: LineRule = LineRule::World {
    width_m: 0.4,
    min_px: 1.0,
    max_px: 1000.0,
};

#[test]
fn index_finds_the_same_as_a_linear_scan() {
    let layout = lanes(200);
    let index = Index::new(&layout);
    proptest!(|(x in -5.0..15.0, y in -5.0..205.0, width in 0.0..20.0, height in 0.0..50.0)| {
        let bounds = Bounds { min: p(x, y), max: p(x + width, y + height) };
        let mut found: Vec<u32> = index.paths_in(bounds).collect();
        found.sort_unstable();
        let spans = |row: f64| x <= 10.0 && x + width >= 0.0 && y <= row && row <= y + height;
        let all: Vec<u32> = (0..200).filter(|&row| spans(f64::from(row))).collect();
        prop_assert_eq!(found, all);
        let mut nodes: Vec<u32> = index.nodes_in(bounds).collect();
        nodes.sort_unstable();
        let inside = |row: &u32| bounds.contains(p(0.0, f64::from(*row)));
        prop_assert_eq!(nodes, (0..200).filter(inside).collect::<Vec<u32>>());
    });
}

#[test]
fn picks_the_nearest_path_within_reach() {
    let scene = scene_of(lanes(5));
    let index = Index::new(scene.layout());
    let at = |x, y| pick((&scene, &index), RULE, 10.0, p(x, y), 4.0, usize::MAX);
    let hit = at(3.0, 2.3).unwrap();
    assert_eq!(hit.path, 2);
    assert!((hit.distance_m - 0.3).abs() < 1e-6, "{hit:?}");
    assert!(hit.point_m.distance(p(3.0, 2.0)) < 1e-6);
    assert_eq!(at(3.0, 2.5), None, "both are 5 px away");
    assert_eq!(at(-1.0, 2.0), None);
    let crowded = |most| pick((&scene, &index), RULE, 10.0, p(3.0, 2.0), 15.0, most);
    assert_eq!(crowded(2), None, "three are near");
    assert_eq!(crowded(3).map(|hit| hit.path), Some(2));
}

#[test]
fn picks_the_topmost_of_overlapping_paths() {
    let mut layout = lanes(1);
    let mut runs = Runs::default();
    runs.push_line(p(0.0, 0.05), p(10.0, 0.05));
    layout.paths.push(&NewPath {
        id: "over",
        runs: &runs,
        ..NewPath::default()
    });
    for (rank, top) in [(vec![0, 0], 1), (vec![5, 0], 0)] {
        let mut layout = layout.clone();
        layout.paths.set_rank(rank);
        let scene = scene_of(layout);
        let index = Index::new(scene.layout());
        // In one of the two cases the lower path is nearer.
        let hit = pick((&scene, &index), RULE, 100.0, p(5.0, 0.02), 6.0, usize::MAX).unwrap();
        assert_eq!(hit.path, top);
    }
}

#[test]
fn locates_findings_by_identifier_or_number() {
    let layout = lanes(12);
    for (element, expected) in [
        ("path \"path-7\"", Some(Element::Path(7))),
        ("node \"node-3\"", Some(Element::Node(3))),
        ("path number 12", Some(Element::Path(11))),
        ("path number 13", None),
        ("path number 0", None),
        ("station \"s\"", None),
        ("layouts[0].edges[3]", None),
    ] {
        assert_eq!(
            locate(&layout, &Place::element(element)),
            expected,
            "{element}"
        );
    }
}

#[test]
fn search_lists_exact_matches_first_up_to_the_limit() {
    let layout = lanes(30);
    let found = search(&layout, "path-1", 5);
    assert_eq!(found[0], Element::Path(1));
    assert_eq!(found.len(), 6, "five matches and the exact one");
    assert!(
        found
            .iter()
            .all(|element| element.id(&layout).contains("path-1"))
    );
    assert_eq!(search(&layout, "NODE-7", 5), [Element::Node(7)]);
    assert_eq!(search(&layout, "", 5), []);
}

#[test]
fn measures_length_and_radius_of_an_arc() {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    // A quarter circle with a radius of 5 m, accurate to 0.03 %.
    let k = 5.0 * 0.552_284_75;
    runs.push_bezier(&[p(5.0, 0.0), p(5.0, k), p(k, 5.0), p(0.0, 5.0)]);
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    let path = layout.paths.get(0);
    assert!((path.length_m() - 7.854).abs() < 0.01);
    let bends = bends(path);
    assert!((tightest_radius_m(&bends) - 5.0).abs() < 0.05);
    assert!(
        bends.iter().all(|bend| bend.curvature > 0.0),
        "it turns left"
    );
    assert!(bends.is_sorted_by(|a, b| a.along_m < b.along_m));
    let hit = nearest(&layout, 0, p(10.0, 10.0), 1e-6).unwrap();
    assert!(hit.point_m.distance(p(3.5355, 3.5355)) < 0.01);
    let straight = lanes(1);
    let bends = guideway_document::measure::bends(straight.paths.get(0));
    assert!(tightest_radius_m(&bends) > 1e6);
}
