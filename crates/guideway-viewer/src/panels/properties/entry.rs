//! The fields in which a user types: the widget of one, and the text that is being typed.

use eframe::egui::{Label, TextEdit, Ui};
use guideway_layout::Property;

use super::draft::{Draft, Target};
use super::field::{Common, Field, FieldKind};
use super::pickers;
use crate::action::Action;
use crate::editing::EditTask;
use crate::language::{t, translated};
use crate::panels::text_focus::focus_all;
use crate::units::shown_unit;

/// Least width of the names, in points.
const NAME_WIDTH: f32 = 130.0;
/// Greatest width: that of the longest name with its unit.
const MAX_NAME_WIDTH: f32 = 200.0;

/// The text that is being typed, and its preview.
#[derive(Default)]
pub(super) struct Entry {
    draft: Option<Draft>,
    /// The field that takes the focus once it is shown.
    wants_focus: Option<Target>,
    /// The text of a field that the drawing ought to show, and the one that it shows.
    wanted: Option<(Target, String)>,
    previewed: Option<(Target, String)>,
}

impl Entry {
    /// The edit of a text that was typed but not confirmed yet.
    pub(super) fn commit(&mut self) -> Vec<Action> {
        let edit = self.draft.take().map_or(Ok(None), Draft::edit);
        let mut actions = Vec::from_iter(self.discard());
        match edit {
            // It takes the preview back.
            Ok(Some(edit)) => return vec![edit],
            Ok(None) => {}
            Err(error) => actions.push(Action::Notify(error)),
        }
        actions
    }

    /// Returns `true` if a text is being typed.
    pub(super) fn has_draft(&self) -> bool {
        self.draft.is_some()
    }

    /// Gives the focus to the field of a target once it is shown.
    pub(super) fn focus(&mut self, target: Target) {
        self.wants_focus = Some(target);
    }

    /// Takes back a text that was typed but not confirmed.
    pub(super) fn discard(&mut self) -> Option<Action> {
        self.draft = None;
        let shown = self.previewed.take();
        shown.map(|_| Action::Edit(EditTask::end_preview()))
    }

    /// The drawing ought to show this choice, if there is one.
    pub(super) fn want(&mut self, hovered: Option<(Target, String)>) {
        self.wanted = hovered.or(self.wanted.take());
    }

    /// Shows in the drawing what is typed or pointed at.
    pub(super) fn show_preview(&mut self, actions: &mut Vec<Action>) {
        let wanted = self.wanted.take();
        if wanted != self.previewed {
            let preview = wanted
                .as_ref()
                .and_then(|(target, text)| target.preview(text));
            self.previewed = wanted.filter(|_| preview.is_some());
            actions.push(Action::Edit(preview.unwrap_or_else(EditTask::end_preview)));
        }
    }

    /// Shows a field for values of a kind.
    pub(super) fn typed_field(
        &mut self,
        ui: &mut Ui,
        target: Target,
        (kind, value): (FieldKind, &Common),
        actions: &mut Vec<Action>,
    ) {
        let words: &[&str] = match kind {
            FieldKind::Flag => &["true", "false"],
            FieldKind::Choice(words) => words,
            _ => return self.text_field(ui, target, value, actions),
        };
        let hovered = pickers::choice(ui, target, value, words, actions);
        self.want(hovered);
    }

    /// Shows a field for a text.
    pub(super) fn text_field(
        &mut self,
        ui: &mut Ui,
        target: Target,
        value: &Common,
        actions: &mut Vec<Action>,
    ) {
        let (before, hint) = match value {
            Common::Same(value) => (value.clone(), ""),
            Common::None => (String::new(), t("none")),
            Common::Several => (String::new(), t("several values")),
        };
        let typed = self.draft.as_ref().filter(|draft| draft.target == target);
        let mut text = typed.map_or_else(|| before.clone(), |draft| draft.text.clone());
        let field = TextEdit::singleline(&mut text).hint_text(hint);
        let response = ui.add(field.desired_width(pickers::field_width(ui)));
        if self
            .wants_focus
            .take_if(|wanted| *wanted == target)
            .is_some()
        {
            focus_all(ui.ctx(), &response, &text);
        }
        let has_focus = response.has_focus();
        let is_typed = self
            .draft
            .as_ref()
            .is_some_and(|draft| draft.target == target);
        if has_focus && !is_typed {
            // Another field is left.
            actions.extend(self.commit());
        }
        if has_focus || response.lost_focus() && is_typed {
            if has_focus && text != before && target.preview(&text).is_some() {
                self.wanted = Some((target.clone(), text.clone()));
            }
            self.draft = Some(Draft {
                target,
                text,
                before,
            });
        }
        if response.lost_focus() && is_typed {
            actions.extend(self.commit());
        }
    }
}

/// Width of the names beside the fields, in points.
pub(super) fn name_width(ui: &Ui) -> f32 {
    (0.5 * ui.available_width()).clamp(NAME_WIDTH, MAX_NAME_WIDTH)
}

/// Shows the name of a field with its unit, and its meaning under the pointer.
pub(super) fn show_name(ui: &mut Ui, field: &Field) {
    let name = match field.unit {
        Some(unit) => format!("{} ({})", field.name, shown_unit(unit)),
        None => field.name.clone(),
    };
    let label = ui.add(Label::new(&name).truncate());
    if label.contains_pointer() {
        let known = Property::named(&field.name);
        label.on_hover_text(translated(
            known.map_or(&*name, |property| property.meaning),
        ));
    }
}
