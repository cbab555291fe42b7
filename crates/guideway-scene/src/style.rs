//! Frame-wide style: line width rule, shading and background.

use crate::density::ToneMap;
use crate::{LineRule, Rgba};

/// How the frame looks, for all paths alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// How wide lines are.
    pub line_rule: LineRule,
    /// What a pixel shows.
    pub shading: Shading,
    /// What lies below all paths.
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

/// What a pixel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// The colors of the paths.
    #[default]
    Color,
    /// How many paths cover it.
    Density(ToneMap),
}
