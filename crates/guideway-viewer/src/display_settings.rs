//! Display settings: colors, line widths, and the decorations that are shown, for all files alike.

use std::ops::RangeInclusive;

use guideway_document::decorations::{
    DecorationStyle, MarkOptions, MarkedKinds, grid, grid_step_m,
};
use guideway_scene::density::ToneMap;
use guideway_scene::{
    ColorBy, DrawList, LineRule, NumberColors, Palette, Rgba, SceneOptions, Shading, Style, View,
};
use serde::{Deserialize, Serialize};

use crate::language::Language;
use crate::typed_breaks::TypedBreaks;
use crate::units::{LengthUnit, SpeedUnit, Units};

/// Greatest width of paths without a width of their own, in meters.
pub(crate) const MAX_WIDTH_M: f64 = 2.0;
/// The width that files of the settings had before it could be automatic, in meters.
const OLD_WIDTH_M: f64 = 0.1;
/// Least width on screen until the user sets one, in points.
const MIN_PX: f64 = 1.5;
/// Range of the least width on screen, in points.
pub(crate) const MIN_PX_RANGE: RangeInclusive<f64> = 0.5..=8.0;
/// Range of the grid step, in meters.
pub(crate) const GRID_STEPS_M: RangeInclusive<f64> = 0.001..=10_000.0;

/// Light or dark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ThemeChoice {
    Light,
    Dark,
    /// As the desktop.
    #[default]
    System,
}

/// Color of paths without a color of their own: calm, and readable on light and dark.
const PATH_COLOR: Rgba = Rgba::opaque(0x5a, 0x6b, 0x7f);

/// The display settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub(crate) struct DisplaySettings {
    pub(crate) theme: ThemeChoice,
    /// True if the theme is dark at present.
    #[serde(skip)]
    pub(crate) is_dark: bool,
    /// The attribute column that colors the paths; `None` uses the colors of the file.
    #[serde(skip)]
    pub(crate) color_by: Option<String>,
    /// Palette of the numbers of that column.
    #[serde(skip)]
    pub(crate) palette: Palette,
    /// The numbers at both ends of the palette; `None` for the least and the largest one.
    #[serde(skip)]
    pub(crate) range: [Option<f64>; 2],
    /// The numbers between classes of colors, in place of a range.
    #[serde(skip)]
    pub(crate) breaks: TypedBreaks,
    pub(crate) is_thesis_rule: bool,
    /// Width of paths without a width of their own, in meters; `None` takes what suits the file.
    pub(crate) width_m: Option<f64>,
    /// Least width on screen, in points.
    pub(crate) min_px: f64,
    pub(crate) is_density: bool,
    /// True if density is shown because paths would cover the picture, until the user decides.
    #[serde(skip)]
    pub(crate) is_crowded: bool,
    pub(crate) has_arrows: bool,
    pub(crate) has_symbols: bool,
    pub(crate) has_labels: bool,
    pub(crate) has_grid: bool,
    /// Distance of grid lines in meters; `None` follows the scale.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) grid_step_m: Option<f64>,
    /// True if the dialogs of the desktop ask for file names; else the line of the window does.
    pub(crate) uses_desktop_dialogs: bool,
    /// Language of the window; `None` takes that of the desktop.
    pub(crate) language: Option<Language>,
    /// Unit of the speeds that are shown and typed.
    pub(crate) speed_unit: SpeedUnit,
    /// Unit of the lengths among the properties.
    pub(crate) length_unit: LengthUnit,
}

impl Default for DisplaySettings {
    fn default() -> Self {
        Self {
            theme: ThemeChoice::default(),
            is_dark: false,
            color_by: None,
            palette: Palette::default(),
            range: [None; 2],
            breaks: TypedBreaks::default(),
            is_thesis_rule: false,
            width_m: None,
            min_px: MIN_PX,
            is_density: false,
            is_crowded: false,
            has_arrows: true,
            has_symbols: true,
            has_labels: true,
            has_grid: true,
            grid_step_m: None,
            uses_desktop_dialogs: true,
            language: None,
            speed_unit: SpeedUnit::default(),
            length_unit: LengthUnit::default(),
        }
    }
}

impl DisplaySettings {
    /// The same with all numbers in their ranges: a file may hold any.
    pub(crate) fn in_range(mut self) -> Self {
        let width_m = self.width_m.filter(|_| self.width_m != Some(OLD_WIDTH_M));
        self.width_m = width_m.filter(|width_m| (0.0..=MAX_WIDTH_M).contains(width_m));
        if !MIN_PX_RANGE.contains(&self.min_px) {
            self.min_px = MIN_PX;
        }
        self.grid_step_m = self.grid_step_m.filter(|step| GRID_STEPS_M.contains(step));
        self
    }

