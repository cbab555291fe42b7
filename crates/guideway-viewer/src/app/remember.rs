//! Remembers look and place of the window, and applies what an earlier run remembered.

use eframe::egui::{Context, Theme};

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
