//! Tests coverage at the borders of grid cells: lines entered without their radius lose coverage,
//! lines entered with it do not.

use guideway_scene::{Budget, Frame};
use guideway_tests::compare::check;
use guideway_tests::devices::{SMOOTH_EDGES, available_or_skip, grid};
use guideway_tests::methods::{draw, draw_reference};
use guideway_tests::sketch::{Drawing, Sketch};

/// Side of the picture and of the grid's box.
const SIDE: u32 = 128;

/// Two cells of 64 pixels along each side: one line just left of the border between them, one just
/// below it, both wide enough to cross it. Two hairs in the corners extend the box to the whole
/// picture.
fn crossing_a_border() -> Drawing {
    let side = f64::from(SIDE);
    Sketch::new(SIDE, SIDE)
        .width(8.0)
        .line((63.0, 8.0), (63.0, 120.0))
        .line((72.0, 63.5), (120.0, 63.5))
        .line((0.0, 0.0), (0.5, 0.0))
        .line((side - 0.5, side), (side, side))
        .build()
}

fn picture(variant: &str, drawing: &Drawing) -> Option<Frame> {
    let grid = available_or_skip(grid(variant))?;
    let drawn = draw(&grid, drawing, &Budget::default());
    Some(drawn.expect("one color and one width").0)
}

#[test]
fn lines_lose_coverage_at_cell_borders_without_the_radius_only() {
    let drawing = crossing_a_border();
    let (expected, _) = draw_reference(&drawing);
    let Some(written) = picture("scan+cells=2", &drawing) else {
        return;
    };
    let Some(with_radius) = picture("scan+radius+cells=2", &drawing) else {
        return;
    };
    if let Err(message) = check(&expected, &with_radius, &SMOOTH_EDGES) {
        panic!("with radius: {message}");
    }
    let lost = check(&expected, &written, &SMOOTH_EDGES);
    assert!(lost.is_err(), "the comparison finds no loss: {lost:?}");

    // Every different pixel lost coverage, beyond the border and within the radius.
    let mut lost = 0;
    for (index, (written, with_radius)) in written
        .pixels()
        .iter()
        .zip(with_radius.pixels())
        .enumerate()
    {
        if written == with_radius {
            continue;
        }
        let (x, y) = (index as u32 % SIDE, index as u32 / SIDE);
        assert!(
            written[0] > with_radius[0],
            "({x}, {y}) is darker as written"
        );
        let is_right = (64..69).contains(&x);
        let is_above = (58..64).contains(&y) && x >= 64;
        // The border of the box too, because of the hairs in the corners.
        let is_outside = [0, SIDE - 1].contains(&x) || [0, SIDE - 1].contains(&y);
        assert!(
            is_right || is_above || is_outside,
            "({x}, {y}) has lost coverage"
        );
        lost += 1;
    }
    assert!(lost > 300, "{lost} pixels have lost");
}

#[test]
fn the_report_notes_the_loss() {
    let drawing = crossing_a_border();
    for (variant, notes) in [("scan", 1), ("scan+radius", 0)] {
        let Some(grid) = available_or_skip(grid(variant)) else {
            return;
        };
        let (_, report) = draw(&grid, &drawing, &Budget::default()).expect("it draws");
        assert_eq!(report.notes.len(), notes, "{:?}", report.notes);
    }
}
