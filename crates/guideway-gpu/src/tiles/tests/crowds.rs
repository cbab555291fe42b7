//! Many strokes on few tiles.

use super::*;

#[test]
fn a_tile_that_several_workgroups_cover_shows_all_of_its_lines() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(3000, 0.5);
    // All in six tiles, which the strokes do not fill.
    let far = view([50.0, 30.0], 0.3);
    let thin = |width_px| Style {
        line_rule: LineRule::World {
            width_m: 0.0,
            min_px: width_px,
            max_px: width_px,
        },
        ..Style::default()
    };
    for style in [thin(0.5), thin(0.1)] {
        let mut alone = prepared(&tiles, &scene);
        let (expected, _) = picture(&mut alone, &far, &style);
        assert!(alone.easel.shares.is_none());
        for options in [
            GpuOptions {
                longest_alone: Some(60),
                ..GpuOptions::default()
            },
            GpuOptions {
                longest_alone: Some(60),
                without_lanes: true,
                ..GpuOptions::default()
            },
            // More parts than there is room for.
            GpuOptions {
                longest_alone: Some(2),
                ..GpuOptions::default()
            },
            // Not one of the lists may be gone through by one workgroup.
            GpuOptions {
                rounds_a_thread: Some(4_096),
                ..GpuOptions::default()
            },
        ] {
            let mut shared = prepared(&limited(options), &scene);
            for _ in 0..3 {
                let (frame, _) = picture(&mut shared, &far, &style);
                assert!(frame.pixels() == expected.pixels(), "{options:?}");
            }
            assert!(shared.easel.shares.is_some(), "{options:?}");
        }
    }
}

#[test]
fn where_too_many_tiles_would_have_to_be_shared_windows_are_halved() {
    let Some(tiles) = tiles() else { return };
    let impatient = limited(GpuOptions {
        rounds_a_thread: Some(4_096),
        as_hardware: true,
        ..GpuOptions::default()
    });
    let size = FrameSize::new(640, 400).unwrap();
    let view = View::new(size, Point::new(50.0, 30.0), 6.0).unwrap();
    let (scene, style) = (crowd(), Style::default());
    let (expected, _) = picture(&mut prepared(&tiles, &scene), &view, &style);
    let mut halved = prepared(&impatient, &scene);
    for _ in 0..2 {
        let (frame, report) = picture(&mut halved, &view, &style);
        assert!(frame.pixels() == expected.pixels());
        assert!(report.bands > 1, "{report}");
    }
}

/// Level lines that together cover the whole picture of [`all`], each so often that it fills four clusters.
fn crowd() -> Arc<Scene> {
    let mut layout = Layout::default();
    for level in 0..34 {
        let mut runs = Runs::default();
        let y_m = -3.0 + 2.0 * f64::from(level);
        runs.push_line(Point::new(-10.0, y_m), Point::new(110.0, y_m));
        for _ in 0..256 {
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
        }
    }
    Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
}

#[test]
fn what_is_hidden_is_left_out_and_changes_no_bit() {
    let Some(tiles) = tiles() else { return };
    let style = Style {
        line_rule: LineRule::World {
            width_m: 4.0,
            min_px: 0.0,
            max_px: 8.0,
        },
        ..Style::default()
    };
    // Where all is full but for a corner, and where nothing is.
    let corner = view([95.0, 55.0], 2.0);
    for (scene, view) in [
        (crowd(), all()),
        (crowd(), corner),
        (plain(3000, 8.0), all()),
    ] {
        let mut at_once = prepared(&tiles, &scene);
        at_once.easel.keeps = false;
        // So much that it need not look for what is hidden first.
        let room = Size {
            lines: 1 << 18,
            references: 1 << 20,
            has_ranks: false,
        };
        at_once.easel.room = Some(Room::new(&mut at_once.memory, room).unwrap());
        let (expected, whole) = picture(&mut at_once, &view, &style);
        let mut in_rounds = prepared(&tiles, &scene);
        in_rounds.easel.rounds.are_on = true;
        let (frame, some) = picture(&mut in_rounds, &view, &style);
        assert!(frame.pixels() == expected.pixels());
        assert_eq!(some.drawn, whole.drawn);
        if view == all() && scene.row_count() > 3000 {
            assert_eq!(4 * some.lines, whole.lines);
        }
    }
}

#[test]
fn lists_that_a_thread_may_not_finish_are_refused_by_name() {
    let Some(_) = tiles() else { return };
    // Opaque strokes hide most of what lies below them, translucent ones nothing.
    let impatient = limited(GpuOptions {
        rounds_a_thread: Some(4_096),
        ..GpuOptions::default()
    });
    let wide = Style {
        line_rule: LineRule::World {
            width_m: 200.0,
            min_px: 0.0,
            max_px: f64::INFINITY,
        },
        ..Style::default()
    };
    let cancel = Cancel::default();
    let mut translucent = layout(60, 0.5);
    for path in 0..60 {
        let style = OwnStyle {
            color_rgba: Some(0x3366_9940),
            ..OwnStyle::default()
        };
        translucent.paths.set_own_style(path, style);
    }
    let translucent = Scene::new(Arc::new(translucent), &SceneOptions::default()).unwrap();
    for (scene, is_drawn) in [(plain(60, 0.5), true), (Arc::new(translucent), false)] {
        let mut prepared = prepared(&impatient, &scene);
        let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
        let drawn = prepared.render(&all(), &wide, &cancel, &mut frame);
        match drawn {
            Err(RenderError::Unsupported { what, .. }) => {
                assert!(!is_drawn && what.contains("lines on"), "{what}");
            }
            other => assert!(is_drawn && other.is_ok(), "{other:?}"),
        }
        assert!(is_drawn || frame.pixels().iter().all(|p| *p == [0; 4]));
    }
}
