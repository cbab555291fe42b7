//! The Findings section: results of the check, and the option of the next one.

use eframe::egui::{CollapsingHeader, DragValue, Ui};
use guideway_document::locate;
use guideway_layout::{CheckOptions, Diagnostics, FindingKind, Place};

use crate::action::Action;
use crate::files::{Layer, OpenFiles};

/// Longest list of findings of one kind.
const MAX_LISTED: usize = 200;

/// The option of the next check.
#[derive(Default)]
pub(crate) struct FindingsPanel {
    /// Bends tighter than this radius are findings; 0 turns that check off.
    pub(crate) min_radius_m: f64,
}

impl FindingsPanel {
    /// The options of the next check.
    pub(crate) fn check_options(&self) -> CheckOptions {
        CheckOptions {
            min_radius_m: Some(self.min_radius_m).filter(|radius_m| *radius_m > 0.0),
            ..CheckOptions::default()
        }
    }

    /// Shows the section.
    pub(super) fn show(&mut self, ui: &mut Ui, files: &OpenFiles, actions: &mut Vec<Action>) {
        let Some(layer) = files.active() else {
            return;
        };
        self.show_check(ui, layer, actions);
        let Some(findings) = layer.tasks.findings() else {
            return;
        };
        let state = layer.document().map(|document| document.state());
        if state.is_some_and(|state| state != findings.state) {
            ui.small("These findings predate the last change");
        }
        let clicked = list(ui, &findings.diagnostics);
        if let (Some(place), Some(document)) = (clicked, layer.document()) {
            actions.push(match locate(document.layout(), &place) {
                Some(element) => Action::ZoomTo(element),
                None => Action::Notify(format!("{place} has no position in the plane")),
            });
        }
    }

    fn show_check(&mut self, ui: &mut Ui, layer: &Layer, actions: &mut Vec<Action>) {
        ui.horizontal(|ui| {
            let radius = DragValue::new(&mut self.min_radius_m).range(0.0..=1000.0);
            let radius = radius.speed(0.05).prefix("Minimum radius ").suffix(" m");
            ui.add(radius)
                .on_hover_text("Bends tighter than this are findings; 0 turns this check off");
            let can_check = layer.document().is_some() && !layer.tasks.is_checking();
            ui.add_enabled_ui(can_check, |ui| {
                if ui.button("Check again").clicked() {
                    actions.push(Action::Check(self.check_options()));
                }
            });
        });
        if layer.tasks.is_checking() {
            ui.label("Check in progress");
        }
    }
}

/// Lists findings by kind. Returns the place of a clicked one.
fn list(ui: &mut Ui, findings: &Diagnostics) -> Option<Place> {
    if findings.is_empty() {
        ui.label("No findings");
    }
    let mut clicked = None;
    for kind in FindingKind::of([findings]) {
        let FindingKind {
            code,
            severity,
            count,
        } = kind;
        let title = format!("{severity}: {code} ({count})");
        CollapsingHeader::new(title).show(ui, |ui| {
            ui.small(code.meaning());
            let of_kind = findings.iter().filter(|finding| kind.has(finding));
            let listed: Vec<_> = of_kind.take(MAX_LISTED).collect();
            for finding in &listed {
                let text = format!("{}: {}", finding.place, finding.message);
                if ui.link(text).on_hover_text(&finding.remedy).clicked() {
                    clicked = Some(finding.place.clone());
                }
            }
            if count > listed.len() as u64 {
                ui.small(format!("and {} more", count - listed.len() as u64));
            }
        });
    }
    clicked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radius_zero_turns_the_check_off() {
        let mut panel = FindingsPanel::default();
        assert_eq!(panel.check_options().min_radius_m, None);
        panel.min_radius_m = 0.5;
        assert_eq!(panel.check_options().min_radius_m, Some(0.5));
    }
}
