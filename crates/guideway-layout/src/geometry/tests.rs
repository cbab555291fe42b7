use guideway_spline::{Affine, Bounds, Point, Runs};

use super::{Geometry, append_hulls};
use crate::RunPoints;

fn points(from: usize, count: usize) -> Vec<Point<f64>> {
    (from..from + count)
        .map(|i| Point::new(i as f64, 0.5))
        .collect()
}

/// Three paths: one run of 4 points, runs of 5 and 4, one run of 6.
fn three() -> Geometry {
    Geometry::from_f64(points(0, 19), vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4])
}

fn shape(geometry: &Geometry) -> Vec<Vec<Vec<f64>>> {
    let run = |run: RunPoints<'_>| run.iter().map(|p| p.x).collect();
    (0..geometry.path_count())
        .map(|path| geometry.runs(path).map(run).collect())
        .collect()
}

#[test]
fn replacing_a_curve_leaves_the_other_paths_unchanged() {
    let other = Geometry::from_f64(points(100, 13), vec![5, 9, 13]).with_path_ends(vec![2, 3]);
    for (path, from) in [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1)] {
        let mut geometry = three();
        geometry.replace_all(&[path as u32], &other.select([from]));
        let mut expected = shape(&three());
        expected[path] = shape(&other)[from].clone();
        assert_eq!(shape(&geometry), expected, "path {path}, curve {from}");
        geometry.replace_all(&[path as u32], &three().select([path]));
        assert_eq!(shape(&geometry), shape(&three()));
    }
}

#[test]
fn replacing_many_curves_equals_single_replacements() {
    let other = Geometry::from_f64(points(100, 13), vec![5, 9, 13]).with_path_ends(vec![2, 3]);
    let narrow = points(0, 19).iter().map(|p| p.to_f32()).collect();
    let narrow = Geometry::from_f32(narrow, vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4]);
    for paths in [[2, 0], [1, 0], [1, 1]] {
        for mut geometry in [three(), narrow.clone()] {
            let mut one_by_one = geometry.clone();
            for (&path, from) in paths.iter().zip(0..) {
                one_by_one.replace_all(&[path], &other.select([from]));
            }
            geometry.replace_all(&paths, &other);
            assert_eq!(shape(&geometry), shape(&one_by_one), "{paths:?}");
        }
    }
}

#[test]
fn select_copies_paths_in_the_given_order() {
    let all = shape(&three());
    for rows in [&[2, 1][..], &[0, 1, 2], &[1, 2, 0], &[2, 2], &[]] {
        let some = shape(&three().select(rows.iter().copied()));
        let expected: Vec<_> = rows.iter().map(|&row| all[row].clone()).collect();
        assert_eq!(some, expected, "{rows:?}");
    }
}

#[test]
fn transform_maps_one_path_in_either_precision() {
    let by = Affine::translation(Point::new(10.0, 0.0));
    let narrow = points(0, 8).iter().map(|p| p.to_f32()).collect();
    for mut geometry in [
        Geometry::from_f64(points(0, 8), vec![4, 8]),
        Geometry::from_f32(narrow, vec![4, 8]),
    ] {
        geometry.transform([1], by);
        let x = [[0.0, 1.0, 2.0, 3.0], [14.0, 15.0, 16.0, 17.0]];
        assert_eq!(shape(&geometry), x.map(|run| vec![run.to_vec()]));
    }
}

#[test]
fn parallel_loops_equal_serial_ones() {
    let count = 3 * crate::run_points::POINTS_PER_TASK as u32;
    let wave = (0..count).map(|i| Point::new(f64::from(i) * 1e-3, f64::from(i).sin()));
    let wave: Vec<_> = wave.collect();
    let ends: Vec<u32> = (1..=count / 4).map(|path| path * 4).collect();
    let by = Affine::rotation(0.3, Point::new(7.0, -2.0));
    let narrow = wave.iter().map(|p| p.to_f32()).collect();
    for mut at_once in [
        Geometry::from_f64(wave.clone(), ends.clone()),
        Geometry::from_f32(narrow, ends.clone()),
    ] {
        let mut one_by_one = at_once.clone();
        let before = at_once.hull_bounds(0..ends.len()).unwrap();
        at_once.transform(0..ends.len(), by);
        // In reverse order, so that no two rows are consecutive.
        one_by_one.transform((0..ends.len()).rev(), by);
        assert_eq!(shape(&at_once), shape(&one_by_one));
        let hull = at_once.hull_bounds(0..ends.len()).unwrap();
        assert_eq!(one_by_one.hull_bounds((0..ends.len()).rev()), Some(hull));
        let mapped = at_once.mapped_bounds(before, by);
        assert!(mapped.contains(hull.min) && mapped.contains(hull.max));
        let rows: Vec<u32> = (0..ends.len() as u32).collect();
        at_once.replace_all(&rows, &Geometry::from_f64(wave.clone(), ends.clone()));
        for (row, points) in wave.chunks(4).enumerate() {
            let path = Geometry::from_f64(points.to_vec(), vec![4]);
            one_by_one.replace_all(&[row as u32], &path);
        }
        assert_eq!(shape(&at_once), shape(&one_by_one));
    }
}

