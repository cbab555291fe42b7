//! Frames that reuse the last picture equal fresh ones.

use std::sync::Arc;

use guideway_layout::OwnStyle;
use guideway_scene::density::ToneMap;
use guideway_scene::{Budget, Edit, Frame, Insertion, PathState, Prepared, Shading, Style, View};
use guideway_spline::{Affine, Point, Runs};

use crate::cpu::Cpu;
use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::testing::*;

/// The view of a square of 200 m, panned by pixels to the right and down.
fn moved(px_per_m: f64, right_px: f64, down_px: f64) -> View {
    let center = Point::new(0.3 + right_px / px_per_m, -0.7 - down_px / px_per_m);
    view(center, px_per_m)
}

/// Densities of strokes of 1.5 px.
fn density(tone: ToneMap) -> Style {
    Style {
        shading: Shading::Density(tone),
        ..wide_px(1.5)
    }
}

/// Draws the next frame; returns whether it reused the last picture.
fn draw_again(prepared: &mut CpuPrepared, view: &View, style: &Style) -> (Frame, bool) {
    let (frame, _) = draw_with(prepared, view, style);
    (frame, prepared.has_reused())
}

#[test]
fn a_pan_by_whole_pixels_equals_a_fresh_frame() {
    let layout = || wandering(3000, 11, 3.0, ORIGIN);
    for (scene, style) in [
        (scene(layout()), Style::default()),
        (colored(layout(), |_| 255), wide_px(2.5)),
        (colored(layout(), |i| [255, 90][i % 2]), wide_px(1.5)),
        (scene(layout()), density(ToneMap::Equalized)),
    ] {
        for px_per_m in [0.3, 0.5] {
            let mut prepared = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
            let mut saved = Vec::new();
            for [right_px, down_px] in [
                [0.0, 0.0],
                [5.0, 0.0],
                [8.0, 2.0],
                [8.0, 45.0],
                [-31.0, 45.0],
                [-20.0, -60.0],
                [-20.5, -60.0],
                [-19.5, -60.0],
                [400.0, 0.0],
            ] {
                let view = moved(px_per_m, right_px, down_px);
                let (again, has_reused) = draw_again(&mut prepared, &view, &style);
                let (fresh, _) = draw(&Cpu, &scene, &view, &style, &Budget::default());
                assert!(again == fresh, "{px_per_m} {right_px} {down_px}");
                saved.push(has_reused);
            }
            // Two frames until pixels are stored, one pan by half a pixel, and one out of view.
            let expected = [false, false, true, true, true, true, false, false, false];
            assert_eq!(saved, expected);
        }
    }
}

#[test]
fn clipped_lines_equal_a_fresh_frame_after_a_pan() {
    let scene = scene(wandering(3000, 11, 3.0, ORIGIN));
    let style = wide_px(2.5);
    let mut prepared = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
    for [right_px, down_px] in [[0.0, 0.0], [0.0, 0.0], [5.0, 0.0], [9.0, -30.0]] {
        let view = moved(70.0, right_px, down_px);
        let (again, _) = draw_again(&mut prepared, &view, &style);
        let (fresh, _) = draw(&Cpu, &scene, &view, &style, &Budget::default());
        assert!(again == fresh, "{right_px} {down_px}");
    }
}

#[test]
fn an_edit_redraws_only_its_clusters_and_equals_a_fresh_frame() {
    for style in [Style::default(), density(ToneMap::Log)] {
        check_edits(&style);
    }
}

fn check_edits(style: &Style) {
    let before = scene(wandering(3000, 11, 3.0, ORIGIN));
    let view = view(ORIGIN, 0.5);
    let mut prepared = CpuPrepared::new(Arc::clone(&before), &Budget::default()).unwrap();
    let mut anew = CpuPrepared::new(before, &Budget::default()).unwrap();
    for _ in 0..2 {
        draw_again(&mut prepared, &view, style);
    }
    let mut runs = Runs::default();
    runs.push_line(Point::new(-80.0, -3.0), Point::new(70.0, 5.0));
    let inserted = Insertion {
        runs,
        ..Insertion::default()
    };
    let of = |width_m, color_rgba| OwnStyle {
        width_m,
        color_rgba,
    };
    let moved = |right_m, up_m, paths: Arc<[u32]>| {
        let by = Affine::translation(Point::new(right_m, up_m));
        Edit::Transform { paths, by }
    };
    let edits = [
        // Small moves keep the lines of other clusters; large ones do not.
        (moved(0.5, 0.25, Arc::new([3, 1700])), true),
        (moved(-0.25, 0.125, Arc::new([3, 4, 700])), true),
        (moved(4.0, -30.0, Arc::new([3, 1700])), true),
        (Edit::SetStates(Arc::new([(9, PathState::Hidden)])), true),
        (Edit::Insert(Arc::new([inserted])), true),
        // From one color to two, within two, and from one width to two.
        (
            Edit::Restyle(Arc::new([(3, of(None, Some(0xff00_40ff)))])),
            false,
        ),
        (
            Edit::Restyle(Arc::new([(4, of(None, Some(0x1f00_40ff)))])),
            true,
        ),
        (Edit::Restyle(Arc::new([(4, of(Some(9.0), None))])), false),
    ];
    for (edit, is_little) in edits {
        for prepared in [&mut prepared, &mut anew] {
            prepared.edit(&edit).unwrap();
        }
        let (again, has_reused) = draw_again(&mut prepared, &view, style);
        anew.forget_picture();
        let (fresh, _) = draw_again(&mut anew, &view, style);
        assert!(again == fresh, "{edit:?}");
        assert_eq!(has_reused, is_little, "{edit:?}");
    }
    // A pan right after an edit.
    let edit = Edit::SetStates(Arc::new([(9, PathState::Shown)]));
    for prepared in [&mut prepared, &mut anew] {
        prepared.edit(&edit).unwrap();
    }
    let view = self::view(Point::new(10.0, 0.0), 0.5);
    let (again, has_reused) = draw_again(&mut prepared, &view, style);
    anew.forget_picture();
    let (fresh, _) = draw_again(&mut anew, &view, style);
    assert!(again == fresh && has_reused);
}
