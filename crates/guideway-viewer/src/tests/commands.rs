//! Commands: which are possible and on, their icons and hints, the cursor, fixed scales.

use std::collections::HashSet;

use eframe::egui::accesskit::Role;
use eframe::egui::{CursorIcon, Event, Key, Modifiers, PointerButton, Vec2};
use egui_kittest::kittest::{By, NodeT, Queryable};
use guideway_document::decorations::handles;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, drawn_texts};
use crate::command::Command::{self, *};
use crate::command::MENUS;

const NONE: Modifiers = Modifiers::NONE;

fn all_commands() -> impl Iterator<Item = Command> {
    let groups = MENUS.iter().flat_map(|menu| menu.groups);
    groups.flat_map(|group| group.iter().copied())
}

#[test]
fn commands_that_need_a_file_are_grey_without_one() {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    // All others need a file, or a floor plan.
    let possible = [
        &[
            NewLayout,
            Open,
            OpenRecent,
            SaveProject,
            FloorPlan,
            Quit,
            Settings,
        ][..],
        &[ZoomToAll, ZoomToScale, ZoomIn, ZoomOut, Back, Forward],
        &[PanLeft, PanRight, PanUp, PanDown],
        &[
            Arrows, Symbols, Labels, Grid, SweptAreas, Density, ThesisRule, Dark, SidePanel,
        ],
        &[
            ToolSelect,
            ToolMeasure,
            Cancel,
            Shortcuts,
            ExampleSite,
            About,
        ],
    ]
    .concat();
    for command in all_commands() {
        let is_possible = window.app().command_state(1200.0).is_possible(command);
        assert_eq!(is_possible, possible.contains(&command), "{command:?}");
    }
    window.harness.get_by_label("File").click();
    window.harness.run_steps(3);
    for (entry, is_grey) in [("Save as…", true), ("Open recent…", false)] {
        let entry = window.harness.get_by_label_contains(entry);
        assert_eq!(entry.accesskit_node().is_disabled(), is_grey);
    }
}

#[test]
fn ticks_follow_the_switches_and_the_tool() {
    let mut window = TestWindow::showing(lanes(2));
    let ctx = window.harness.ctx.clone();
    let on = |window: &mut TestWindow| -> HashSet<u8> {
        let state = window.app().command_state(1200.0);
        let on = all_commands().filter(|command| state.is_on(*command));
        on.map(|command| command as u8).collect()
    };
    for switch in [
        Arrows, Symbols, Labels, Grid, Density, ThesisRule, Dark, SweptAreas, SidePanel, Table,
        Route, Compare, Network,
    ] {
        let before = on(&mut window);
        window.app().perform(switch, &ctx);
        window.harness.run_steps(2);
        let after = on(&mut window);
        let changed: Vec<_> = before.symmetric_difference(&after).collect();
        assert_eq!(changed, [&(switch as u8)]);
        window.app().perform(switch, &ctx);
        window.harness.run_steps(2);
        assert_eq!(on(&mut window), before, "{switch:?}");
    }
    let tools = [
        ToolSelect,
        ToolPoints,
        ToolMeasure,
        ToolLine,
        ToolArc,
        ToolCurve,
        ToolBezier,
        ToolNode,
        ToolStation,
    ];
    for tool in tools {
        window.app().perform(tool, &ctx);
        let on = on(&mut window);
        let on = tools.iter().filter(|other| on.contains(&(**other as u8)));
        assert_eq!(on.collect::<Vec<_>>(), [&tool]);
    }
}

#[test]
fn icons_tell_their_command_and_key_under_the_pointer() {
    let mut window = TestWindow::showing(lanes(2));
    let mut count = 0;
    for command in all_commands() {
        let name = command.name();
        let button = By::new().role(Role::Button).label(&name);
        let mut places = window.harness.query_all(button).map(|button| button.rect());
        // The buttons of the toolbar are squares.
        let Some(place) = places.find(|rect| rect.size() == Vec2::splat(20.0)) else {
            continue;
        };
        drop(places);
        count += 1;
        window.harness.event(Event::PointerMoved(place.center()));
        window.harness.run_steps(8);
        let texts = drawn_texts(&window);
        assert!(texts.iter().any(|text| text.starts_with(&name)), "{name}");
    }
    assert_eq!(count, 18);
}

#[test]
fn cursor_tells_what_a_press_would_do() {
    let mut window = TestWindow::showing(lanes(2));
    let cursor = |window: &mut TestWindow, x: f64, y: f64| {
        window.hover(x, y);
        window.cursor()
    };
    assert_eq!(cursor(&mut window, 5.0, 0.5), CursorIcon::Default);
    assert_eq!(cursor(&mut window, 5.0, 0.0), CursorIcon::PointingHand);
    window.key(Modifiers::COMMAND, Key::A);
    assert_eq!(cursor(&mut window, 5.0, 0.0), CursorIcon::Move);
    for key in [Key::D, Key::M] {
        window.key(NONE, key);
        assert_eq!(cursor(&mut window, 5.0, 0.0), CursorIcon::Crosshair);
    }
    // The Points tool moves control points and nodes, no paths.
    window.key(NONE, Key::P);
    assert_eq!(cursor(&mut window, 5.0, 0.0), CursorIcon::PointingHand);
    assert_eq!(cursor(&mut window, 10.0, 2.0), CursorIcon::Grab);
    let view = window.app().canvas.camera.view().unwrap();
    let handle = handles(window.document(), &view)[1].at_px;
    let at_m = view.world_from_pixel(handle);
    assert_eq!(cursor(&mut window, at_m.x, at_m.y), CursorIcon::Grab);
    let at = window.at(at_m.x, at_m.y);
    window.press(at, NONE);
    window
        .harness
        .event(Event::PointerMoved(at + Vec2::new(0.0, 40.0)));
    window.harness.run_steps(2);
    assert_eq!(window.cursor(), CursorIcon::Grabbing);
    window.release(at + Vec2::new(0.0, 40.0), NONE);
}

#[test]
fn cursor_grabs_while_the_view_is_panned() {
    let mut window = TestWindow::showing(lanes(2));
    let at = window.hover(5.0, 1.0);
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Middle,
        pressed,
        modifiers: NONE,
    };
    let to = at + Vec2::new(40.0, 20.0);
    for event in [button(at, true), Event::PointerMoved(to)] {
        window.harness.event(event);
        window.harness.step();
    }
    window.harness.step();
    assert_eq!(window.cursor(), CursorIcon::Grabbing);
    window.harness.event(button(to, false));
    window.harness.run_steps(2);
    assert_eq!(window.cursor(), CursorIcon::Default);
}

#[test]
fn fixed_scale_is_one_to_a_hundred() {
    let mut window = TestWindow::showing(lanes(2));
    let center = |window: &mut TestWindow| window.app().canvas.camera.view().unwrap().center_m();
    let before = center(&mut window);
    window.key(Modifiers::COMMAND, Key::Num1);
    assert!(window.harness.query_by_label("1:100").is_some());
    assert_eq!(center(&mut window), before);
    window.key(Modifiers::COMMAND, Key::Num0);
    assert!(window.harness.query_by_label("1:100").is_none());
}
