//! The question before a layout is saved in a format that cannot hold all of it.

use std::path::PathBuf;

use eframe::egui::{Context, Id, Modal, ScrollArea};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::command::Command;
use crate::language::{counted, say, t, translated};
use crate::services::LostPart;

/// Most names of one line; the rest is counted.
const MAX_NAMES: usize = 12;
/// Greatest size of the list, in points.
const SIZE: [f32; 2] = [480.0, 280.0];

/// The dialog; open while a save waits for its answer.
#[derive(Default)]
pub(crate) struct LossDialog {
    save: Option<(PathBuf, Vec<LostPart>)>,
}

impl LossDialog {
    /// Asks whether a file may lack these parts.
    pub(crate) fn ask(&mut self, path: PathBuf, losses: Vec<LostPart>) {
        self.save = Some((path, losses));
    }

    pub(crate) fn is_open(&self) -> bool {
        self.save.is_some()
    }

    pub(super) fn close(&mut self) {
        self.save = None;
    }

    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let (path, losses) = self.save.as_ref()?;
        let (mut saves, mut chooses, mut cancels) = (false, false, false);
        Modal::new(Id::unique("losses")).show(ctx, |ui| {
            ui.set_max_width(SIZE[0]);
            ui.label(say!(
                "The format of {file} cannot hold, or holds in another form:",
                file = shown_path(path)
            ));
            let list = ScrollArea::vertical().max_height(SIZE[1]);
            list.show(ui, |ui| {
                for line in grouped(losses) {
                    ui.label(line);
                }
            });
            ui.horizontal(|ui| {
                saves = ui.button(t("Save anyway")).clicked();
                chooses = ui.button(t("Choose another format")).clicked();
                cancels = ui.button(t("Cancel")).clicked();
            });
        });
        let (path, losses) = self.save.take_if(|_| saves || chooses || cancels)?;
        match (saves, chooses) {
            (true, _) => Some(Action::SaveLossy(path, losses)),
            (_, true) => Some(Action::Command(Command::SaveAs)),
            _ => None,
        }
    }
}

/// One line per kind of part: columns with their names and counts, other parts by count.
fn grouped(losses: &[LostPart]) -> Vec<String> {
    let mut lines: Vec<(&str, Vec<String>)> = Vec::new();
    for loss in losses {
        match loss.what.strip_prefix("column ") {
            Some(column) => {
                let item = format!("{column} ({})", loss.count);
                match lines.iter_mut().find(|(detail, _)| *detail == loss.detail) {
                    Some((_, items)) => items.push(item),
                    None => lines.push((&loss.detail, vec![item])),
                }
            }
            None => lines.push((&loss.detail, vec![loss.count.to_string()])),
        }
    }
    let line = |(detail, mut items): (&str, Vec<String>)| {
        let more = items.len().saturating_sub(MAX_NAMES);
        items.truncate(MAX_NAMES);
        if more > 0 {
            items.push(say!(
                "and {more}",
                more = counted(more as u64, "more column")
            ));
        }
        format!("• {}: {}", translated(detail), items.join(", "))
    };
    lines.into_iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_grouped_by_name_and_count() {
        let lost = |what: &str, count, detail: &str| LostPart {
            what: what.into(),
            count,
            detail: detail.into(),
        };
        let mut losses = vec![
            lost("stations", 3, "stations"),
            lost("column vmax", 75, "values of paths"),
            lost("column color", 4, "values of nodes"),
            lost("column lane", 9, "values of paths"),
        ];
        let lines = [
            "• stations: 3",
            "• values of paths: vmax (75), lane (9)",
            "• values of nodes: color (4)",
        ];
        assert_eq!(grouped(&losses), lines);
        losses.extend((0..20).map(|n| lost(&format!("column c{n}"), 1, "values of paths")));
        assert!(grouped(&losses)[1].ends_with("c9 (1), and 10 more columns"));
    }
}
