//! The route: its places, vehicle, length, time and steps.

use eframe::egui::{Button, ComboBox, Label, RichText, ScrollArea, Ui};
use guideway_document::{Element, text_format};

use super::slider::slider;
use crate::action::Action;
use crate::files::OpenFiles;
use crate::language::{counted, say, t, translated};
use crate::route::{FoundRoute, RouteSearch, Slot};
use crate::units::units;

const ROW_HEIGHT: f32 = 18.0;

/// Shows the view.
pub(super) fn show(
    ui: &mut Ui,
    files: &OpenFiles,
    search: &mut RouteSearch,
    actions: &mut Vec<Action>,
) {
    ui.horizontal(|ui| {
        show_place(ui, search, Slot::From, t("From"));
        let turn = ui.small_button(RichText::new("⇄").monospace());
        if turn.on_hover_text(t("Exchange start and goal")).clicked() {
            search.turn_around();
        }
        show_place(ui, search, Slot::To, t("To"));
        show_vehicle_type(ui, files, search);
        ui.checkbox(&mut search.shows_area, t("Swept area"))
            .on_hover_text(t(
                "The area that the vehicle of View > Vehicle covers along the route",
            ));
        if search.is_busy() {
            ui.spinner();
        }
    });
    match search.result(files.active_index()) {
        None => {
            let hint = match search.picking() {
                Some(Slot::From) => t("Click the station or node where the route starts"),
                Some(Slot::To) => t("Click the station or node where the route ends"),
                None => t("Choose start and goal"),
            };
            ui.label(hint);
        }
        Some(Err(why)) => {
            ui.add(Label::new(translated(why)).wrap());
        }
        Some(Ok(route)) => {
            let (sums, length_m) = (sums(route), route.track.length_m());
            let mut driven = search.driven;
            ui.horizontal(|ui| {
                ui.strong(sums);
                let label = ui.label(t("vehicle"));
                slider(ui, &mut driven).labelled_by(label.id);
                ui.monospace(format!("{:.1} m", f64::from(driven) * length_m));
            });
            show_steps(ui, route, actions);
            search.driven = driven;
        }
    }
}

fn show_place(ui: &mut Ui, search: &mut RouteSearch, slot: Slot, label: &str) {
    let name = search.place(slot).map_or(t("choose…"), |place| &place.name);
    let button = Button::new(format!("{label}: {name}"));
    let button = button.selected(search.picking() == Some(slot));
    let hint = t("Then click a station or node in the drawing");
    if ui.add(button).on_hover_text(hint).clicked() {
        search.pick(slot);
    }
}

fn show_vehicle_type(ui: &mut Ui, files: &OpenFiles, search: &mut RouteSearch) {
    let document = files.document();
    let names = document.map_or(&[][..], |d| d.layout().paths.vehicle_types().names());
    let Some(first) = names.first() else {
        return;
    };
    let chosen = search.vehicle_type.as_ref();
    let chosen = chosen.filter(|name| names.contains(name)).unwrap_or(first);
    let chosen = chosen.clone();
    ComboBox::from_label(t("vehicle type"))
        .selected_text(&chosen)
        .show_ui(ui, |ui| {
            for name in names {
                if ui.selectable_label(*name == chosen, name).clicked() {
                    search.vehicle_type = Some(name.clone());
                }
            }
        });
}

/// `3 paths, 120 m, 2 min 5 s`.
fn sums(route: &FoundRoute) -> String {
    let paths = counted(route.steps.len() as u64, "path");
    let length = text_format::length(route.length_m);
    format!("{paths}, {length}, {}", time_text(route.time_s))
}

/// `8.3 s`, `2 min 5 s`.
fn time_text(time_s: f64) -> String {
    match time_s {
        s if s < 60.0 => format!("{s:.1} s"),
        s => format!("{} min {:.0} s", (s / 60.0).floor(), (s % 60.0).floor()),
    }
}

fn show_steps(ui: &mut Ui, route: &FoundRoute, actions: &mut Vec<Action>) {
    let scroll = ScrollArea::vertical().auto_shrink(false);
    scroll.show_rows(ui, ROW_HEIGHT, route.steps.len(), |ui, rows| {
        for number in rows {
            let step = &route.steps[number];
            let row = &step.row;
            let turn = match row.turn_s > 0.0 {
                true => say!(
                    "turn by {angle}° in {time}, ",
                    angle = format!("{:.0}", row.turn_rad.to_degrees()),
                    time = time_text(row.turn_s)
                ),
                false => String::new(),
            };
            let text = say!(
                "{number}. {turn}{path} to {to}: {length} at {speed} {unit}, {time}; after {all}",
                number = number + 1,
                turn,
                path = step.path,
                to = step.to,
                length = text_format::length(row.length_m),
                speed = format!("{:.2}", units().speed.of_m_s(row.speed_m_s)),
                unit = units().speed.name(),
                time = time_text(row.drive_s),
                all = time_text(row.end_s),
            );
            if ui.link(text).clicked() {
                actions.push(Action::ZoomTo(Element::Path(row.path)));
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_minutes_and_seconds() {
        let texts = [0.0, 8.34, 59.9, 60.0, 125.9].map(time_text);
        assert_eq!(
            texts,
            ["0.0 s", "8.3 s", "59.9 s", "1 min 0 s", "2 min 5 s"]
        );
    }
}
