//! Cached lines: the view alone decides which lines are drawn.

use guideway_scene::{Edit, Insertion, PathState};
use guideway_spline::Affine;

use super::*;
use crate::device::{DeviceBuffer, READBACK_USAGE};
use crate::tiles::frame::tile_buffers::TileBuffers;

/// Returns `true` if a frame was drawn from cached lines.
fn is_warm(report: &Report) -> bool {
    report.stages.iter().all(|stage| stage.name != "flatten")
}

#[test]
fn views_of_a_lod_share_lines_and_draw_the_same_picture() {
    let Some(tiles) = tiles() else { return };
    let density = style(Shading::Density(ToneMap::Log));
    for (scene, style) in [
        (plain(1500, 2.0), Style::default()),
        (mixed(1500, 2.0), Style::default()),
        (plain(1500, 2.0), density),
    ] {
        let mut cached = prepared(&tiles, &scene);
        let (mut warm, mut cold) = (0, 0);
        for step in 0..12 {
            // Zoom in and out beside the center, with shifts by fractions of a pixel.
            let along = 2.0 * f64::from(i32::abs(step - 6));
            let px_per_m = 3.0 * 1.02_f64.powf(along);
            let aside = 0.37 * f64::from(step % 3) / px_per_m;
            let view = view([41.0 + aside, 30.3 - aside], px_per_m);
            let (frame, report) = picture(&mut cached, &view, &style);
            let (expected, uncached) = picture(&mut prepared(&tiles, &scene), &view, &style);
            assert!(frame.pixels() == expected.pixels(), "{step}");
            assert!(!is_warm(&uncached));
            *if is_warm(&report) {
                &mut warm
            } else {
                &mut cold
            } += 1;
        }
        assert!(warm > cold && cold > 1, "{warm} {cold}");
    }
}

/// Moves, restyles, hides, inserts and shows paths.
fn edits() -> [Edit; 6] {
    let paths: Arc<[u32]> = (0..600).step_by(3).collect();
    let mut runs = Runs::default();
    runs.push_line(Point::new(10.0, 5.0), Point::new(90.0, 55.0));
    let insertion = Insertion {
        runs,
        ..Insertion::default()
    };
    let looks = |width_m| OwnStyle {
        width_m: Some(width_m),
        color_rgba: Some(0x2266_aaff),
    };
    let restyle =
        |width_m| Edit::Restyle(paths.iter().map(|&path| (path, looks(width_m))).collect());
    let states = |state| Edit::SetStates(paths.iter().map(|&path| (path, state)).collect());
    [
        Edit::Transform {
            paths: Arc::clone(&paths),
            by: Affine::translation(Point::new(0.5, -0.3)),
        },
        restyle(0.8),
        states(PathState::Hidden),
        Edit::Insert([insertion].into()),
        states(PathState::Shown),
        restyle(3.0),
    ]
}

#[test]
fn next_picture_shows_the_edit() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    for scene in [plain(600, 3.0), mixed(600, 3.0)] {
        // Both have the same history; the second reuses nothing.
        let (mut cached, mut uncached) = (prepared(&tiles, &scene), prepared(&tiles, &scene));
        uncached.target.reuses_frames = false;
        let mut warm = 0;
        let mut check = |cached: &mut PreparedTiles, uncached: &mut PreparedTiles, px_per_m| {
            let view = view([50.0, 30.0], px_per_m);
            let (frame, report) = picture(cached, &view, &style);
            let (expected, of_expected) = picture(uncached, &view, &style);
            assert!(frame.pixels() == expected.pixels());
            assert!(!is_warm(&of_expected));
            warm += usize::from(is_warm(&report));
            expected
        };
        let mut before = check(&mut cached, &mut uncached, 2.0);
        for edit in edits() {
            check(&mut cached, &mut uncached, 2.01);
            for prepared in [&mut cached, &mut uncached] {
                prepared.edit(&edit).unwrap();
            }
            let after = check(&mut cached, &mut uncached, 2.0);
            assert!(after != before, "{edit:?}");
            before = after;
        }
        assert!(warm >= 5, "{warm}");
    }
}

#[test]
fn draws_views_whose_lod_exceeds_the_line_buffers() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(3000, 2.0);
    let small = limited(GpuOptions {
        storage_binding_bytes: Some(32 << 10),
        ..GpuOptions::default()
    });
    let mut cached = prepared(&small, &scene);
    let mut warm = 0;
    for px_per_m in [2.0, 2.02, 20.0, 20.1, 20.2, 2.0] {
        let view = view([50.0, 30.0], px_per_m);
        let (frame, report) = picture(&mut cached, &view, &Style::default());
        let (expected, _) = picture(&mut prepared(&tiles, &scene), &view, &Style::default());
        assert!(frame.pixels() == expected.pixels());
        assert!(!is_warm(&report) || px_per_m > 10.0, "{report}");
        warm += usize::from(is_warm(&report));
    }
    // The lines of near views fit.
    assert!(warm > 0);
}

