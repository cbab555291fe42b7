//! What a frame takes is counted to the last word, and timed.

use guideway_scene::{Stage, Work};

use super::*;

/// Level lines within one tile of 14 x 9, where 10 px are a meter; if they have colors, each another one.
fn level_lines(count: usize, color_rgba: Option<u32>) -> Arc<Scene> {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    runs.push_line(Point::new(2.2, 9.0), Point::new(2.8, 9.0));
    for _ in 0..count {
        let path = add(&mut layout, &runs);
        let style = OwnStyle {
            width_m: None,
            color_rgba: color_rgba.map(|color| color + ((path as u32) << 8)),
        };
        layout.paths.set_own_style(path, style);
    }
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

/// 4 px there.
fn wide() -> Style {
    Style {
        line_rule: LineRule::World {
            width_m: 0.4,
            min_px: 0.0,
            max_px: f64::INFINITY,
        },
        ..Style::default()
    }
}

/// Fails unless the kernels of this device count as many tests and words written.
#[track_caller]
fn assert_alike_here(
    work: &Work,
    tiles: &Tiles,
    scene: &Arc<Scene>,
    (view, style): (&View, &Style),
) {
    let mut here = prepared(tiles, scene);
    let here = here.count_work(view, style, &Cancel::default()).unwrap();
    assert_eq!(
        (here.tests, here.bytes_written),
        (work.tests, work.bytes_written)
    );
}

#[test]
fn work_is_counted_exactly() {
    let Some(tiles) = tiles() else { return };
    let hardware = as_hardware();
    let style = wide();
    let view = view([10.5, 6.5], 10.0);
    for lines in [1, 2] {
        let scene = level_lines(lines, None);
        let mut prepared = prepared(&hardware, &scene);
        let mut count = || prepared.count_work(&view, &style, &Cancel::default());
        let work = count().unwrap();
        assert_alike_here(&work, &tiles, &scene, (&view, &style));
        let n = lines as u64;
        assert_eq!(work.tests, Some(n * 4 * u64::from(params::SAMPLE_ROWS)));
        // The cluster and its paths; a line a workgroup; references and the longest list; a line in its tile; the list.
        assert_eq!(work.atomics, Some(2 + n + 2 + n + 1));
        // The cluster, a line, three words a tile, references, pixels.
        let words = 1 + n * 3 + 3 * 14 * 9 + n + 210 * 130;
        assert_eq!(work.bytes_written, Some(4 * words));
        assert!(work.bytes_read > Some(n * 4 * 6));
        assert_eq!(count().unwrap(), work);
    }
    let mut opaque = prepared(&tiles, &colors::opaque(layout(30, 3.0)));
    let mut count = || opaque.count_work(&all(), &style, &Cancel::default());
    let work = count().unwrap();
    assert!(work.tests > Some(30 * 16) && work.bytes_written > Some(4 * 210 * 130));
    assert_eq!(count().unwrap(), work);
}

#[test]
fn work_of_opaque_paths_is_counted_alike_by_teams_and_by_rows() {
    let Some(tiles) = tiles() else { return };
    let teams = as_hardware();
    let rows = limited(GpuOptions {
        without_lanes: true,
        ..GpuOptions::default()
    });
    let view = view([10.5, 6.5], 10.0);
    for lines in [2, 3] {
        let scene = level_lines(lines, Some(0x1020_30ff));
        let mut prepared = prepared(&teams, &scene);
        let mut count = || prepared.count_work(&view, &wide(), &Cancel::default());
        let work = count().unwrap();
        assert_alike_here(&work, &tiles, &scene, (&view, &wide()));
        assert_alike_here(&work, &rows, &scene, (&view, &wide()));
        let n = lines as u64;
        assert_eq!(work.tests, Some(n * 4 * u64::from(params::SAMPLE_ROWS)));
        // As of one color, and how long the one tile took.
        assert_eq!(work.atomics, Some(5 + 2 * n + 1));
        // As of one color; the rank of a line.
        let words = 1 + n * 3 + 3 * 14 * 9 + n + 210 * 130 + n;
        assert_eq!(work.bytes_written, Some(4 * words));
        assert_eq!(count().unwrap(), work);
    }
}

#[test]
fn work_of_translucent_paths_is_counted_exactly() {
    let Some(tiles) = tiles() else { return };
    let hardware = as_hardware();
    let view = view([10.5, 6.5], 10.0);
    let mut read = Vec::new();
    for lines in [1, 2] {
        let scene = level_lines(lines, Some(0x1020_3080));
        let mut prepared = prepared(&hardware, &scene);
        let mut count = || prepared.count_work(&view, &wide(), &Cancel::default());
        let work = count().unwrap();
        assert_alike_here(&work, &tiles, &scene, (&view, &wide()));
        let n = lines as u64;
        assert_eq!(work.tests, Some(n * 4 * u64::from(params::SAMPLE_ROWS)));
        // As of one color, and how long the one tile took.
        assert_eq!(work.atomics, Some(5 + 2 * n + 1));
        // As of one color; the rank of a line; a list that is brought into order.
        let sorted = if n > 1 { n } else { 0 };
        let words = 1 + n * 3 + 3 * 14 * 9 + n + 210 * 130 + n + sorted;
        assert_eq!(work.bytes_written, Some(4 * words));
        read.push(work.bytes_read);
        assert_eq!(count().unwrap(), work);
    }
    // Sorting reads a rank by its reference for each, and the references again.
    assert!(read[1] >= read[0].map(|bytes| bytes + 4 * 2 * 3));
    let mut mixed = prepared(&tiles, &mixed(30, 3.0));
    let work = mixed.count_work(&all(), &wide(), &Cancel::default());
    assert!(work.unwrap().tests > Some(30 * 16));
    let density = mixed.count_work(
        &all(),
        &style(Shading::Density(ToneMap::default())),
        &Cancel::default(),
    );
    assert_eq!(density.unwrap(), Work::default());
}

#[test]
fn stages_are_told_apart_where_that_is_asked_for_and_change_no_bit() {
    let Some(tiles) = tiles() else { return };
    let whole = Tiles::new(Arc::clone(&tiles.0.gpu), TilesOptions::default()).unwrap();
    let (scene, style) = (plain(300, 4.0), Style::default());
    let names = |report: &Report| {
        report
            .stages
            .iter()
            .map(|stage| stage.name)
            .collect::<Vec<_>>()
    };
    let (expected, apart) = picture(&mut prepared(&tiles, &scene), &all(), &style);
    let (frame, report) = picture(&mut prepared(&whole, &scene), &all(), &style);
    assert!(frame.pixels() == expected.pixels());
    assert_eq!(names(&report), ["draw", Stage::READ_BACK]);
    assert_eq!(
        names(&apart),
        [
            "cull",
            "flatten",
            "starts",
            "list",
            "cover",
            Stage::READ_BACK
        ]
    );
}
