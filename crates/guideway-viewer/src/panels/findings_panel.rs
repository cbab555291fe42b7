//! The Findings tab: results of the checks, their fixes, and the options of the next check.

use eframe::egui::text::LayoutJob;
use eframe::egui::{
    CollapsingHeader, Color32, DragValue, FontId, RichText, TextFormat, Ui, WidgetText,
};
use guideway_document::{
    Document, Element, ProposedFix, fix_all, fixes, has_fixes, locate, located,
};
use guideway_layout::{CheckOptions, Code, Diagnostic, Diagnostics, FindingKind};

use crate::action::Action;
use crate::canvas::severity_color;
use crate::editing::{EditTask, MarkedSeverities, SEVERITIES};
use crate::files::{Layer, OpenFiles};
use crate::language::{counted, grouped, say, t, translated};

/// Longest list of findings of one kind.
const MAX_LISTED: usize = 200;

/// The options of the next check, and the findings that the drawing shows.
#[derive(Default)]
pub(crate) struct FindingsPanel {
    /// Bends tighter than this radius are findings; 0 turns that check off.
    pub(crate) min_radius_m: f64,
    pub(crate) marked: MarkedSeverities,
}

impl FindingsPanel {
    /// The options of the next check.
    pub(crate) fn check_options(&self) -> CheckOptions {
        CheckOptions {
            min_radius_m: Some(self.min_radius_m).filter(|radius_m| *radius_m > 0.0),
            ..CheckOptions::default()
        }
    }

    /// The name of the tab, with the number of errors, warnings and notes in their colors; of the
    /// worst ones alone where there is little space. Colors do not show on the tab in front.
    pub(super) fn title(
        files: &OpenFiles,
        points: f32,
        is_short: bool,
        is_in_front: bool,
    ) -> WidgetText {
        let findings = files.active().and_then(|layer| layer.tasks.findings());
        let counts = findings.map_or([0; 3], |findings| by_severity(&findings.diagnostics));
        title(counts, points, is_short, is_in_front).into()
    }

    /// Shows the tab.
    pub(super) fn show(&mut self, ui: &mut Ui, files: &OpenFiles, actions: &mut Vec<Action>) {
        let Some(layer) = files.active() else {
            ui.label(t("No file is open"));
            return;
        };
        self.show_check(ui, layer, actions);
        let Some(findings) = layer.tasks.findings() else {
            return;
        };
        self.show_switches(ui, by_severity(&findings.diagnostics));
        let state = layer.document().map(|document| document.state());
        if state.is_some_and(|state| state != findings.state) {
            ui.small(t("These findings predate the last change"));
        }
        if findings.diagnostics.is_empty() {
            ui.label(t("No findings"));
        }
        for kind in FindingKind::of([&findings.diagnostics]) {
            let list = KindList {
                kind,
                findings: &findings.diagnostics,
                document: layer.document(),
            };
            list.show(ui, actions);
        }
    }

    fn show_check(&mut self, ui: &mut Ui, layer: &Layer, actions: &mut Vec<Action>) {
        ui.horizontal_wrapped(|ui| {
            let radius = DragValue::new(&mut self.min_radius_m).range(0.0..=1000.0);
            let radius = radius.speed(0.05).prefix(t("Minimum radius ")).suffix(" m");
            ui.add(radius).on_hover_text(t(
                "Bends tighter than this are findings; 0 turns this check off",
            ));
            let can_check = layer.document().is_some() && !layer.tasks.is_checking();
            ui.add_enabled_ui(can_check, |ui| {
                if ui.button(t("Check again")).clicked() {
                    actions.push(Action::Check(self.check_options()));
                }
            });
            if layer.tasks.is_checking() {
                ui.spinner();
            }
        });
    }

    /// Shows a switch per severity for the marks in the drawing.
    fn show_switches(&mut self, ui: &mut Ui, counts: [u64; 3]) {
        ui.horizontal_wrapped(|ui| {
            ui.label(t("In the drawing:"));
            let names = ["error", "warning", "note"].into_iter().zip(SEVERITIES);
            let switches = self.marked.0.iter_mut().zip(counts);
            for ((name, severity), (is_on, count)) in names.zip(switches) {
                let text = RichText::new(counted(count, name));
                ui.checkbox(is_on, text.color(severity_color(severity)));
            }
        });
    }
}

/// Numbers of errors, warnings and notes.
fn by_severity(findings: &Diagnostics) -> [u64; 3] {
    let [errors, warnings, all] = SEVERITIES.map(|severity| findings.count_at_least(severity));
    [errors, warnings - errors, all - warnings]
}

/// The findings of one kind.
struct KindList<'a> {
    kind: FindingKind,
    findings: &'a Diagnostics,
    document: Option<&'a Document>,
}

