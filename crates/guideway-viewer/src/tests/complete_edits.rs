//! Edits that random input alone seldom completes: each selects what it needs, and types and
//! confirms what the window asks for.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::{Element, Elements, Group, SelectMode};
use guideway_scene::Table;
use guideway_spline::Point;

use super::random_input::{MAX_POINTS, RandomSource, close_dialogs};
use super::test_window::TestWindow;
use crate::command::Command;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// One of the edits; `None` if the layout lacks what it needs.
type Edit = fn(&mut TestWindow, &mut RandomSource) -> Option<()>;

/// Completes a random one of the edits. Returns its name.
pub(super) fn complete(window: &mut TestWindow, random: &mut RandomSource) -> &'static str {
    close_dialogs(window);
    for key in [Key::V, Key::U, Key::F] {
        window.key(NONE, key);
    }
    let (name, edit): (&str, Edit) = match random.below(9) {
        0 => ("complete join", join),
        1 => ("complete weld", weld),
        2 => ("complete property", set_property),
        3 => ("complete node move", move_node),
        4 => ("complete rename", rename),
        5 => ("complete copy of a group", copy_group),
        6 => ("complete rename of a group", rename_group),
        7 => ("complete deletion of a group", delete_group),
        _ => ("complete fillet", fillet),
    };
    let _ = edit(window, random);
    name
}

/// A random element of a table.
fn element(window: &mut TestWindow, random: &mut RandomSource, of: Table) -> Option<Element> {
    let document = window.document();
    let rows: Vec<u32> = document.existing(of).collect();
    let row = *rows.get(random.below(rows.len().max(1)))?;
    Some(match of {
        Table::Paths => Element::Path(row),
        Table::Nodes => Element::Node(row),
        Table::Stations => Element::Station(row),
    })
}

fn select(window: &mut TestWindow, element: Element) {
    window.change(move |document| {
        document.select_elements(&Elements::of(element), SelectMode::Replace);
    });
    window.harness.run_steps(2);
}

fn select_path(window: &mut TestWindow, random: &mut RandomSource) -> Option<u32> {
    let path = element(window, random, Table::Paths)?;
    select(window, path);
    Some(path.table_row().1)
}

/// Splits a path, and joins its pieces.
fn join(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    select_path(window, random)?;
    window.key(NONE, Key::K);
    window.key(NONE, Key::J);
    Some(())
}

/// Drags a path off its nodes, and welds the gaps.
fn weld(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    let path = select_path(window, random)?;
    let (start, end) = window.document().layout().paths.get(path as usize).ends()?;
    let middle = (start + end) * 0.5;
    let at = window.at(middle.x, middle.y);
    let by = Vec2::new(random.below(9) as f32 - 4.0, 6.0);
    window.press(at, NONE);
    window.harness.event(Event::PointerMoved(at + by));
    window.harness.step();
    window.release(at + by, CTRL);
    window.key(CTRL, Key::A);
    perform(window, Command::Weld);
    window.answer("1.5");
    Some(())
}

/// Types a number into a field of the properties of a path.
fn set_property(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    select_path(window, random)?;
    window.app().bottom.view = None;
    window.app().side.open(SideTab::Properties);
    window.harness.run_steps(3);
    let field = By::new().role(Role::TextInput);
    let fields: Vec<_> = window.harness.query_all(field).collect();
    fields.get(random.below(fields.len().max(1)))?.focus();
    drop(fields);
    window.harness.run_steps(2);
    window.key(CTRL, Key::A);
    let text = format!("{}.{:02}", random.below(90), random.below(100));
    window.harness.event(Event::Text(text));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    Some(())
}

/// Drags a node by the Points tool.
fn move_node(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    let node = element(window, random, Table::Nodes)?;
    select(window, node);
    let place = window.document().node_position_m(node.table_row().1);
    window.key(NONE, Key::P);
    let at = window.at(place.x, place.y);
    let mut step = || random.below(41) as f32 - 20.0;
    window.drag(at, at + Vec2::new(step(), step()));
    window.key(NONE, Key::V);
    Some(())
}

