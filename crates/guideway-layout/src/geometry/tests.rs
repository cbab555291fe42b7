use guideway_spline::Affine;

use super::*;

fn points(from: usize, count: usize) -> Vec<Point<f64>> {
    (from..from + count)
        .map(|i| Point::new(i as f64, 0.5))
        .collect()
}

/// Paths of one run of 4, of runs of 5 and 4, and of one of 6.
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
fn a_path_takes_another_curve_and_the_others_stay() {
    let other = Geometry::from_f64(points(100, 13), vec![5, 9, 13]).with_path_ends(vec![2, 3]);
    for (path, from) in [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1)] {
        let mut geometry = three();
        geometry.replace(path, &other, from);
        let mut expected = shape(&three());
        expected[path] = shape(&other)[from].clone();
        assert_eq!(shape(&geometry), expected, "{path} takes {from}");
        // And back.
        geometry.replace(path, &three(), path);
        assert_eq!(shape(&geometry), shape(&three()));
    }
}

#[test]
fn many_paths_take_other_curves_as_one_after_the_other() {
    let other = Geometry::from_f64(points(100, 13), vec![5, 9, 13]).with_path_ends(vec![2, 3]);
    let narrow = points(0, 19).iter().map(|p| p.to_f32()).collect();
    let narrow = Geometry::from_f32(narrow, vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4]);
    for paths in [[2, 0], [1, 0], [1, 1]] {
        for mut geometry in [three(), narrow.clone()] {
            let mut one_by_one = geometry.clone();
            for (&path, from) in paths.iter().zip(0..) {
                one_by_one.replace(path as usize, &other, from);
            }
            geometry.replace_all(&paths, &other);
            assert_eq!(shape(&geometry), shape(&one_by_one), "{paths:?}");
        }
    }
}

#[test]
fn chosen_paths_are_copied_as_they_are() {
    let all = shape(&three());
    for rows in [&[2, 1][..], &[0, 1, 2], &[1, 2, 0], &[2, 2], &[]] {
        let some = shape(&three().select(rows.iter().copied()));
        let expected: Vec<_> = rows.iter().map(|&row| all[row].clone()).collect();
        assert_eq!(some, expected, "{rows:?}");
    }
}

#[test]
fn a_map_moves_one_path_in_either_precision() {
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
fn a_box_holds_the_points_of_some_paths() {
    let along_x = |rows: &[usize]| {
        let hull = three().hull_bounds(rows.iter().copied())?;
        Some((hull.min.x, hull.max.x))
    };
    assert_eq!(along_x(&[0, 1, 2]), Some((0.0, 18.0)));
    assert_eq!(along_x(&[1]), Some((4.0, 12.0)));
    assert_eq!(along_x(&[2, 0]), Some((0.0, 18.0)));
    assert_eq!(along_x(&[]), None);
}
