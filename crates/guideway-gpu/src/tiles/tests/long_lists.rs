//! Many strokes on few tiles: split lists, occlusion passes and loop limits.

use super::*;

#[test]
fn split_tiles_show_all_of_their_lines() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(3000, 0.5);
    // All strokes lie in six tiles and do not fill them.
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
        let mut unsplit = prepared(&tiles, &scene);
        let (expected, _) = picture(&mut unsplit, &far, &style);
        assert!(unsplit.target.split_lists.is_none());
        for options in [
            GpuOptions {
                max_unsplit_list: Some(30),
                ..GpuOptions::default()
            },
            GpuOptions {
                max_unsplit_list: Some(30),
                without_subgroups: true,
                ..GpuOptions::default()
            },
            // More parts than the capacity.
            GpuOptions {
                max_unsplit_list: Some(2),
                ..GpuOptions::default()
            },
            // Every list exceeds the loop limit of one workgroup.
            GpuOptions {
                loops_per_thread: Some(4_096),
                ..GpuOptions::default()
            },
        ] {
            let mut split = prepared(&limited(options), &scene);
            for _ in 0..3 {
                let (frame, _) = picture(&mut split, &far, &style);
                assert!(frame.pixels() == expected.pixels(), "{options:?}");
            }
            assert!(split.target.split_lists.is_some(), "{options:?}");
        }
    }
}

#[test]
fn halves_windows_with_too_many_split_tiles() {
    let Some(tiles) = tiles() else { return };
    let limited_loops = limited(GpuOptions {
        loops_per_thread: Some(4_096),
        ..GpuOptions::default()
    });
    let size = FrameSize::new(320, 200).unwrap();
    let view = View::new(size, Point::new(50.0, 30.0), 3.0).unwrap();
    let (scene, style) = (crowd(), Style::default());
    let (expected, _) = picture(&mut prepared(&tiles, &scene), &view, &style);
    let mut halved = prepared(&limited_loops, &scene);
    for _ in 0..2 {
        let (frame, report) = picture(&mut halved, &view, &style);
        assert!(frame.pixels() == expected.pixels());
        assert!(report.bands > 1, "{report}");
    }
}

/// Horizontal lines that together cover the picture of [`all`], each repeated to fill four
/// clusters.
fn crowd() -> Arc<Scene> {
    let mut layout = Layout::default();
    for row in 0..34 {
        let mut runs = Runs::default();
        let y_m = -3.0 + 2.0 * f64::from(row);
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
fn occlusion_passes_do_not_change_the_picture() {
    let Some(tiles) = tiles() else { return };
    let style = Style {
        line_rule: LineRule::World {
            width_m: 4.0,
            min_px: 0.0,
            max_px: 8.0,
        },
        ..Style::default()
    };
    // All tiles full, all but a corner, and none.
    let corner = view([95.0, 55.0], 2.0);
    for (scene, view) in [
        (crowd(), all()),
        (crowd(), corner),
        (plain(3000, 8.0), all()),
    ] {
        let mut in_one_pass = prepared(&tiles, &scene);
        in_one_pass.target.reuses_frames = false;
        // Capacities that need no occlusion.
        let capacity = Capacity {
            lines: 1 << 18,
            references: 1 << 20,
            has_ranks: false,
        };
        in_one_pass.target.lines =
            Some(LineBuffers::new(&mut in_one_pass.device.memory, capacity).unwrap());
        let (expected, whole) = picture(&mut in_one_pass, &view, &style);
        let mut in_passes = prepared(&tiles, &scene);
        in_passes.target.occlusion.is_enabled = true;
        let (frame, some) = picture(&mut in_passes, &view, &style);
        assert!(frame.pixels() == expected.pixels());
        assert_eq!(some.drawn, whole.drawn);
        if view == all() && scene.row_count() > 3000 {
            assert_eq!(4 * some.lines, whole.lines);
        }
    }
}

#[test]
fn rejects_lists_that_exceed_the_loop_limit() {
    let Some(_) = tiles() else { return };
    // Opaque strokes hide most lines below them, translucent ones none.
    let limited_loops = limited(GpuOptions {
        loops_per_thread: Some(4_096),
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
        let mut prepared = prepared(&limited_loops, &scene);
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
