//! The prompt for a file name or a floor plan.

use std::path::{Path, PathBuf};

use eframe::egui::{Context, DragValue, Id, Key, Modal, TextEdit};

use crate::action::{Action, Export};

/// Width of an exported PNG until the user changes it, in pixels: 4K UHD.
const DEFAULT_WIDTH_PX: u32 = 3840;
/// Greatest side of a frame, in pixels.
const MAX_WIDTH_PX: u32 = 65_535;

/// The purpose of a prompt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PromptKind {
    Open,
    SaveAs,
    ExportPng,
    ExportSvg,
    FloorPlan,
}

impl PromptKind {
    fn title(self) -> &'static str {
        match self {
            Self::Open => "Open file",
            Self::SaveAs => "Save as (the extension selects the format)",
            Self::ExportPng => "Export PNG file",
            Self::ExportSvg => "Export SVG file",
            Self::FloorPlan => {
                "Floor plan: an image with its scale, such as \
                 hall.png@px-per-m=20,offset=-3,-2,rotate=90, a map.yaml of ROS, or any layout or \
                 drawing. Empty removes the floor plan."
            }
        }
    }

    /// The suggested text, derived from the active file.
    fn suggestion(self, file: Option<&Path>) -> PathBuf {
        let with = |extension| file.map(|file| file.with_extension(extension));
        let suggestion = match self {
            Self::Open | Self::FloorPlan => None,
            Self::SaveAs => file.map(Path::to_owned),
            Self::ExportPng => with("png"),
            Self::ExportSvg => with("svg"),
        };
        suggestion.unwrap_or_default()
    }

    /// The action of an answer; `None` for an empty file name.
    fn action(self, text: &str, width_px: u32) -> Option<Action> {
        let path = PathBuf::from(text.trim());
        if self == Self::FloorPlan {
            return Some(Action::SetFloorPlan(text.to_owned()));
        }
        if path.as_os_str().is_empty() {
            return None;
        }
        Some(match self {
            Self::Open => Action::Open(path),
            Self::SaveAs => Action::SaveAs(path),
            Self::ExportPng => Action::Export(Export::Png { path, width_px }),
            Self::ExportSvg => Action::Export(Export::Svg { path }),
            Self::FloorPlan => return None,
        })
    }
}

/// The open prompt, if any.
#[derive(Default)]
pub(crate) struct Prompt {
    open: Option<OpenPrompt>,
}

pub(crate) struct OpenPrompt {
    kind: PromptKind,
    pub(crate) text: String,
    /// Width of an exported PNG, in pixels.
    pub(crate) width_px: u32,
    /// True if the text field takes the focus in the next frame.
    wants_focus: bool,
}

impl Prompt {
    /// Opens a prompt that suggests a name derived from the active file.
    pub(crate) fn ask(&mut self, kind: PromptKind, file: Option<&Path>) {
        let text = kind.suggestion(file).to_string_lossy().into_owned();
        self.ask_with_text(kind, text);
    }

    /// Opens a prompt with this text.
    pub(crate) fn ask_with_text(&mut self, kind: PromptKind, text: String) {
        self.open = Some(OpenPrompt {
            kind,
            text,
            width_px: DEFAULT_WIDTH_PX,
            wants_focus: true,
        });
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    #[cfg(test)]
    pub(crate) fn open_mut(&mut self) -> Option<&mut OpenPrompt> {
        self.open.as_mut()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let prompt = self.open.as_mut()?;
        let (mut is_answered, mut is_cancelled) = (false, false);
        let modal = Modal::new(Id::unique("prompt")).show(ctx, |ui| {
            let title = ui.label(prompt.kind.title());
            let field = TextEdit::singleline(&mut prompt.text).desired_width(480.0);
            let field = ui.add(field).labelled_by(title.id);
            if std::mem::take(&mut prompt.wants_focus) {
                field.request_focus();
            }
            if prompt.kind == PromptKind::ExportPng {
                ui.horizontal(|ui| {
                    ui.label("Width");
                    let width = DragValue::new(&mut prompt.width_px);
                    ui.add(width.range(1..=MAX_WIDTH_PX).suffix(" px"));
                });
            }
            ui.horizontal(|ui| {
                let enters = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                is_answered = ui.button("OK").clicked() || enters;
                is_cancelled = ui.button("Cancel").clicked();
            });
        });
        let is_closed = is_answered || is_cancelled || modal.should_close();
        let prompt = self.open.take_if(|_| is_closed)?;
        match is_answered {
            true => prompt.kind.action(&prompt.text, prompt.width_px),
            false => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_a_name_beside_the_active_file() {
        let suggest = |kind: PromptKind| kind.suggestion(Some(Path::new("a/site.lif.json")));
        assert_eq!(suggest(PromptKind::SaveAs), Path::new("a/site.lif.json"));
        assert_eq!(suggest(PromptKind::ExportPng), Path::new("a/site.lif.png"));
        assert_eq!(suggest(PromptKind::Open), Path::new(""));
    }

    #[test]
    fn empty_answer_opens_nothing_but_removes_a_floor_plan() {
        assert!(PromptKind::Open.action("  ", 1).is_none());
        let action = PromptKind::FloorPlan.action("", 1);
        assert!(matches!(action, Some(Action::SetFloorPlan(text)) if text.is_empty()));
    }
}