impl KindList<'_> {
    fn show(&self, ui: &mut Ui, actions: &mut Vec<Action>) {
        let FindingKind {
            code,
            severity,
            count,
        } = self.kind;
        let title = format!("{} ({})", t(&title_of(code)), grouped(count));
        let title = RichText::new(title).color(severity_color(severity));
        let header = CollapsingHeader::new(title).id_salt((code, severity as u8));
        header.show(ui, |ui| {
            ui.small(t(code.meaning()));
            let of_kind = || self.findings.iter().filter(|f| self.kind.has(f));
            if let Some(fix) = self.fix_all(of_kind()) {
                offer(ui, &fix, actions);
            }
            for (number, finding) in of_kind().take(MAX_LISTED).enumerate() {
                ui.push_id(number, |ui| self.show_finding(ui, finding, actions));
            }
            let more = count.saturating_sub(MAX_LISTED as u64);
            if more > 0 {
                ui.small(say!("and {count} more", count = grouped(more)));
            }
        });
    }

    fn show_finding(&self, ui: &mut Ui, finding: &Diagnostic, actions: &mut Vec<Action>) {
        let link = ui.link(finding_text(finding));
        let link = link.on_hover_text(translated(&finding.remedy));
        if let (true, Some(document)) = (link.clicked(), self.document) {
            actions.push(match locate(document.layout(), &finding.place) {
                Some(element) => Action::ZoomTo(element),
                None => Action::Notify(say!(
                    "{place} has no position in the plane",
                    place = translated(&finding.place.to_string())
                )),
            });
        }
        let element = located(&finding.place).filter(|_| has_fixes(finding.code));
        if let (Some(element), Some(document)) = (element, self.document) {
            ui.menu_button(t("Fix"), |ui| {
                let proposed = fixes(document, finding.code, element);
                if proposed.is_empty() {
                    ui.label(t("Nothing can be done here automatically"));
                }
                for fix in proposed {
                    if offer(ui, &fix, actions) {
                        ui.close();
                    }
                }
            });
        }
    }

    fn fix_all<'f>(&self, findings: impl Iterator<Item = &'f Diagnostic>) -> Option<ProposedFix> {
        let document = self.document.filter(|_| has_fixes(self.kind.code))?;
        let elements = findings.filter_map(|finding| located(&finding.place));
        let elements: Vec<Element> = elements.collect();
        fix_all(document, self.kind.code, &elements).filter(|_| elements.len() > 1)
    }
}

/// Offers a fix. Returns `true` if it is clicked.
fn offer(ui: &mut Ui, proposed: &ProposedFix, actions: &mut Vec<Action>) -> bool {
    let is_clicked = ui.button(translated(&proposed.label)).clicked();
    if is_clicked {
        let fix = proposed.fix.clone();
        let edit = move |document: &mut Document| document.fix(&fix);
        actions.push(Action::Edit(EditTask::edit(edit)));
    }
    is_clicked
}

/// Place and message of a finding in the language of the window.
pub(super) fn finding_text(finding: &Diagnostic) -> String {
    let place = finding.place.to_string();
    format!("{}: {}", translated(&place), translated(&finding.message))
}

/// The name of the tab and these numbers of errors, warnings and notes.
fn title(counts: [u64; 3], points: f32, is_short: bool, is_in_front: bool) -> LayoutJob {
    let mut title = LayoutJob::default();
    let mut add = |text: &str, color: Color32| {
        let format = TextFormat {
            color,
            font_id: FontId::proportional(points),
            ..TextFormat::default()
        };
        title.append(text, 0.0, format);
    };
    add(t("Findings"), Color32::PLACEHOLDER);
    let counted = counts.into_iter().zip(SEVERITIES);
    let counted = counted.filter(|(count, _)| *count > 0);
    for (count, severity) in counted.take(if is_short { 1 } else { counts.len() }) {
        let count = format!(" {}", grouped(count));
        let color = match is_in_front {
            true => Color32::PLACEHOLDER,
            false => severity_color(severity),
        };
        add(&count, color);
    }
    title
}

/// The name of a code in words: `Reverse pair`.
pub(crate) fn title_of(code: Code) -> String {
    let words = code.name().replace('-', " ");
    let mut letters = words.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Place, Severity};

    use super::*;

    #[test]
    fn radius_zero_turns_the_check_off() {
        let mut panel = FindingsPanel::default();
        assert_eq!(panel.check_options().min_radius_m, None);
        panel.min_radius_m = 0.5;
        assert_eq!(panel.check_options().min_radius_m, Some(0.5));
    }

    #[test]
    fn counts_of_the_tab_are_legible_in_front_and_behind() {
        let colors = |is_in_front| {
            let title = title([2, 0, 70], 12.0, false, is_in_front);
            assert_eq!(title.text, "Findings 2 70");
            let parts = title.sections.iter().map(|part| part.format.color);
            let mut colors: Vec<_> = parts.collect();
            colors.dedup();
            colors
        };
        let [errors, _, notes] = SEVERITIES.map(severity_color);
        assert_eq!(colors(false), [Color32::PLACEHOLDER, errors, notes]);
        // That of the text of the selected tab.
        assert_eq!(colors(true), [Color32::PLACEHOLDER]);
    }

    #[test]
    fn findings_are_counted_by_severity() {
        let mut found = Diagnostics::default();
        for severity in [Severity::Info, Severity::Info, Severity::Error] {
            found.push_as(severity, Code::Kink, Place::default, String::new, "");
        }
        assert_eq!(by_severity(&found), [1, 0, 2]);
        assert_eq!(title_of(Code::ReversePair), "Reverse pair");
    }
}
