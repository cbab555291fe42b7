//! Remembers look and place of the window, and applies what an earlier run remembered.

use eframe::egui::{Color32, Context, FontId, Style, TextStyle, Theme};

use super::state::App;
use crate::display_settings::ThemeChoice;
use crate::preferences::Preferences;

impl App {
    /// The state of the window to remember.
    fn preferences(&self) -> Preferences {
        Preferences {
            panel_width: self.panel_width,
            side_panel: self.side.wanted,
            look: self.settings.clone(),
            window: self.window_place,
        }
    }

    /// Takes the place of the window, and writes settings that have changed, once the pointer that
    /// changes them is up.
    pub(super) fn remember(&mut self, ctx: &Context) {
        self.window_place.update(ctx);
        if ctx.input(|input| input.pointer.any_down()) {
            return;
        }
        // A window that moves would be written in each frame.
        let preferences = Preferences {
            window: self.preferences_file.saved().window,
            ..self.preferences()
        };
        let notice = self.preferences_file.save(&preferences);
        self.notify_all(notice);
    }

    /// Writes everything that is to be remembered: the window closes.
    pub(crate) fn leave(&mut self) {
        let preferences = self.preferences();
        // Nobody is there to read a notice.
        let _ = self.preferences_file.save(&preferences);
    }

    fn theme(&self, ctx: &Context) -> Theme {
        match self.settings.theme {
            ThemeChoice::Light => Theme::Light,
            ThemeChoice::Dark => Theme::Dark,
            ThemeChoice::System => ctx.system_theme().unwrap_or(Theme::Light),
        }
    }

    /// Applies the light or dark theme to all panels.
    pub(crate) fn apply_theme(&mut self, ctx: &Context) {
        let theme = self.theme(ctx);
        ctx.set_theme(theme);
        ctx.all_styles_mut(make_legible);
        let is_dark = theme == Theme::Dark;
        if std::mem::replace(&mut self.settings.is_dark, is_dark) != is_dark {
            self.recolor();
        }
    }

    /// Follows the settings, and the desktop from light to dark and back.
    pub(super) fn follow_theme(&mut self, ctx: &Context) {
        if self.settings.is_dark != (self.theme(ctx) == Theme::Dark) {
            self.apply_theme(ctx);
        }
    }
}

/// Grays of shortcuts, hints and numbers beside names, on light and dark; those of egui leave too
/// little contrast.
const WEAK_TEXT: [Color32; 2] = [Color32::from_gray(105), Color32::from_gray(135)];
/// Size of notes below fields, in points.
const SMALL_TEXT_POINTS: f32 = 11.0;

/// Makes the small and the weak texts of a style legible.
fn make_legible(style: &mut Style) {
    let [on_light, on_dark] = WEAK_TEXT;
    let weak = if style.visuals.dark_mode {
        on_dark
    } else {
        on_light
    };
    style.visuals.weak_text_color = Some(weak);
    let small = FontId::proportional(SMALL_TEXT_POINTS);
    style.text_styles.insert(TextStyle::Small, small);
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Rgba, Visuals};

    use super::*;

    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |color| {
            let color = Rgba::from(color);
            0.2126 * color.r() + 0.7152 * color.g() + 0.0722 * color.b() + 0.05
        };
        let (a, b) = (luminance(a), luminance(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn weak_text_has_the_contrast_of_text() {
        for visuals in [Visuals::light(), Visuals::dark()] {
            let mut style = Style {
                visuals,
                ..Style::default()
            };
            let of = |style: &Style| {
                let panel = style.visuals.panel_fill;
                contrast(panel.blend(style.visuals.weak_text_color()), panel)
            };
            let before = of(&style);
            make_legible(&mut style);
            // WCAG 2.1, 1.4.3.
            assert!(of(&style) >= 4.5, "{}", of(&style));
            assert!(before < 4.5, "egui has {before} by itself");
        }
    }
}
