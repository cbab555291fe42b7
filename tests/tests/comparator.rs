//! Tests the picture comparison: it must accept equal pictures and reject every kind of wrong
//! picture.

use guideway_scene::{Frame, FrameSize};
use guideway_tests::BoxError;
use guideway_tests::compare::{Difference, Tolerance, check};
use guideway_tests::methods::draw_reference;
use guideway_tests::sketch::Sketch;

const RED: u32 = 0xd020_20ff;
const BLUE: u32 = 0x2040_d0ff;

/// A plain picture: three paths of two colors and two widths, nothing symmetric.
fn sketch() -> Sketch {
    Sketch::new(96, 64)
        .line((8.0, 52.0), (88.0, 20.0))
        .own_width(4.0)
        .color(RED)
        .curve(&[(-30.0, -20.0), (20.0, 50.0), (70.0, 44.0), (120.0, -30.0)])
        .own_width(2.0)
        .color(BLUE)
        .line((70.0, 6.0), (40.0, 60.0))
        .own_width(3.0)
        .color(RED)
}

fn picture(sketch: &Sketch) -> Frame {
    draw_reference(&sketch.build()).0
}

fn changed(change: impl Fn(usize, [u8; 4]) -> [u8; 4]) -> Frame {
    let mut frame = picture(&sketch());
    for (index, pixel) in frame.pixels_mut().iter_mut().enumerate() {
        *pixel = change(index, *pixel);
    }
    frame
}

/// The right picture with pixel (x, y) taken from `from(x, y)`.
fn moved(from: impl Fn(usize, usize) -> (usize, usize)) -> Frame {
    let right = picture(&sketch());
    let width = right.size().width() as usize;
    changed(|index, _| {
        let (x, y) = from(index % width, index / width);
        right.pixels()[y * width + x]
    })
}

fn compare(actual: &Frame) -> Result<Difference, BoxError> {
    check(&picture(&sketch()), actual, &Tolerance::STANDARD)
}

#[track_caller]
fn must_fail(actual: &Frame) {
    let outcome = compare(actual);
    assert!(outcome.is_err(), "passed: {outcome:?}");
}

#[test]
fn an_identical_picture_passes() {
    let difference = compare(&picture(&sketch())).unwrap();
    assert_eq!((difference.differing_pixels, difference.max_abs), (0, 0.0));
    assert_eq!(difference.share_within, 1.0);
}

#[test]
fn tiny_noise_passes() {
    let noisy = changed(|index, [r, g, b, a]| {
        let off = |c: u8| c.saturating_sub(u8::from(index % 3 == 0));
        [off(r), off(g), off(b), a]
    });
    let difference = compare(&noisy).unwrap();
    assert!(difference.mean_abs < 0.5 && difference.max_abs == 1.0);
}

#[test]
fn ignores_colors_of_transparent_pixels() {
    let nothing = |rgba: u32| picture(&Sketch::new(9, 9).background(rgba));
    let (black, white) = (nothing(0), nothing(0xffff_ff00));
    assert_ne!(black, white);
    assert!(check(&black, &white, &Tolerance::STANDARD).is_ok());
    let shown = nothing(0xffff_ff40);
    assert!(check(&white, &shown, &Tolerance::STANDARD).is_err());
}

#[test]
fn measures_a_known_difference() {
    let other = changed(|index, [r, g, b, a]| {
        let off = if index == 96 * 5 + 7 { 100 } else { 0 };
        [r, g.saturating_sub(off), b, a]
    });
    let difference = compare(&other).unwrap();
    assert_eq!(difference.worst, (7, 5));
    assert_eq!(difference.differing_pixels, 1);
    assert!((difference.mean_abs - 100.0 / (3.0 * 96.0 * 64.0)).abs() < 1e-12);
    assert!((difference.share_within - (1.0 - 1.0 / (96.0 * 64.0))).abs() < 1e-12);
}

#[test]
fn another_picture_fails() {
    let other = picture(
        &Sketch::new(96, 64)
            .line((4.0, 60.0), (90.0, 2.0))
            .width(3.0),
    );
    must_fail(&other);
    let swapped = check(&other, &picture(&sketch()), &Tolerance::STANDARD);
    assert!(swapped.is_err(), "in the other direction");
}

#[test]
fn a_shift_by_one_pixel_fails() {
    must_fail(&moved(|x, y| (x.saturating_sub(1), y)));
    must_fail(&moved(|x, y| (x, (y + 1).min(63))));
}

#[test]
fn names_one_wrong_pixel() {
    let other = changed(|index, pixel| {
        if index == 96 * 3 + 2 {
            [255 - pixel[0], 255 - pixel[1], 255 - pixel[2], 255]
        } else {
            pixel
        }
    });
    let message = compare(&other).unwrap_err().to_string();
    assert!(message.contains("(2, 3) by 255"), "{message}");
    assert!(
        message.contains("expected [255, 255, 255, 255]"),
        "{message}"
    );
}

#[test]
fn two_pixels_in_a_thousand_off_by_forty_fail() {
    must_fail(&changed(|index, pixel| {
        let off = if index % 500 == 0 { 40 } else { 0 };
        pixel.map(|c| if c < 128 { c + off } else { c - off })
    }));
}

#[test]
fn a_uniform_offset_of_two_fails() {
    must_fail(&changed(|_, [r, g, b, a]| {
        let off = |c: u8| if c < 128 { c + 2 } else { c - 2 };
        [off(r), off(g), off(b), a]
    }));
}

#[test]
fn all_black_fails() {
    must_fail(&changed(|_, _| [0, 0, 0, 255]));
}

#[test]
fn all_white_fails() {
    must_fail(&changed(|_, _| [255; 4]));
}

#[test]
fn a_transparent_picture_fails() {
    must_fail(&changed(|_, [r, g, b, _]| [r, g, b, 0]));
}

#[test]
fn a_wrong_size_fails() {
    let other = Frame::new(FrameSize::new(64, 96).unwrap());
    let message = compare(&other).unwrap_err().to_string();
    assert!(message.contains("64 x 96, not 96 x 64"), "{message}");
}

#[test]
fn swapped_channels_fail() {
    must_fail(&changed(|_, [r, g, b, a]| [b, g, r, a]));
}

#[test]
fn a_missing_path_fails() {
    for missing in 0..3 {
        let rest: Vec<_> = (0..3).filter(|&i| i != missing).collect();
        must_fail(&picture(&sketch().reordered(&rest)));
    }
}

#[test]
fn a_wrong_draw_order_fails() {
    must_fail(&picture(&sketch().reordered(&[1, 0, 2])));
    must_fail(&picture(&sketch().reordered(&[0, 2, 1])));
}

#[test]
fn a_wrong_width_fails() {
    must_fail(&picture(&sketch().own_width(3.6)));
    must_fail(&picture(&sketch().own_width(2.4)));
}

#[test]
fn a_mirrored_picture_fails() {
    must_fail(&moved(|x, y| (x, 63 - y)));
    must_fail(&moved(|x, y| (95 - x, y)));
}
