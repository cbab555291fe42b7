//! The side panel: tabs with fixed places, resized, hidden and steady.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use eframe::egui::epaint::ClippedShape;
use eframe::egui::{Context, Event, Key, Modifiers, Pos2, RawInput, Rect, Shape, Vec2};
use egui_kittest::kittest::Queryable;
use guideway_document::Document;
use guideway_layout::Value;

use super::services::{TestServices, lanes};
use super::test_window::TestWindow;
use crate::LaunchOptions;
use crate::app::App;
use crate::command::Command;
use crate::editing::EditTask;
use crate::language::Language;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Left edge of the canvas' right neighbor.
fn canvas_width(window: &mut TestWindow) -> f32 {
    window.app().canvas.screen().rect.width()
}

fn place_of(window: &TestWindow, label: &str) -> Pos2 {
    window.harness.get_by_label(label).rect().min
}

#[test]
fn panel_keeps_still_while_pointer_and_selection_change() {
    let mut layout = lanes(5);
    let long = "a name that is far longer than the side panel is wide, and then some more of it";
    layout.paths.set_ids(&[(2, long)]);
    let mut window = TestWindow::showing(layout);
    let at = window.at(5.0, 8.0);
    window.click(at);
    window.harness.run_steps(3);
    let before = (canvas_width(&mut window), place_of(&window, "Move"));
    for y in [0.0, 4.0, 6.0] {
        let at = window.at(5.0, y);
        window.harness.event(Event::PointerMoved(at));
        window.harness.run_steps(3);
        let hovered = (canvas_width(&mut window), place_of(&window, "Move"));
        assert_eq!(hovered, before, "hover");
        window.click(at);
        window.harness.run_steps(3);
        let selected = (canvas_width(&mut window), place_of(&window, "Move"));
        assert_eq!(selected, before, "selection");
    }
    for tab in SideTab::ALL {
        window.app().side.open(tab);
        window.harness.run_steps(3);
        assert_eq!(canvas_width(&mut window), before.0, "{}", tab.name());
    }
}

#[test]
fn fields_stay_while_an_edit_is_in_progress() {
    let mut window = TestWindow::showing(lanes(3));
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.harness.run_steps(2);
    let before = place_of(&window, "direction");
    let (finish, rest) = std::sync::mpsc::channel::<()>();
    window.app().edit_wait = Duration::ZERO;
    window.change(move |_: &mut Document| {
        let _ = rest.recv();
    });
    window.harness.run_steps(3);
    assert!(window.app().document().is_none(), "the edit has it");
    assert_eq!(place_of(&window, "direction"), before);
    drop(finish);
    window.wait(|app| app.document().is_some());
}

#[test]
fn panel_is_hidden_by_its_key_and_in_a_small_window() {
    let mut window = TestWindow::showing(lanes(3));
    let with = canvas_width(&mut window);
    window.key(NONE, Key::F9);
    assert!(canvas_width(&mut window) > with + 100.0);
    // A search shows the panel again.
    window.key(CTRL, Key::F);
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label("Query").is_some());
    assert!((canvas_width(&mut window) - with).abs() < 1.0);
    let mut small = TestWindow::showing(lanes(3));
    small.harness.set_size(Vec2::new(340.0, 260.0));
    small.harness.run_steps(3);
    // The harness has margins.
    assert!(canvas_width(&mut small) > 310.0);
    small.key(NONE, Key::F9);
    small.harness.run_steps(2);
    assert!(canvas_width(&mut small) >= 100.0);
}

#[test]
fn edge_of_the_panel_is_dragged() {
    let mut window = TestWindow::showing(lanes(3));
    let rect = window.app().canvas.screen().rect;
    let from = Pos2::new(rect.right() + 1.0, rect.center().y);
    window.drag(from, from - Vec2::new(100.0, 0.0));
    window.harness.run_steps(3);
    let width = canvas_width(&mut window);
    assert!((rect.width() - width - 100.0).abs() < 10.0, "{width}");
}