    /// The units of values.
    pub(crate) fn units(&self) -> Units {
        Units {
            speed: self.speed_unit,
            length: self.length_unit,
        }
    }

    /// Turns the theme around, for good.
    pub(crate) fn set_dark(&mut self, is_dark: bool) {
        self.theme = match is_dark {
            true => ThemeChoice::Dark,
            false => ThemeChoice::Light,
        };
    }

    /// Background color of the picture.
    pub(crate) fn background(&self) -> Rgba {
        if self.is_dark {
            Rgba::opaque(24, 26, 30)
        } else {
            Rgba::WHITE
        }
    }

    /// Colors and sizes of decorations, at `px_per_point` pixels per point of the screen.
    pub(crate) fn decoration_style(&self, px_per_point: f64) -> DecorationStyle {
        DecorationStyle::new(self.background(), px_per_point)
    }

    /// The marks that are shown over lines of these widths: arrows, symbols, labels.
    pub(crate) fn mark_options(&self, line_rule: LineRule, px_per_point: f64) -> MarkOptions {
        let label_size = self.decoration_style(px_per_point).label_size();
        MarkOptions {
            px_per_point,
            line_rule,
            arrows: self.has_arrows,
            symbols: self.has_symbols,
            labels: self.has_labels.then_some(label_size),
            of: MarkedKinds::default(),
        }
    }

    /// The grid of a view; empty if it is off.
    pub(crate) fn grid(&self, view: &View, px_per_point: f64) -> DrawList {
        match self.has_grid {
            true => grid(view, self.grid_step_m, &self.decoration_style(px_per_point)),
            false => DrawList::default(),
        }
    }

    /// Distance of the grid lines of a view, in meters, whether they are shown or not.
    pub(crate) fn grid_step_m(&self, view: &View, px_per_point: f64) -> f64 {
        grid_step_m(view, self.grid_step_m, px_per_point)
    }

    /// The options that scenes are made with.
    pub(crate) fn scene_options(&self) -> SceneOptions {
        SceneOptions {
            color: Some(PATH_COLOR),
            color_by: self.color_by.clone().map(|column| ColorBy { column }),
            numbers: self.number_colors(),
            has_gray_structure: true,
            ..SceneOptions::default()
        }
    }

    /// The colors of the numbers of a column.
    pub(crate) fn number_colors(&self) -> NumberColors {
        let [from, to] = self.range;
        let ends = [
            from.unwrap_or(f64::NEG_INFINITY),
            to.unwrap_or(f64::INFINITY),
        ];
        NumberColors {
            palette: self.palette,
            range: (self.range != [None; 2]).then_some(ends),
            breaks: self.breaks.breaks(),
            background: self.background(),
        }
    }

    /// Returns `true` if the scenes of the two settings differ.
    pub(crate) fn needs_other_scene(&self, other: &Self) -> bool {
        let colors = |of: &Self| (of.palette, of.range, of.breaks.breaks());
        self.color_by != other.color_by || colors(self) != colors(other)
    }

    /// Returns `true` if the density of paths is shown, not their colors.
    pub(crate) fn shows_density(&self) -> bool {
        self.is_density || self.is_crowded
    }

    /// Shows density or colors, as the user decides.
    pub(crate) fn set_density(&mut self, is_shown: bool) {
        (self.is_density, self.is_crowded) = (is_shown, false);
    }

    /// The style of the picture of one file, whose lines have these widths. Its background is
    /// transparent: the window paints background, grid and other files below it.
    pub(crate) fn style(&self, line_rule: LineRule) -> Style {
        Style {
            line_rule,
            shading: if self.shows_density() {
                Shading::Density(ToneMap::Log)
            } else {
                Shading::Color
            },
            background: match self.shows_density() {
                // Its colors stand out from a paper, which nothing at all would be white.
                true => Rgba {
                    a: 1,
                    ..self.background()
                },
                false => Rgba::from_u32(0),
            },
        }
    }

    /// The widths of lines at `px_per_point` pixels per point of the screen: their limits are the
    /// same length on any screen. What the user has not set is that of `automatic`.
    pub(crate) fn line_rule(&self, automatic: LineRule, px_per_point: f64) -> LineRule {
        let LineRule::World {
            width_m,
            min_px,
            max_px,
        } = automatic
        else {
            return LineRule::Thesis;
        };
        if self.is_thesis_rule {
            return LineRule::Thesis;
        }
        let is_set = self.width_m.is_some() || self.min_px != Self::default().min_px;
        let rule = LineRule::World {
            width_m: self.width_m.unwrap_or(width_m),
            min_px: if is_set { self.min_px } else { min_px },
            max_px: max_px.max(self.min_px),
        };
        rule.scaled(px_per_point)
    }