/// Gives a name that no element has.
fn rename(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    let tables = [Table::Paths, Table::Nodes, Table::Stations];
    let of = tables[random.below(3)];
    let element = element(window, random, of)?;
    select(window, element);
    window.key(NONE, Key::F2);
    window.answer(&format!("e{}", random.below(1 << 40)));
    Some(())
}

/// Selects a random level or vehicle type.
fn select_group(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    let layout = window.document().layout();
    let levels = (0..layout.levels.len() as u32).map(Group::Level);
    let types = layout.vehicle_type_names().into_iter();
    let types = types.map(|name| Group::VehicleType(name.to_owned()));
    let all: Vec<Group> = levels.chain(types).collect();
    let group = all.get(random.below(all.len().max(1)))?.clone();
    window.change(move |document| {
        document.select_elements(&Elements::of_group(&group), SelectMode::Replace);
    });
    window.harness.run_steps(2);
    Some(())
}

fn copy_group(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    if window.document().layout().paths.geometry().point_count() > MAX_POINTS {
        return None;
    }
    select_group(window, random)?;
    window.key(CTRL, Key::D);
    Some(())
}

/// Gives a name that no level and no vehicle type has.
fn rename_group(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    select_group(window, random)?;
    window.key(NONE, Key::F2);
    window.answer(&format!("g{}", random.below(1 << 40)));
    Some(())
}

/// Deletes a level or a vehicle type, with a random fate of what belongs to it.
fn delete_group(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    select_group(window, random)?;
    window.key(NONE, Key::Delete);
    window.harness.run_steps(3);
    let choices = By::new().role(Role::RadioButton);
    let choices: Vec<_> = window.harness.query_all(choices).collect();
    choices.get(random.below(choices.len().max(1)))?.click();
    drop(choices);
    window.harness.run_steps(2);
    let delete = By::new().role(Role::Button).label("Delete");
    window.harness.query(delete)?.click();
    window.harness.run_steps(3);
    Some(())
}

/// Draws a corner of two paths, and rounds it.
fn fillet(window: &mut TestWindow, random: &mut RandomSource) -> Option<()> {
    if window.document().layout().paths.geometry().point_count() > MAX_POINTS {
        return None;
    }
    let mut place = || random.below(2000) as f64 / 100.0 - 30.0;
    let (x, y) = (place(), place());
    window.key(NONE, Key::D);
    for (x, y) in [(x, y), (x + 4.0, y), (x + 4.0, y + 4.0)] {
        window.type_line(&format!("{x},{y}"));
    }
    window.key(NONE, Key::Enter);
    window.key(NONE, Key::V);
    let corner = window.document().node_near(Point::new(x + 4.0, y), 1e-3)?;
    select(window, Element::Node(corner));
    window.key(NONE, Key::Q);
    window.answer(["0.05", "0.2", "0.5"][random.below(3)]);
    Some(())
}

fn perform(window: &mut TestWindow, command: Command) {
    let ctx = window.harness.ctx.clone();
    window.app().perform(command, &ctx);
    window.harness.run_steps(2);
}

#[test]
fn each_edit_is_completed() {
    let edits: [(Edit, &[&str]); 9] = [
        (join, &["join"]),
        (weld, &["weld"]),
        (set_property, &["set property"]),
        (move_node, &["move node"]),
        (rename, &["rename"]),
        (fillet, &["fillet"]),
        (copy_group, &["paste"]),
        (rename_group, &["change level", "change vehicle type"]),
        (delete_group, &["delete"]),
    ];
    let mut window = TestWindow::showing(super::lane_network::network(6));
    let mut random = RandomSource(5);
    for (edit, names) in edits {
        let completed = (0..8).filter(|_| {
            close_dialogs(&mut window);
            window.key(NONE, Key::F);
            let before = window.document().state();
            edit(&mut window, &mut random);
            let document = window.document();
            let name = document.undo_redo_names().0;
            document.state() != before && name.is_some_and(|name| names.contains(&name))
        });
        assert!(completed.count() > 3, "{names:?}");
    }
}