#[test]
fn edits_keep_known_hulls_up_to_date() {
    let narrow = points(0, 19).iter().map(|p| p.to_f32()).collect();
    let narrow = Geometry::from_f32(narrow, vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4]);
    let other = Geometry::from_f64(points(100, 15), vec![5, 9, 15]).with_path_ends(vec![2, 3]);
    for start in [three(), narrow] {
        let of = |geometry: &Geometry, path: usize| geometry.hulls().of([path]);
        let mut edited = start.clone();
        let before = edited.hulls().clone();
        edited.transform([0, 2], Affine::translation(Point::new(0.0, 7.0)));
        assert!(edited.hulls.get().is_some());
        edited.replace_all(&[1, 2], &other);
        assert!(edited.hulls.get().is_some());
        let mut fresh = edited.clone();
        fresh.hulls.take();
        for path in 0..3 {
            assert_eq!(of(&edited, path), of(&fresh, path));
            assert_ne!(of(&edited, path), before.of([path]));
        }
        assert_eq!(edited.hulls().of_rows(&[0, 2]), fresh.hulls().of([0, 2]));
        // Another length.
        edited.replace_all(&[0], &other.select([1]));
        let hull = edited.hull_bounds([0]);
        assert_eq!(of(&edited, 0), hull);
    }
}

#[test]
fn finds_the_first_path_without_curve_or_out_of_range() {
    let far = |number: f64| {
        let mut points = points(0, 40);
        points[13].y = number;
        points[37].x = -number;
        let ends: Vec<u32> = (1..=10).map(|path| path * 4).collect();
        let wide = Geometry::from_f64(points.clone(), ends.clone());
        let narrow = points.iter().map(|p| p.to_f32()).collect();
        [wide, Geometry::from_f32(narrow, ends)].map(|all| all.first_out_of_range(100.0))
    };
    assert_eq!(far(100.0), [None; 2]);
    for number in [100.1, -100.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(far(number), [Some(3); 2], "{number}");
    }
    let empty = three().with_path_ends(vec![1, 1, 4]);
    assert_eq!(empty.first_out_of_range(100.0), Some(1));
}

proptest::proptest! {
    #[test]
    fn mapped_box_contains_mapped_points_exactly(
        xy in proptest::collection::vec(-1e4..1e4_f64, 16),
        map in proptest::array::uniform6(-2.0..2.0_f64),
        is_narrow: bool,
    ) {
        let points: Vec<_> = xy.chunks(2).map(|xy| Point::new(xy[0], xy[1])).collect();
        let [a, b, c, d, e, f] = map;
        let by = Affine {
            x: Point::new(a, b),
            y: Point::new(c, d),
            origin: Point::new(e * 1e5, f * 1e5),
        };
        let mut geometry = if is_narrow {
            let points = points.iter().map(|p| p.to_f32()).collect();
            Geometry::from_f32(points, vec![4, 8])
        } else {
            Geometry::from_f64(points, vec![4, 8])
        };
        let before = geometry.hull_bounds([0, 1]).unwrap();
        let moved = geometry.mapped_bounds(before, Affine::translation(by.origin));
        let mapped = geometry.mapped_bounds(before, by);
        let mut elsewhere = geometry.clone();
        elsewhere.transform([0, 1], Affine::translation(by.origin));
        proptest::prop_assert_eq!(elsewhere.hull_bounds([0, 1]), Some(moved));
        geometry.transform([0, 1], by);
        let hull = geometry.hull_bounds([0, 1]).unwrap();
        proptest::prop_assert!(mapped.contains(hull.min) && mapped.contains(hull.max));
    }
}

#[test]
fn hull_bounds_contain_the_points_of_some_paths() {
    let along_x = |rows: &[usize]| {
        let hull = three().hull_bounds(rows.iter().copied())?;
        Some((hull.min.x, hull.max.x))
    };
    assert_eq!(along_x(&[0, 1, 2]), Some((0.0, 18.0)));
    assert_eq!(along_x(&[1]), Some((4.0, 12.0)));
    assert_eq!(along_x(&[2, 0]), Some((0.0, 18.0)));
    assert_eq!(along_x(&[]), None);
}

#[test]
fn hulls_contain_the_points_of_all_runs() {
    let wide = three();
    let narrow = points(0, 19).iter().map(|p| p.to_f32()).collect();
    let narrow = Geometry::from_f32(narrow, vec![4, 9, 13, 19]);
    for geometry in [wide, narrow.with_path_ends(vec![1, 3, 4])] {
        let all = geometry.bounds();
        let hulls = geometry.hulls();
        assert_eq!(hulls.len(), 3);
        for rows in [&[0][..], &[1], &[2], &[2, 0], &[0, 1, 2], &[]] {
            let rows = || rows.iter().copied();
            assert_eq!(hulls.of(rows()), geometry.hull_bounds(rows()));
        }
        assert_eq!(hulls.all(), geometry.hull_bounds(0..3));
        assert_eq!((all, geometry.bounds()), (hulls.all(), hulls.all()));
    }
}

