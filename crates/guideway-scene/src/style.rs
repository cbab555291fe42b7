//! Frame-wide style: shading, background, and the rule from widths in meters to radii in pixels.

use crate::Rgba;
use crate::density::ToneMap;

/// Style of a frame, common to all paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Rule for stroke widths.
    pub line_rule: LineRule,
    /// Quantity that a pixel shows.
    pub shading: Shading,
    /// Color below all paths.
    pub background: Rgba,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            line_rule: LineRule::default(),
            shading: Shading::Color,
            background: Rgba::WHITE,
        }
    }
}

/// Quantity that a pixel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Colors of the paths.
    #[default]
    Color,
    /// Number of paths that cover the pixel.
    Density(ToneMap),
}

/// Rule for the stroke width of a path at a scale. Every method uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LineRule {
    /// A width in meters, clamped to a range in pixels.
    World {
        /// Width in meters of paths without a width of their own.
        width_m: f64,
        /// Smallest width in pixels.
        min_px: f64,
        /// Largest width in pixels.
        max_px: f64,
    },
    /// The thesis' rule: a radius of 1.5 pixels, clamped to 2 to 150 mm, for every path. Zoomed
    /// out, a line thins below a pixel and fades instead of turning the picture black.
    Thesis,
}

impl Default for LineRule {
    fn default() -> Self {
        Self::World {
            width_m: 0.1,
            min_px: 1.5,
            max_px: 12.0,
        }
    }
}

impl LineRule {
    /// Half the stroke width in pixels, at `px_per_m` pixels per meter. `width_m` is the path's own
    /// width in meters, if it has one.
    pub fn radius_px(&self, width_m: Option<f32>, px_per_m: f64) -> f64 {
        match *self {
            Self::World {
                width_m: common_m,
                min_px,
                max_px,
            } => {
                let width_px = width_m.map_or(common_m, f64::from) * px_per_m;
                width_px.min(max_px).max(min_px) / 2.0
            }
            Self::Thesis => (1.5 / px_per_m).clamp(0.002, 0.150) * px_per_m,
        }
    }

    /// The rule for a picture with `factor` times as many pixels per length of the page, as on a
    /// screen of high density: its limits in pixels grow with it. The thesis' rule, which counts
    /// pixels, stays.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::World {
                width_m,
                min_px,
                max_px,
            } => Self::World {
                width_m,
                min_px: min_px * factor,
                max_px: max_px * factor,
            },
            Self::Thesis => Self::Thesis,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamps_world_widths_in_pixels() {
        let rule = LineRule::World {
            width_m: 0.5,
            min_px: 1.0,
            max_px: 8.0,
        };
        assert_eq!(rule.radius_px(None, 1.0), 0.5);
        assert_eq!(rule.radius_px(None, 10.0), 2.5);
        assert_eq!(rule.radius_px(None, 1000.0), 4.0);
        assert_eq!(rule.radius_px(Some(0.25), 10.0), 1.25);
    }

    #[test]
    fn scaled_rule_gives_the_same_line_with_more_pixels() {
        for rule in [LineRule::default(), LineRule::Thesis] {
            assert_eq!(rule.scaled(1.0), rule);
        }
        let rule = LineRule::default();
        for px_per_m in [1.0, 40.0, 1000.0] {
            let (small, large) = (
                rule.radius_px(None, px_per_m),
                rule.scaled(4.0).radius_px(None, 4.0 * px_per_m),
            );
            assert_eq!(large, 4.0 * small);
        }
    }

    #[test]
    fn thesis_rule_thins_zoomed_out_and_grows_zoomed_in() {
        assert_eq!(LineRule::Thesis.radius_px(None, 1.0), 0.15);
        assert!((LineRule::Thesis.radius_px(None, 100.0) - 1.5).abs() < 1e-12);
        assert!((LineRule::Thesis.radius_px(None, 10_000.0) - 20.0).abs() < 1e-12);
    }
}
