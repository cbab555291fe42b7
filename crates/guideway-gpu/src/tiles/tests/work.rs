//! Counts of work are exact, and stages are timed.

use guideway_scene::{Stage, Work};

use super::*;

/// Horizontal lines within one tile of 14 x 9, at 10 px per meter; in different colors if given
/// one.
fn horizontal_lines(count: usize, color_rgba: Option<u32>) -> Arc<Scene> {
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

/// 4 px wide at 10 px per meter.
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

/// Asserts that the method counts as many tests and words written.
#[track_caller]
fn assert_counts(work: &Work, tiles: &Tiles, scene: &Arc<Scene>, (view, style): (&View, &Style)) {
    let mut other = prepared(tiles, scene);
    let counted = other.count_work(view, style, &Cancel::default());
    let counted = counted.unwrap();
    assert_eq!(
        (counted.tests, counted.bytes_written),
        (work.tests, work.bytes_written)
    );
}

#[test]
fn counts_work_of_one_color_exactly() {
    let Some(tiles) = tiles() else { return };
    let style = wide();
    let view = view([10.5, 6.5], 10.0);
    for lines in [1, 2] {
        let scene = horizontal_lines(lines, None);
        let mut prepared = prepared(&tiles, &scene);
        let mut count = || prepared.count_work(&view, &style, &Cancel::default());
        let work = count().unwrap();
        let n = lines as u64;
        assert_eq!(work.tests, Some(n * 4 * u64::from(constants::SAMPLE_ROWS)));
        // The cluster and its paths; per line its block, its tile count and its reference; the
        // total of references and the longest list; the list entry.
        assert_eq!(work.atomics, Some(2 + n + 2 + n + 1));
        // The cluster, three words per line and per tile, references, pixels.
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
fn counts_equal_work_with_and_without_subgroups() {
    let Some(tiles) = tiles() else { return };
    let without_subgroups = limited(GpuOptions {
        without_subgroups: true,
        ..GpuOptions::default()
    });
    let view = view([10.5, 6.5], 10.0);
    for lines in [2, 3] {
        let scene = horizontal_lines(lines, Some(0x1020_30ff));
        let mut prepared = prepared(&tiles, &scene);
        let mut count = || prepared.count_work(&view, &wide(), &Cancel::default());
        let work = count().unwrap();
        assert_counts(&work, &without_subgroups, &scene, (&view, &wide()));
        let n = lines as u64;
        assert_eq!(work.tests, Some(n * 4 * u64::from(constants::SAMPLE_ROWS)));
        // As for one color, and the loop count of the tile.
        assert_eq!(work.atomics, Some(5 + 2 * n + 1));
        // As for one color; the rank of each line.
        let words = 1 + n * 3 + 3 * 14 * 9 + n + 210 * 130 + n;
        assert_eq!(work.bytes_written, Some(4 * words));
        assert_eq!(count().unwrap(), work);
    }
}

#[test]
fn counts_work_of_translucent_paths_exactly() {
    let Some(tiles) = tiles() else { return };
    let view = view([10.5, 6.5], 10.0);
    let mut read = Vec::new();
    for lines in [1, 2] {
        let scene = horizontal_lines(lines, Some(0x1020_3080));
        let mut prepared = prepared(&tiles, &scene);
        let mut count = || prepared.count_work(&view, &wide(), &Cancel::default());
        let work = count().unwrap();
        let n = lines as u64;
        assert_eq!(work.tests, Some(n * 4 * u64::from(constants::SAMPLE_ROWS)));
        // As for one color, and the loop count of the tile.
        assert_eq!(work.atomics, Some(5 + 2 * n + 1));
        // As for one color; the rank of each line; a sorted list.
        let sorted = if n > 1 { n } else { 0 };
        let words = 1 + n * 3 + 3 * 14 * 9 + n + 210 * 130 + n + sorted;
        assert_eq!(work.bytes_written, Some(4 * words));
        read.push(work.bytes_read);
        assert_eq!(count().unwrap(), work);
    }
    // Sorting reads each rank by its reference, and the references again.
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
fn timing_stages_does_not_change_the_picture() {
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
            "offsets",
            "bin",
            "cover",
            Stage::READ_BACK
        ]
    );
}
