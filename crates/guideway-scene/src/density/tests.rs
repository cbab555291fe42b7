use super::*;
use crate::FrameSize;
use crate::ramp::{CONTRAST, contrast};

#[test]
fn maps_zero_to_background_and_maximum_to_last_color() {
    let mut frame = Frame::new(FrameSize::new(3, 1).unwrap());
    for tone in [ToneMap::Linear, ToneMap::Log, ToneMap::Equalized] {
        shade(&[0.0, 10.0, 1000.0], tone, Rgba::WHITE, &mut frame);
        assert_eq!(frame.pixels()[0], [255; 4]);
        assert_eq!(frame.pixels()[2], step(5));
    }
}

fn colors(counts: &[f32], tone: ToneMap) -> Vec<[u8; 4]> {
    let size = FrameSize::new(counts.len() as u32, 1).unwrap();
    let mut frame = Frame::new(size);
    shade(counts, tone, Rgba::WHITE, &mut frame);
    frame.pixels().to_vec()
}

fn step(index: usize) -> [u8; 4] {
    let colors = ToneScale::new(ToneMap::Log, Rgba::WHITE).colors;
    let Rgba { r, g, b, a } = colors.at(index as f64 / 5.0);
    [r, g, b, a]
}

#[test]
fn all_colors_stand_out_from_the_background() {
    for gray in [255, 0, 44, 119] {
        let paper = Rgba::opaque(gray, gray, gray);
        let scale = ToneScale::new(ToneMap::Log, paper).legend().scale.unwrap();
        for color in &scale.colors {
            assert!(contrast(*color, paper) >= CONTRAST, "{color:?}");
        }
    }
}

#[test]
fn equalizing_gives_each_fifth_of_the_crowded_pixels_a_color() {
    let counts = [3.0, 1.0, 1024.0, 8.0, 0.5, 2.0, 3.5];
    let shown = colors(&counts, ToneMap::Equalized);
    let mut expected = [2, 0, 5, 4, 0, 1, 3].map(step);
    expected[4] = expected[4].map(|channel| (f32::from(channel) / 2.0 + 127.5).round() as u8);
    assert_eq!(shown, expected);
}

#[test]
fn many_equal_counts_take_many_colors_and_those_up_to_one_the_first() {
    let shown = colors(&[2.0, 2.0, 4.0, 2.0, 2.0], ToneMap::Equalized);
    assert_eq!(shown, [4, 4, 5, 4, 4].map(step));
    let up_to_one = colors(&[1.0, 1.0, 0.0], ToneMap::Equalized);
    assert_eq!(up_to_one, [step(0), step(0), [255; 4]]);
}

#[test]
fn table_matches_exact_colors_within_one_level() {
    let mut frame = Frame::new(FrameSize::new(1000, 150).unwrap());
    let count = |i: usize| 0.7 + (i % 1009) as f32 * 0.37;
    let counts: Vec<f32> = (0..frame.pixels().len()).map(count).collect();
    assert!(counts.len() > 2 * CHUNK, "spans several chunks");
    let most = f64::from(count(1008));
    let colors = ToneScale::new(ToneMap::Log, Rgba::WHITE).colors;
    let exact = |count: f32, along: f64| {
        let shown = Rgba::WHITE.lerp(colors.at(along), f64::from(count.min(1.0)));
        [shown.r, shown.g, shown.b, shown.a]
    };
    for tone in [ToneMap::Log, ToneMap::Linear] {
        shade(&counts, tone, Rgba::WHITE, &mut frame);
        for (shown, &count) in frame.pixels().iter().zip(&counts) {
            let along = match tone {
                ToneMap::Log => f64::from(count).ln_1p() / most.ln_1p(),
                _ => f64::from(count) / most,
            };
            let exact = exact(count, along);
            let off = (0..4).map(|i| shown[i].abs_diff(exact[i])).max();
            assert!(off <= Some(1), "{tone:?} {count}: {shown:?}, {exact:?}");
        }
    }
}

#[test]
fn scale_from_parts_equals_scale_from_the_whole() {
    let mut whole = Frame::new(FrameSize::new(100, 30).unwrap());
    let mut by_parts = whole.clone();
    let counts: Vec<f32> = (0..3000).map(|i| (i * i % 97) as f32 * 0.25).collect();
    shade(&counts, ToneMap::Equalized, Rgba::WHITE, &mut whole);
    let mut tones = ToneScale::new(ToneMap::Equalized, Rgba::WHITE);
    counts.chunks(700).for_each(|part| tones.observe(part));
    tones.shade(&counts, &mut by_parts);
    assert!(by_parts == whole);
    let mut partial = ToneScale::new(ToneMap::Equalized, Rgba::WHITE);
    partial.observe(&counts[..700]);
    partial.shade(&counts, &mut by_parts);
    assert!(by_parts != whole);
}

#[test]
fn rank_is_stable_under_small_sampling_differences() {
    let crowd: Vec<f32> = (0..1000).map(|i| 2.0 + (i % 4) as f32).collect();
    let mut histogram = Histogram::default();
    histogram.add(&crowd);
    let ranks = histogram.ranks();
    for count in [1.0, 2.0, 3.0, 4.0] {
        let apart = ranks.up_to(count * 1.01) - ranks.up_to(count);
        assert!((0.0..30.0).contains(&apart), "{count}: {apart}");
    }
}
