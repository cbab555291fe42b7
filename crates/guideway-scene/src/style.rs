//! Frame-wide style: line width rule, shading and background.

use crate::density::ToneMap;
use crate::{LineRule, Rgba};

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