#[test]
fn value_of_one_vehicle_type_is_added_and_removed() {
    let mut layout = lanes(2);
    layout.paths.vehicle_types_mut().set(0, &["fork", "tug"]);
    let mut window = TestWindow::showing(layout);
    let at = window.at(5.0, 0.0);
    window.click(at);
    window.harness.run_steps(2);
    let own = |window: &mut TestWindow| {
        let types = window.document().layout().paths.vehicle_types();
        let entry = types.entry_for(0, "tug").unwrap();
        match types.attributes.value(entry, "speed") {
            Some(Value::Float(speed)) => Some(speed),
            _ => None,
        }
    };
    assert_eq!(own(&mut window), None);
    window.harness.get_by_label("+").click();
    window.harness.run_steps(3);
    window.harness.get_by_label("tug").click();
    window.harness.run_steps(3);
    let empty = egui_kittest::kittest::By::new()
        .role(eframe::egui::accesskit::Role::TextInput)
        .value("");
    let mut fields: Vec<_> = window.harness.get_all(empty).collect();
    fields.pop().expect("the field of the type").focus();
    window.harness.run_steps(2);
    window.harness.event(Event::Text("0.75".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.harness.run_steps(3);
    assert_eq!(own(&mut window), Some(0.75));
    // The forklift has taken over the value that all had.
    let removals = window.harness.get_all_by_label("×");
    let lowest = removals.max_by(|a, b| a.rect().top().total_cmp(&b.rect().top()));
    lowest.expect("the button of the type").click();
    window.harness.run_steps(3);
    assert_eq!(own(&mut window), None);
    window.key(CTRL, Key::Z);
    assert_eq!(own(&mut window), Some(0.75));
}

#[test]
fn search_counts_the_matches_beyond_those_listed() {
    let mut window = TestWindow::showing(lanes(100));
    window.key(CTRL, Key::F);
    window.harness.event(Event::Text("lane".into()));
    window.wait(|app| !app.find.more().is_empty());
    let [more] = window.app().find.more().try_into().unwrap();
    assert!(
        more.starts_with("and ") && more.ends_with(" more paths"),
        "{more}"
    );
    window.harness.run_steps(2);
    assert!(window.harness.query_by_label(&more).is_some());
}

/// The picture of a shape in words: the letters of two windows may lie elsewhere in their textures.
fn drawn(shape: &ClippedShape) -> String {
    let clip = shape.clip_rect;
    match &shape.shape {
        Shape::Text(text) => format!("{clip:?} {:?} {}", text.pos, text.galley.text()),
        shape => format!("{clip:?} {shape:?}"),
    }
}

/// The shapes of the bars and of the side panel after each step of a session, in which the pointer
/// is elsewhere. A screen reader needs a new layout in each frame.
fn session(has_reader: bool) -> Vec<Vec<String>> {
    let disk = TestServices::with([("site.arrow", lanes(4))]);
    let options = LaunchOptions {
        files: vec!["site.arrow".into()],
        method: Some("cpu".into()),
        ..LaunchOptions::default()
    };
    let (ctx, mut app) = (
        Context::default(),
        App::launch(Arc::new(|| {}), disk, options),
    );
    if has_reader {
        ctx.enable_accesskit();
    }
    let mut time = 0.0;
    let mut frame = |app: &mut App| {
        time += 0.1;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(1200.0, 800.0))),
            time: Some(time),
            events: vec![Event::PointerMoved(Pos2::new(300.0, 300.0))],
            ..RawInput::default()
        };
        let mut output = ctx.run_ui(input, |ui| app.show(ui));
        output.textures_delta.clear();
        let canvas = app.canvas.screen().rect;
        let shapes = output.shapes.iter();
        // Below the names of the tabs, which count findings as they come.
        let of_tab = |shape: &&ClippedShape| {
            let clip = shape.clip_rect;
            let is_tab = clip.left() > canvas.right() && clip.top() > canvas.top() + 20.0;
            is_tab || clip.bottom() <= canvas.top()
        };
        shapes.filter(of_tab).map(drawn).collect::<Vec<_>>()
    };
    let mut settle = |app: &mut App| {
        while app.document().is_none() || !app.is_settled() {
            frame(app);
            thread::sleep(Duration::from_millis(2));
        }
        let mut last = Vec::new();
        for _ in 0..6 {
            last = frame(app);
        }
        last
    };
    let mut seen = vec![settle(&mut app)];
    let steps: [fn(&mut App, &Context); 9] = [
        |app, _| app.edit(EditTask::view_change(Document::select_all)),
        |app, ctx| app.perform(Command::TwoWay, ctx),
        |app, ctx| app.perform(Command::Undo, ctx),
        |app, _| {
            app.edit(EditTask::view_change(|document| {
                let second = [1].into_iter().collect();
                document.select(second, guideway_document::SelectMode::Replace);
            }));
        },
        |app, _| app.settings.language = Some(Language::German),
        |app, _| app.exact_edit.by_x_m = 7.0,
        |app, ctx| app.perform(Command::ToolLine, ctx),
        |app, _| app.settings.grid_step_m = Some(2.0),
        |app, ctx| app.perform(Command::Delete, ctx),
    ];
    for step in steps {
        step(&mut app, &ctx);
        seen.push(settle(&mut app));
    }
    seen
}

#[test]
fn parts_that_nothing_touches_show_what_new_layouts_would() {
    let (painted, laid_out) = (session(false), session(true));
    for (step, (painted, laid_out)) in painted.iter().zip(&laid_out).enumerate() {
        assert!(!painted.is_empty());
        assert_eq!(painted, laid_out, "step {step}");
    }
    let changed = painted.array_windows().filter(|[a, b]| a != b);
    assert_eq!(changed.count(), painted.len() - 1, "each step shows");
}

#[test]
fn long_words_and_many_findings_fit_into_the_panel() {
    // Lanes without a connection have dead ends.
    let mut layout = lanes(600);
    layout.paths.vehicle_types_mut().set(0, &["tug"]);
    for (row, word) in [(0, "NONE"), (1, "CLOCKWISE")] {
        let name = "rotationAtEndNodeAllowed";
        layout.paths.attributes.set(row, name, Value::Text(word));
    }
    let mut window = TestWindow::showing(layout);
    window.app().settings.language = Some(Language::German);
    window.key(CTRL, Key::A);
    window.app().side.open(SideTab::Properties);
    window.wait(|app| {
        let findings = app.files.layers()[0].tasks.findings();
        findings.is_some_and(|findings| !findings.diagnostics.is_empty())
    });
    window.harness.run_steps(5);
    let tops = |label| {
        let all = window.harness.query_all_by_label(label);
        all.map(|node| node.rect().min.y).collect::<Vec<_>>()
    };
    let row = tops("Dateien")[0];
    // One of the two is the menu.
    assert!(tops("Ansicht").contains(&row), "all tabs are in one row");
    let width = window.harness.ctx.content_rect().width();
    let buttons = window.harness.query_all_by_label("+");
    let edges: Vec<f32> = buttons.map(|button| button.rect().max.x).collect();
    let in_column = |edge: &f32| *edge <= width && (edge - edges[0]).abs() < 0.5;
    assert!(edges.len() > 1 && edges.iter().all(in_column), "{edges:?}");
}