#[test]
fn path_without_points_has_no_hull() {
    let geometry = Geometry::from_f64(points(0, 4), vec![4]).with_path_ends(vec![0, 1, 1]);
    let hulls = geometry.hulls();
    assert_eq!((hulls.of([0]), hulls.of([0, 2])), (None, None));
    assert_eq!(hulls.of([0, 1]), geometry.hull_bounds([1]));
    assert_eq!(hulls.all(), hulls.of([1]));
    let none = Geometry::default();
    assert!(none.hulls().is_empty() && none.hulls().all().is_none());
}

#[test]
fn appended_hulls_are_valid_and_follow_every_change() {
    let has_valid_hulls = |geometry: &Geometry| {
        let hulls = geometry.hulls();
        let same = |row: usize| hulls.of([row]) == geometry.hull_bounds([row]);
        hulls.len() == geometry.path_count() && (0..hulls.len()).all(same)
    };
    let (points, ends) = (points(0, 19), [4, 9, 13, 19]);
    let mut boxes = Vec::new();
    for count in [1, 1, 4] {
        append_hulls(&mut boxes, &points, &ends[..count]);
        assert_eq!(boxes.len(), count);
    }
    let geometry = Geometry::from_f64(points, ends.to_vec()).with_hulls(boxes.into());
    assert!(has_valid_hulls(&geometry));
    let with_other_paths = geometry.clone().with_path_ends(vec![1, 3, 4]);
    let mut line = Runs::default();
    line.push_line(Point::new(0.0, 90.0), Point::new(50.0, 0.0));
    for mut geometry in [geometry, with_other_paths] {
        assert!(has_valid_hulls(&geometry));
        geometry.transform([1], Affine::translation(Point::new(0.0, 70.0)));
        assert!(has_valid_hulls(&geometry));
        geometry.replace_all(&[0], &three().select([2]));
        assert!(has_valid_hulls(&geometry));
        geometry.push(&line);
        assert!(has_valid_hulls(&geometry));
    }
}

#[test]
#[should_panic(expected = "left == right")]
fn rejects_hulls_of_another_path_count() {
    let boxes: Vec<Bounds<f64>> = Vec::new();
    let _ = three().with_hulls(boxes.into());
}

#[test]
fn paths_of_one_run_need_no_path_ends() {
    let single = || Geometry::from_f64(points(0, 8), vec![4, 8]);
    let double = || Geometry::from_f64(points(100, 9), vec![4, 9]).with_path_ends(vec![2]);
    let [first, second] = [0, 1].map(|row| shape(&single())[row].clone());
    let [both] = [0].map(|row| shape(&double())[row].clone());

    let mut lines = Runs::default();
    let counts = [1, 2, 0, 1];
    let mut pushed = single();
    for count in counts {
        lines.clear();
        (0..count).for_each(|_| lines.push_line(Point::new(0.0, 0.0), Point::new(9.0, 1.0)));
        pushed.push(&lines);
    }
    let runs = (0..pushed.path_count()).map(|path| pushed.runs(path).len());
    assert_eq!(runs.collect::<Vec<_>>(), [&[1, 1][..], &counts].concat());
    assert_eq!(shape(&pushed)[..2], [first.clone(), second.clone()]);

    let mut replaced = single();
    replaced.replace_all(&[0], &double());
    assert_eq!(shape(&replaced), [both.clone(), second.clone()]);
    replaced.replace_all(&[0], &single().select([0]));
    assert_eq!(shape(&replaced), [first.clone(), second]);
    let two = Geometry::from_f64([points(0, 4), points(100, 9)].concat(), vec![4, 8, 13]);
    let two = two.with_path_ends(vec![1, 3]);
    let mut exchanged = single();
    exchanged.replace_all(&[1, 0], &two);
    assert_eq!(shape(&exchanged), [both, first]);
}

#[test]
fn paths_that_meet_one_of_some_boxes_are_found_in_order() {
    // Points at x = 0 to 3, 4 to 12 and 13 to 18.
    let narrow = points(0, 19).iter().map(|p| p.to_f32()).collect();
    let narrow = Geometry::from_f32(narrow, vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4]);
    let query = |from: f64, to: f64, y: f64| Bounds {
        min: Point::new(from, y),
        max: Point::new(to, y + 0.5),
    };
    for geometry in [three(), narrow] {
        let meeting = |queries: &[Bounds<f64>]| geometry.hulls().meeting(queries);
        assert_eq!(meeting(&[query(12.0, 13.0, 0.2)]), [1, 2]);
        assert_eq!(
            meeting(&[query(18.0, 20.0, 0.0), query(0.0, 1.0, 0.5)]),
            [0, 2]
        );
        assert_eq!(meeting(&[query(12.1, 12.9, 0.2)]), []);
        assert_eq!(meeting(&[query(0.0, 20.0, 0.6)]), []);
        assert_eq!(meeting(&[]), []);
    }
}
