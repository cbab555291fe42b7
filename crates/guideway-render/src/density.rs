//! Density shading: from how many paths cover a pixel, on average over its square, to a colour.
//!
//! With a million paths on two million pixels a linear scale shows either the crowd or the single path;
//! the logarithm shows both.

use guideway_scene::Rgba;

use crate::Frame;

/// How counts become lightness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMap {
    /// In proportion.
    Linear,
    /// By the logarithm of one plus the count.
    #[default]
    Log,
}

/// Steps from few to many, dark to light on any background: lightness rises evenly.
const STEPS: [Rgba; 6] = [
    Rgba::opaque(20, 30, 80),
    Rgba::opaque(60, 50, 140),
    Rgba::opaque(140, 60, 140),
    Rgba::opaque(220, 90, 100),
    Rgba::opaque(250, 160, 70),
    Rgba::opaque(250, 240, 150),
];

/// Colours a frame from `counts`, the mean number of covering paths of each pixel. The largest count gets
/// the last colour; below one path the background shows through.
///
/// # Panics
/// When there is not one count a pixel.
pub fn shade(counts: &[f32], tone: ToneMap, background: Rgba, frame: &mut Frame) {
    assert_eq!(counts.len(), frame.pixels().len(), "one count a pixel");
    let curve = |count: f32| match tone {
        ToneMap::Linear => f64::from(count),
        ToneMap::Log => f64::from(count).ln_1p(),
    };
    let most = counts.iter().copied().fold(1.0, f32::max);
    for (pixel, &count) in frame.pixels_mut().iter_mut().zip(counts) {
        let along = curve(count) / curve(most) * (STEPS.len() - 1) as f64;
        let below = (along as usize).min(STEPS.len() - 2);
        let color = STEPS[below].lerp(STEPS[below + 1], along - below as f64);
        let shown = background.lerp(color, f64::from(count.min(1.0)));
        *pixel = [shown.r, shown.g, shown.b, shown.a];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FrameSize;

    #[test]
    fn nothing_shows_the_background_and_most_the_last_step() {
        let mut frame = Frame::new(FrameSize::new(3, 1).unwrap());
        for tone in [ToneMap::Linear, ToneMap::Log] {
            shade(&[0.0, 10.0, 1000.0], tone, Rgba::WHITE, &mut frame);
            assert_eq!(frame.pixels()[0], [255; 4]);
            assert_eq!(frame.pixels()[2], [250, 240, 150, 255]);
        }
    }
}
