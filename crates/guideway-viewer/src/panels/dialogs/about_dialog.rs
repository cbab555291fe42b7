//! The dialog about the program: version, licenses, render method, graphics adapter.

use crate::language::{say, t};
use eframe::egui::{Align2, Context, Grid, Window};

const VERSION: &str = env!("CARGO_PKG_VERSION");
const LICENSES: &str = env!("CARGO_PKG_LICENSE");
const REPOSITORY: &str = env!("CARGO_PKG_REPOSITORY");

/// The dialog.
#[derive(Default)]
pub(crate) struct AboutDialog {
    pub(crate) is_open: bool,
}

impl AboutDialog {
    /// Shows the dialog if it is open.
    pub(crate) fn show(&mut self, ctx: &Context, adapter: &str, method: &str) {
        if !self.is_open {
            return;
        }
        let window = Window::new(t("About Guideway")).open(&mut self.is_open);
        let window = window.pivot(Align2::CENTER_CENTER);
        let window = window.default_pos(ctx.content_rect().center());
        window.resizable(false).show(ctx, |ui| {
            ui.label(format!("Guideway {VERSION}"));
            ui.label(say!(
                "{licenses}; the fonts under the SIL Open Font and Ubuntu licenses",
                licenses = LICENSES
            ));
            ui.hyperlink(REPOSITORY);
            ui.separator();
            Grid::new("about").num_columns(2).show(ui, |ui| {
                for (name, value) in [
                    (t("Layouts drawn by"), method),
                    (t("Window shown by"), adapter),
                ] {
                    ui.label(name);
                    ui.label(if value.is_empty() {
                        t("unknown")
                    } else {
                        value
                    });
                    ui.end_row();
                }
            });
        });
    }
}