#[test]
fn reports_of_the_same_view_are_equal() {
    let Some(tiles) = tiles() else { return };
    let mut prepared = prepared(&tiles, &plain(3000, 4.0));
    let near = view([50.0, 30.0], 6.0);
    // The first picture grows the buffers.
    picture(&mut prepared, &near, &Style::default());
    let (first, of_first) = picture(&mut prepared, &near, &Style::default());
    for _ in 0..2 {
        let (again, report) = picture(&mut prepared, &near, &Style::default());
        assert!(is_warm(&report) && again.pixels() == first.pixels());
        assert_eq!(
            (report.drawn, report.lines),
            (of_first.drawn, of_first.lines)
        );
    }
}

#[test]
fn bins_again_after_a_list_exceeds_its_capacity() {
    let Some(tiles) = tiles() else { return };
    // A star whose center comes into view: lists are short at first and long then.
    let mut layout = layout(3000, 0.5);
    for path in 0..400 {
        let turn = f64::from(path);
        let mut runs = Runs::default();
        let end = Point::new(turn.cos(), turn.sin()) * 4.0;
        let center = Point::new(50.0, 30.0);
        runs.push_line(center + end * 0.02, center + end);
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap());
    let mut cached = prepared(&tiles, &scene);
    let mut at_once = Vec::new();
    for (x_m, px_per_m) in [
        (63.9, 10.3),
        (63.9, 10.2),
        (63.9, 10.1),
        (62.7, 8.8),
        (62.7, 8.9),
        (63.9, 10.3),
        (63.9, 10.2),
        (63.9, 10.1),
    ] {
        let view = view([x_m, 30.0], px_per_m);
        let (frame, report) = picture(&mut cached, &view, &Style::default());
        let (expected, _) = picture(&mut prepared(&tiles, &scene), &view, &Style::default());
        assert!(frame.pixels() == expected.pixels(), "{x_m}");
        let stages: Vec<_> = report.stages.iter().map(|stage| stage.name).collect();
        at_once.push(is_warm(&report) && !stages.contains(&"offsets"));
    }
    let (yes, no) = (true, false);
    // The first picture flattens, the fourth exceeds a list's capacity, and the sixth finds that
    // lists are short again.
    assert_eq!(at_once, [no, yes, yes, no, no, no, yes, yes]);
}

/// Reads a tile buffer back.
fn read_words(
    prepared: &mut PreparedTiles,
    of: impl Fn(&TileBuffers) -> &DeviceBuffer,
) -> Vec<u32> {
    let buffer = of(prepared.target.tiles.as_ref().unwrap());
    let bytes = buffer.bytes();
    let fetched = prepared
        .device
        .memory
        .zeros("words", bytes, READBACK_USAGE)
        .unwrap();
    let mut words = Vec::new();
    let take = |bytes: &[u8]| words.extend_from_slice(bytemuck::cast_slice(bytes));
    let taken = prepared
        .device
        .runner
        .fetch("words", buffer, &fetched, bytes, take);
    taken.unwrap();
    words
}

#[test]
fn counted_tiles_equal_listed_tiles() {
    let Some(tiles) = tiles() else { return };
    // With millions of lines on a graphics card: rounding that rarely differs shows there.
    let is_large = std::env::var("GUIDEWAY_LARGE_VIEWS").is_ok_and(|v| v == "1");
    let (paths, reach_m, [width, height], least_px_per_m) = if is_large {
        (200_000, 1.5, [1920, 1080], 18.0)
    } else {
        (2000, 9.0, [210, 130], 2.0)
    };
    let size = FrameSize::new(width, height).unwrap();
    let scene = plain(paths, reach_m);
    let thin = Style {
        line_rule: LineRule::Thesis,
        ..Style::default()
    };
    let mut prepared = prepared(&tiles, &scene);
    let mut warm = 0;
    for number in 0..60 {
        let f = f64::from(number / 2);
        let center = [40.0 + (f * 0.618).fract(), 20.0 + (f * 0.754).fract()];
        let nearer = (1.0 + (f * 0.377).fract()) * (1.0 + 0.003 * f64::from(number % 2));
        let center = Point::new(center[0], center[1]);
        let view = View::new(size, center, least_px_per_m * nearer).unwrap();
        // By both flatten kernels.
        prepared.target.has_few_clusters = number % 4 < 2;
        let (_, report) = picture(&mut prepared, &view, &thin);
        warm += usize::from(is_warm(&report));
        // Each list is filled exactly to its end. Tiles that were full before, by the highest bit,
        // list nothing.
        let lists = read_words(&mut prepared, |tiles| &tiles.tile_lists);
        let cursors = read_words(&mut prepared, |tiles| &tiles.list_cursors);
        let ends: Vec<u32> = lists.iter().skip(1).step_by(2).copied().collect();
        assert!(ends.iter().any(|&end| end > 0));
        let is_wrong = |(cursor, end): &(&u32, &u32)| **cursor >> 31 == 0 && cursor != end;
        let wrong = cursors.iter().zip(&ends).filter(is_wrong).count();
        assert_eq!(wrong, 0, "{number}: {report}");
    }
    assert!(warm > 10, "{warm}");
}
