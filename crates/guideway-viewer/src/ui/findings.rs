use eframe::egui::{CollapsingHeader, DragValue, Ui};
use guideway_layout::{CheckOptions, Diagnostics, Place};

use crate::app::App;

/// Findings of one kind that are listed.
const MOST_LISTED: usize = 200;

impl App {
    pub(super) fn findings(&mut self, ui: &mut Ui) {
        self.check_again(ui);
        let Some(layer) = self.layers.get(self.active) else {
            return;
        };
        let Some(findings) = &layer.findings else {
            return;
        };
        let now = layer.document.as_ref().map(|document| document.state());
        if now.is_some_and(|now| now != findings.state) {
            ui.small("These are from before what was changed last.");
        }
        if let Some(place) = list(ui, &findings.found)
            && let Some(document) = self.document()
        {
            match guideway_document::locate(document.layout(), &place) {
                Some(found) => self.fly_to(found),
                None => self.notify(format!("{place} is a place in the file, not in the plane")),
            }
        }
    }

    /// What is asked, and a button that asks it of the layout as it is now.
    fn check_again(&mut self, ui: &mut Ui) {
        let Some(layer) = self.layers.get_mut(self.active) else {
            return;
        };
        let least_radius_m = &mut self.numbers.least_radius_m;
        let is_asked = ui.horizontal(|ui| {
            let radius = DragValue::new(&mut *least_radius_m).range(0.0..=1000.0);
            let radius = ui.add(radius.speed(0.05).prefix("Least radius ").suffix(" m"));
            radius.on_hover_text("Bends tighter than this are findings; 0 if bends do not matter");
            let can = layer.document.is_some() && !layer.is_checking();
            ui.add_enabled_ui(can, |ui| ui.button("Check again").clicked())
                .inner
        });
        if is_asked.inner {
            let options = CheckOptions {
                min_radius_m: Some(*least_radius_m).filter(|radius_m| *radius_m > 0.0),
                ..CheckOptions::default()
            };
            layer.check(options, &self.wake);
        }
        if layer.is_checking() {
            ui.label("It is still being looked through.");
        }
    }
}

/// Lists findings by their kind. Returns the place of one that was clicked.
fn list(ui: &mut Ui, findings: &Diagnostics) -> Option<Place> {
    if findings.is_empty() {
        ui.label("Nothing odd.");
    }
    let mut clicked = None;
    for (code, count) in findings.counts() {
        let title = format!("{}: {code} ({count})", code.severity());
        CollapsingHeader::new(title).show(ui, |ui| {
            ui.small(code.meaning());
            let of_code = findings.iter().filter(|f| f.code == code);
            let listed: Vec<_> = of_code.take(MOST_LISTED).collect();
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
