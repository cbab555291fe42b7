//! Lines entered in cells without their radius lose coverage across the borders of cells; entered with it,
//! they do not.

use guideway_scene::{Budget, Frame};
use guideway_tests::compare::check;
use guideway_tests::devices::{SMOOTH_EDGES, grid, here};
use guideway_tests::methods::{draw, judge};
use guideway_tests::sketch::{Drawing, Sketch};

/// Side of the picture and of the grid's box.
const SIDE: u32 = 128;

/// Two cells along each side, of 64 pixels: one line just left of the border between them and one just below
/// it, both wide enough to reach over it. Two hairs in the corners make the box as large as the picture.
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
    let grid = here(grid(variant))?;
    let drawn = draw(&grid, drawing, &Budget::default());
    Some(drawn.expect("one color and one width").0)
}

#[test]
fn as_written_a_border_cuts_lines_and_with_the_radius_it_does_not() {
    let drawing = crossing_a_border();
    let (expected, _) = judge(&drawing);
    let Some(written) = picture("scan+cells=2", &drawing) else {
        return;
    };
    let Some(mended) = picture("scan+radius+cells=2", &drawing) else {
        return;
    };
    if let Err(message) = check(&expected, &mended, &SMOOTH_EDGES) {
        panic!("with the radius: {message}");
    }
    let lost = check(&expected, &written, &SMOOTH_EDGES);
    assert!(lost.is_err(), "the comparator sees no loss: {lost:?}");

    // Every pixel that differs has lost, all of them lie beyond the border, and within the radius of it.
    let mut lost = 0;
    for (index, (written, mended)) in written.pixels().iter().zip(mended.pixels()).enumerate() {
        if written == mended {
            continue;
        }
        let (x, y) = (index as u32 % SIDE, index as u32 / SIDE);
        assert!(written[0] > mended[0], "({x}, {y}) is darker as written");
        let is_right = (64..69).contains(&x);
        let is_above = (58..64).contains(&y) && x >= 64;
        // Of the box's border too, where the hairs in the corners are.
        let is_outside = [0, SIDE - 1].contains(&x) || [0, SIDE - 1].contains(&y);
        assert!(
            is_right || is_above || is_outside,
            "({x}, {y}) has lost too"
        );
        lost += 1;
    }
    assert!(lost > 300, "{lost} pixels have lost");
}

#[test]
fn the_loss_is_reported() {
    let drawing = crossing_a_border();
    for (variant, notes) in [("scan", 1), ("scan+radius", 0)] {
        let Some(grid) = here(grid(variant)) else {
            return;
        };
        let (_, report) = draw(&grid, &drawing, &Budget::default()).expect("it draws");
        assert_eq!(report.notes.len(), notes, "{:?}", report.notes);
    }
}