    /// Returns `true` if arrows, symbols or labels are shown.
    pub(crate) fn has_marks(&self) -> bool {
        self.has_arrows || self.has_symbols || self.has_labels
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::density::ToneScale;

    use super::*;

    #[test]
    fn only_color_settings_need_another_scene() {
        let settings = DisplaySettings::default();
        let mut wide = settings.clone();
        wide.width_m = Some(2.0);
        let mut colored = settings.clone();
        colored.color_by = Some("maxSpeed".into());
        assert!(!settings.needs_other_scene(&wide) && settings.needs_other_scene(&colored));
        let mut of_range = settings.clone();
        of_range.range[1] = Some(2.0);
        let mut gray = settings.clone();
        gray.palette = Palette::Gray;
        assert!(settings.needs_other_scene(&of_range) && settings.needs_other_scene(&gray));
        let mut of_classes = settings.clone();
        of_classes.breaks.set_text("0.5 1".into());
        assert!(settings.needs_other_scene(&of_classes));
    }

    #[test]
    fn paths_and_density_stand_out_on_light_and_dark() {
        for is_dark in [false, true] {
            let settings = DisplaySettings {
                is_dark,
                is_density: true,
                ..DisplaySettings::default()
            };
            let paper = settings.background();
            let tones =
                ToneScale::new(ToneMap::Log, settings.style(LineRule::default()).background);
            let tones = tones.legend().scale.unwrap().colors;
            for color in tones.into_iter().chain([PATH_COLOR]) {
                let contrast = contrast(color, paper);
                // The least contrast of graphics in WCAG 2.1, 1.4.11.
                assert!(contrast >= 3.0, "{color} on {paper}: {contrast}");
            }
        }
    }

    /// Contrast of two colors: WCAG 2.1.
    fn contrast(a: Rgba, b: Rgba) -> f64 {
        let linear = |v: u8| {
            let v = f64::from(v) / 255.0;
            match v <= 0.04045 {
                true => v / 12.92,
                false => ((v + 0.055) / 1.055).powf(2.4),
            }
        };
        let luminance =
            |c: Rgba| 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
        let [a, b] = [a, b].map(|color| luminance(color) + 0.05);
        a.max(b) / a.min(b)
    }

    #[test]
    fn lines_are_as_wide_on_a_screen_of_high_density() {
        let settings = DisplaySettings::default();
        let radius_px = |px_per_point| {
            let rule = settings.line_rule(LineRule::default(), px_per_point);
            rule.radius_px(None, 2.0 * px_per_point)
        };
        assert_eq!(radius_px(2.0), 2.0 * radius_px(1.0));
    }

    #[test]
    fn least_width_never_exceeds_the_greatest() {
        let settings = DisplaySettings {
            min_px: 1e3,
            ..DisplaySettings::default()
        };
        let rule = settings.line_rule(LineRule::default(), 1.0);
        let LineRule::World { min_px, max_px, .. } = rule else {
            panic!("the thesis' rule is off");
        };
        assert!(min_px <= max_px);
    }

    #[test]
    fn widths_suit_the_file_until_the_user_sets_one() {
        let layout = |format: &str| {
            let mut layout = guideway_layout::Layout::default();
            layout.provenance.format = format.to_owned();
            layout
        };
        let (plan, site) = (layout("DXF"), layout("LIF"));
        let radius_px = |settings: &DisplaySettings, layout| {
            // A detail of a drawing fills the canvas.
            let rule = settings.line_rule(guideway_compose::usual_widths(layout), 1.0);
            rule.radius_px(None, 1000.0)
        };
        let mut settings = DisplaySettings::default();
        assert_eq!(radius_px(&settings, &plan), 0.5);
        assert_eq!(radius_px(&settings, &site), 6.0);
        settings.min_px = 4.0;
        assert_eq!(radius_px(&settings, &plan), 2.0);
        settings.width_m = Some(0.01);
        for layout in [&plan, &site] {
            assert_eq!(radius_px(&settings, layout), 5.0);
        }
    }

    #[test]
    fn settings_of_earlier_files_load_with_automatic_widths() {
        let width_m = |text: &str| {
            let settings: DisplaySettings = toml::from_str(text).unwrap();
            settings.in_range().width_m
        };
        assert_eq!(width_m("width-m = 0.1\nmin-px = 1.5\n"), None);
        assert_eq!(width_m("width-m = 0.35\n"), Some(0.35));
        assert_eq!(width_m("width-m = 99.0\n"), None);
        assert_eq!(width_m("min-px = 2.0\n"), None);
        let text = toml::to_string(&DisplaySettings::default()).unwrap();
        assert!(!text.contains("width-m"), "{text}");
    }
}
