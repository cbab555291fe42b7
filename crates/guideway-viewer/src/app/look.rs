use guideway_document::decorations::DecorationStyle;
use guideway_scene::density::ToneMap;
use guideway_scene::{ColorBy, LineRule, Rgba, SceneOptions};
use guideway_scene::{Shading, Style};

/// How layouts look, for all files alike.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Look {
    pub(crate) is_dark: bool,
    /// The column that decides the color.
    pub(crate) color_by: Option<String>,
    pub(crate) is_thesis_rule: bool,
    /// Width of paths that have none of their own.
    pub(crate) width_m: f64,
    /// Least width on the screen.
    pub(crate) min_px: f64,
    pub(crate) is_density: bool,
    pub(crate) has_arrows: bool,
    pub(crate) has_symbols: bool,
    pub(crate) has_labels: bool,
    pub(crate) has_grid: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            is_dark: false,
            color_by: None,
            is_thesis_rule: false,
            width_m: 0.1,
            min_px: 1.5,
            is_density: false,
            has_arrows: true,
            has_symbols: true,
            has_labels: true,
            has_grid: true,
        }
    }
}

impl Look {
    /// What the paths are painted on.
    pub(crate) fn paper(&self) -> Rgba {
        if self.is_dark {
            Rgba::opaque(24, 26, 30)
        } else {
            Rgba::WHITE
        }
    }

    fn ink(&self) -> Rgba {
        if self.is_dark {
            Rgba::opaque(222, 226, 232)
        } else {
            Rgba::BLACK
        }
    }

    /// Color of lines and texts beside the paths.
    pub(crate) fn mark_ink(&self) -> Rgba {
        self.decoration_style(1.0).ink
    }

    /// Colors and sizes of decorations, at `px_per_point` pixels per point.
    pub(crate) fn decoration_style(&self, px_per_point: f64) -> DecorationStyle {
        DecorationStyle::new(self.paper(), px_per_point)
    }

    /// What a scene is made with.
    pub(crate) fn scene_options(&self) -> SceneOptions {
        SceneOptions {
            color: Some(self.ink()),
            color_by: self.color_by.clone().map(|column| ColorBy { column }),
            level: None,
        }
    }

    /// Whether a scene for one look is not one for the other.
    pub(crate) fn scene_options_differ(&self, other: &Self) -> bool {
        self.is_dark != other.is_dark || self.color_by != other.color_by
    }

    /// What a picture is made with: over nothing, since the window paints the paper, the grid and other files
    /// below it.
    pub(crate) fn style(&self) -> Style {
        Style {
            line_rule: self.line_rule(),
            shading: if self.is_density {
                Shading::Density(ToneMap::Log)
            } else {
                Shading::Color
            },
            background: Rgba::from_u32(0),
        }
    }

    pub(crate) fn line_rule(&self) -> LineRule {
        if self.is_thesis_rule {
            return LineRule::Thesis;
        }
        match LineRule::default() {
            LineRule::World { max_px, .. } => LineRule::World {
                width_m: self.width_m,
                min_px: self.min_px,
                max_px: max_px.max(self.min_px),
            },
            LineRule::Thesis => LineRule::Thesis,
        }
    }

    /// Whether anything is drawn over paths.
    pub(crate) fn has_marks(&self) -> bool {
        self.has_arrows || self.has_symbols || self.has_labels
    }
}
