//! The New paths window: direction, greatest speed, vehicle types and further properties of what is
//! drawn.

use crate::language::{counted, say, t};
use crate::units::units;

/// Least and greatest speed of a field, in m/s.
const SPEEDS_M_S: [f64; 2] = [0.01, 100.0];
use eframe::egui::{Button, Context, DragValue, Pos2, TextEdit, Ui, Window};
use guideway_document::{Document, EdgeTemplate};
use guideway_layout::Direction;

/// The window, and the text of its vehicle types.
#[derive(Default)]
pub(crate) struct NewEdgesPanel {
    pub(crate) is_open: bool,
    types: String,
    /// The mistake in the text.
    error: Option<String>,
}

impl NewEdgesPanel {
    /// Gives new paths the new name of a vehicle type.
    pub(crate) fn rename_type(&mut self, template: &mut EdgeTemplate, old: &str, new: &str) {
        if template.rename_type(old, new) {
            (self.types, self.error) = (types_text(&template.vehicle_types), None);
        }
    }

    /// Shows the open window, at first at a point of the window, and changes the template.
    pub(super) fn show(
        &mut self,
        ctx: &Context,
        at: Pos2,
        document: Option<&Document>,
        template: &mut EdgeTemplate,
    ) {
        let mut is_open = self.is_open;
        let window = Window::new(t("New paths")).open(&mut is_open);
        window.resizable(false).default_pos(at).show(ctx, |ui| {
            let mut is_two_way = template.direction == Direction::Both;
            ui.checkbox(&mut is_two_way, t("Two-way"));
            template.direction = match is_two_way {
                true => Direction::Both,
                false => Direction::Forward,
            };
            ui.horizontal(|ui| {
                let mut has_speed = template.max_speed.is_some();
                ui.checkbox(&mut has_speed, t("Greatest speed"));
                let mut speed = template.max_speed.unwrap_or(1.0);
                if has_speed {
                    speed_field(ui, &mut speed);
                }
                template.max_speed = has_speed.then_some(speed);
            });
            let unit = units().speed.name();
            let label = ui.label(say!("Vehicle types, with their speeds in {unit}", unit));
            let field = TextEdit::singleline(&mut self.types)
                .hint_text("tugger: 1.5, stacker: 1.2")
                .desired_width(260.0);
            if ui.add(field).labelled_by(label.id).changed() {
                match read_types(&self.types) {
                    Ok(types) => (template.vehicle_types, self.error) = (types, None),
                    Err(error) => self.error = Some(error),
                }
            }
            if let Some(error) = &self.error {
                ui.colored_label(ui.visuals().error_fg_color, error);
            }
            ui.small(t("Without vehicle types, all may use the paths"));
            show_further(ui, template);
            let selected = document.and_then(|document| {
                let path = document.selection().min()?;
                Some((document, path))
            });
            let like = Button::new(t("As the selected path"));
            let like = ui.add_enabled(selected.is_some(), like);
            if let (true, Some((document, path))) = (like.clicked(), selected) {
                *template = document.template_of(path);
                (self.types, self.error) = (types_text(&template.vehicle_types), None);
            }
        });
        self.is_open = is_open;
    }
}

/// The number of further properties, with their names under the pointer, and a button that removes
/// them.
fn show_further(ui: &mut Ui, template: &mut EdgeTemplate) {
    let names = template.further_names();
    if names.is_empty() {
        return;
    }
    let (count, names) = (names.len() as u64, names.join(", "));
    ui.horizontal(|ui| {
        ui.label(counted(count, "further value"))
            .on_hover_text(names);
        let remove = ui.small_button("×");
        if remove.on_hover_text(t("Draw without them")).clicked() {
            *template = std::mem::take(template).without_further();
        }
    });
}

/// A field of a speed in m/s, in the unit of the settings.
pub(super) fn speed_field(ui: &mut Ui, speed_m_s: &mut f64) {
    let unit = units().speed;
    let mut shown = unit.of_m_s(*speed_m_s);
    let [least, most] = SPEEDS_M_S.map(|speed| unit.of_m_s(speed));
    let suffix = format!(" {}", unit.name());
    let field = DragValue::new(&mut shown).speed(5.0 * least);
    if ui.add(field.range(least..=most).suffix(suffix)).changed() {
        *speed_m_s = unit.to_m_s(shown);
    }
}

/// Vehicle types with their speeds, in the unit of the settings: `tugger: 1.5, stacker`.
///
/// # Errors
/// The mistake in a speed or a name.
fn read_types(text: &str) -> Result<Vec<(String, Option<f64>)>, String> {
    let mut types: Vec<(String, Option<f64>)> = Vec::new();
    for part in text
        .split(',')
        .map(str::trim)
        .filter(|part| !part.is_empty())
    {
        let (name, speed) = match part.rsplit_once(':') {
            Some((name, speed)) => {
                let value = speed.trim().parse::<f64>().ok();
                let value = value.filter(|speed| speed.is_finite() && *speed > 0.0);
                let value = value.ok_or_else(|| {
                    let speed = speed.trim();
                    say!("`{speed}` is no speed above 0; write `tugger: 1.5`", speed)
                })?;
                (name.trim(), Some(units().speed.to_m_s(value)))
            }
            None => (part, None),
        };
        if name.is_empty() {
            return Err(say!("`{part}` has no name before the colon", part));
        }
        if types.iter().any(|(other, _)| other == name) {
            return Err(say!("`{name}` is there twice", name));
        }
        types.push((name.to_owned(), speed));
    }
    Ok(types)
}

fn types_text(types: &[(String, Option<f64>)]) -> String {
    let text = |(name, speed): &(String, Option<f64>)| match speed {
        Some(speed) => format!("{name}: {}", units().speed.of_m_s(*speed)),
        None => name.clone(),
    };
    types.iter().map(text).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_read_as_they_are_written() {
        let types = read_types(" tugger: 1.5, stacker ,").unwrap();
        assert_eq!(
            types,
            [
                ("tugger".to_owned(), Some(1.5)),
                ("stacker".to_owned(), None)
            ]
        );
        assert_eq!(types_text(&types), "tugger: 1.5, stacker");
        for (text, part) in [
            ("tugger: fast", "`fast` is no speed"),
            ("tugger: 0", "`0` is no speed"),
            (": 1", "has no name"),
            ("a, a", "`a` is there twice"),
        ] {
            let error = read_types(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
