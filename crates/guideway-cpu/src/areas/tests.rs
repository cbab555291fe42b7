//! Areas against a test of every sample and polygon.

use guideway_scene::FrameSize;

use super::*;

const INK: Rgba = Rgba {
    r: 200,
    g: 40,
    b: 0,
    a: 128,
};

fn view(px_per_m: f64) -> View {
    View::new(
        FrameSize::new(70, 21).unwrap(),
        Point::new(1000.0, -7.0),
        px_per_m,
    )
    .unwrap()
}

fn drawn(areas: &Areas, view: &View) -> Frame {
    let mut frame = Frame::new(view.size());
    frame.pixels_mut().fill([255; 4]);
    lay_areas(areas, &Strip::whole(view), INK, &mut frame);
    frame
}

/// Sample by sample, polygon by polygon.
fn expected(areas: &Areas, view: &View) -> Vec<[u8; 4]> {
    let is_in = |corners: &[Point<f64>], p: Point<f64>| {
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            (b - a).cross(p - a)
        };
        let sides = || (0..corners.len()).map(side);
        // A point has no area.
        let has_area = corners.len() > 2;
        has_area && (sides().all(|s| s >= 0.0) || sides().all(|s| s <= 0.0))
    };
    let pixel = |x: u32, y: u32| {
        let samples = (0..256).filter(|i| {
            let at = |k: u32| (f64::from(k) + 0.5) / 16.0;
            let px = Point::new(f64::from(x) + at(i % 16), f64::from(y) + at(i / 16));
            let p = view.world_from_pixel(px);
            (0..areas.len())
                .any(|i| areas.outline(i).filter(|corners| is_in(corners, p)).count() % 2 == 1)
        });
        let a = samples.count() as f64 / 256.0 * 128.0 / 255.0;
        let mix = |v: f64| (v * a + 255.0 * (1.0 - a)).round() as u8;
        [mix(200.0), mix(40.0), mix(0.0), 255]
    };
    let rows = 0..view.size().height();
    rows.flat_map(|y| (0..view.size().width()).map(move |x| (x, y)))
        .map(|(x, y)| pixel(x, y))
        .collect()
}

/// Number of pixels that differ from the expected ones.
fn different(areas: &Areas, expected: &[[u8; 4]], view: &View) -> usize {
    let frame = drawn(areas, view);
    let pairs = frame.pixels().iter().zip(expected);
    pairs.filter(|(a, b)| a != b).count()
}

fn polygon(sides: u32, center: Point<f64>, radius_m: f64) -> Vec<Point<f64>> {
    let corner = |i: u32| {
        let angle = 0.3 + f64::from(i) * std::f64::consts::TAU / f64::from(sides);
        center + Point::new(angle.cos(), angle.sin()) * radius_m
    };
    (0..sides).map(corner).collect()
}

fn some_areas() -> Areas {
    let mut areas = Areas::default();
    let at = |x: f64, y: f64| Point::new(1000.0 + x, -7.0 + y);
    areas.push(&polygon(5, at(0.0, 0.0), 0.8));
    areas.push(&polygon(3, at(0.7, 0.2), 1.1));
    let mut clockwise = polygon(4, at(-2.0, 0.3), 0.6);
    clockwise.reverse();
    areas.push(&clockwise);
    // Larger than the picture, thinner than a pixel, outside, and without area.
    areas.push(&[at(-900.0, 502.0), at(900.0, 501.9), at(-903.0, -498.1)]);
    areas.push(&[at(2.0, -3.0), at(2.03, -3.0), at(2.02, 3.0)]);
    areas.push(&polygon(6, at(50.0, 50.0), 3.0));
    areas.push(&[at(1.0, 1.0)]);
    // A hole, and an island in it.
    let ring = [0.7, 0.5, 0.2].map(|radius_m| polygon(7, at(2.2, -0.2), radius_m));
    areas.push_outline(ring.iter().map(Vec::as_slice));
    areas
}

#[test]
fn pixels_match_a_test_of_every_sample() {
    for scale in [0.01, 3.0, 10.0, 4000.0] {
        let (areas, view) = (some_areas(), view(scale));
        let expected = expected(&areas, &view);
        assert_eq!(different(&areas, &expected, &view), 0, "{scale}");
    }
}

#[test]
fn strips_are_rows_of_the_whole_picture() {
    let size = FrameSize::new(70, 200).unwrap();
    let view = View::new(size, Point::new(1000.0, -7.0), 30.0).unwrap();
    let areas = some_areas();
    let whole = drawn(&areas, &view);
    let mut rows = whole.pixels().iter();
    for strip in view.strips(0) {
        let mut frame = Frame::new(strip.size());
        frame.pixels_mut().fill([255; 4]);
        lay_areas(&areas, &strip, INK, &mut frame);
        assert!(
            frame
                .pixels()
                .iter()
                .eq(rows.by_ref().take(frame.pixels().len()))
        );
    }
    assert_eq!((rows.next(), view.strips(0).len()), (None, 4));
}

#[test]
fn the_comparison_detects_missing_polygons() {
    let (areas, view) = (some_areas(), view(10.0));
    let expected = expected(&areas, &view);
    for left_out in [0, 1, 2, 3, 4, 7] {
        let mut fewer = Areas::default();
        let kept = (0..areas.len()).filter(|i| *i != left_out);
        kept.for_each(|i| fewer.push_outline(areas.outline(i)));
        assert!(different(&fewer, &expected, &view) > 0, "{left_out}");
    }
}

#[test]
fn a_color_over_transparency_keeps_its_hue() {
    let view = view(10.0);
    let mut frame = Frame::new(view.size());
    lay_areas(&some_areas(), &Strip::whole(&view), INK, &mut frame);
    assert!(frame.pixels().contains(&[200, 40, 0, 128]));
    assert!(frame.pixels().contains(&[0; 4]));
}
