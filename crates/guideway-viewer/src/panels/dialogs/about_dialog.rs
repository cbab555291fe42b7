//! The dialog about the program: version, licenses, render method, graphics adapter.

use eframe::egui::{Context, Grid, Window};

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
        let window = Window::new("About Guideway").open(&mut self.is_open);
        window.resizable(false).show(ctx, |ui| {
            ui.label(format!("Guideway {VERSION}"));
            ui.label(format!(
                "{LICENSES}; the fonts under the SIL Open Font and Ubuntu licenses"
            ));
            ui.hyperlink(REPOSITORY);
            ui.separator();
            Grid::new("about").num_columns(2).show(ui, |ui| {
                for (name, value) in [("Layouts drawn by", method), ("Window shown by", adapter)] {
                    ui.label(name);
                    ui.label(if value.is_empty() { "unknown" } else { value });
                    ui.end_row();
                }
            });
        });
    }
}
