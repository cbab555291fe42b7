//! The table view: sorted, filtered, edited and pasted, with one selection for table and drawing.

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::Queryable;
use guideway_document::SelectMode;
use guideway_layout::Value;
use guideway_scene::Table;

use super::services::lanes;
use super::test_window::{TestWindow, has_notice};
use crate::panels::BottomView;

const CTRL: Modifiers = Modifiers::COMMAND;
const NONE: Modifiers = Modifiers::NONE;

/// A window with the table of a layout of lanes.
fn table_of(count: u32) -> TestWindow {
    let mut window = TestWindow::showing(lanes(count));
    window.app().side.toggle(1200.0);
    window.key(CTRL, Key::T);
    window.harness.run_steps(4);
    assert_eq!(window.app().bottom.view, Some(BottomView::Table));
    window
}

/// Center of the cell with a text; the first one from the top.
fn cell(window: &TestWindow, text: &str) -> Pos2 {
    let cells = window.harness.query_all_by_label(text);
    let rects = cells.map(|cell| cell.rect());
    let first = rects.min_by(|a, b| a.top().total_cmp(&b.top()));
    first.expect("the cell is shown").center()
}

fn double_click(window: &mut TestWindow, at: Pos2) {
    window.harness.event(Event::PointerMoved(at));
    for pressed in [true, false, true, false] {
        window
            .harness
            .input_mut()
            .events
            .push(Event::PointerButton {
                pos: at,
                button: PointerButton::Primary,
                pressed,
                modifiers: NONE,
            });
    }
    window.harness.run_steps(3);
}

fn speeds(window: &mut TestWindow) -> Vec<f64> {
    let paths = &window.document().layout().paths;
    let speed = |row| match paths.attributes.value(row, "speed") {
        Some(Value::Float(speed)) => speed,
        _ => -1.0,
    };
    (0..paths.len()).map(speed).collect()
}

#[test]
fn selection_is_shared_with_the_drawing() {
    let mut window = table_of(4);
    let at = cell(&window, "lane 2");
    window.click(at);
    assert_eq!(window.selected(), [2]);
    let at = cell(&window, "lane 0");
    window.click_with(at, Modifiers::SHIFT);
    assert_eq!(window.selected(), [0, 1, 2]);
    let at = cell(&window, "lane 1");
    window.click_with(at, CTRL);
    assert_eq!(window.selected(), [0, 2]);
    // A path that is selected in the drawing scrolls into view.
    let mut window = table_of(500);
    assert!(window.harness.query_by_label("lane 400").is_none());
    window.change(|document| {
        document.select([400].into_iter().collect(), SelectMode::Replace);
    });
    window.harness.run_steps(4);
    assert!(window.harness.query_by_label("lane 400").is_some());
}

#[test]
fn only_visible_rows_are_built() {
    let window = table_of(3_000);
    let rows = window.harness.query_all_by_label_contains("lane ").count();
    assert!((5..40).contains(&rows), "{rows}");
}

#[test]
fn header_sorts_and_filter_selects_rows() {
    let mut window = table_of(12);
    let top = |window: &TestWindow, a: &str, b: &str| cell(window, a).y < cell(window, b).y;
    assert!(top(&window, "lane 0", "lane 1"));
    for expected in [true, false, true] {
        let header = cell_of_header(&window, "speed");
        window.click(header);
        window.harness.run_steps(3);
        window.wait(|app| app.document().is_some());
        let shown = window.harness.query_by_label("lane 0").is_some();
        let is_first = shown && top(&window, "lane 0", "lane 1");
        assert_eq!(is_first, expected);
    }
    window.app().bottom.table.filter = "speed >= 5".into();
    for _ in 0..50 {
        window.harness.run_steps(2);
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    assert!(window.harness.query_by_label("2 rows").is_some());
    assert!(window.harness.query_by_label("lane 10").is_some());
    assert!(window.harness.query_by_label("lane 1").is_none());
    window.app().bottom.table.filter = "spede >= 5".into();
    window.harness.run_steps(3);
    assert!(
        window
            .harness
            .query_by_label_contains("unknown column")
            .is_some()
    );
}

/// The header whose title begins so.
fn cell_of_header(window: &TestWindow, title: &str) -> Pos2 {
    let mut headers = window.harness.query_all_by_label_contains(title);
    headers.next().expect("the header is shown").rect().center()
}

#[test]
fn cells_are_edited_with_units_and_undone() {
    let mut window = table_of(3);
    let at = cell(&window, "0.5");
    double_click(&mut window, at);
    window.key(CTRL, Key::A);
    window.harness.event(Event::Text("2,5".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.harness.run_steps(3);
    assert_eq!(speeds(&mut window), [0.0, 2.5, 1.0]);
    // A name, and one that is taken.
    for (text, is_taken) in [("aisle", false), ("lane 0", true)] {
        let shown = if is_taken { "aisle" } else { "lane 1" };
        let at = cell(&window, shown);
        double_click(&mut window, at);
        window.key(CTRL, Key::A);
        window.harness.event(Event::Text(text.into()));
        window.harness.run_steps(2);
        window.key(NONE, Key::Enter);
        window.harness.run_steps(3);
        assert_eq!(has_notice(window.app(), "another path is called"), is_taken);
        assert_eq!(window.document().layout().paths.id(1), "aisle");
    }
    // Escape takes a text back.
    let at = cell(&window, "aisle");
    double_click(&mut window, at);
    window.harness.event(Event::Text("x".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Escape);
    window.harness.run_steps(3);
    assert_eq!(window.document().layout().paths.id(1), "aisle");
}

#[test]
fn cells_of_a_spreadsheet_are_pasted_in_one_step() {
    let mut window = table_of(4);
    let at = cell(&window, "0.5");
    window.click(at);
    window.harness.event(Event::Paste("1.5\n2 m/s\n".into()));
    window.harness.run_steps(3);
    // The column has no unit in this file.
    assert!(has_notice(window.app(), "2 m/s is no number"));
    assert_eq!(speeds(&mut window), [0.0, 0.5, 1.0, 1.5]);
    window.harness.event(Event::Paste("7\r\n8\r\n9\r\n".into()));
    window.harness.run_steps(3);
    assert_eq!(speeds(&mut window), [0.0, 7.0, 8.0, 9.0]);
    window.key(CTRL, Key::Z);
    assert_eq!(speeds(&mut window), [0.0, 0.5, 1.0, 1.5], "one step");
    // One cell fills all selected rows.
    window.harness.run_steps(2);
    window.change(|document| {
        document.select([1, 3].into_iter().collect(), SelectMode::Replace);
    });
    window.harness.run_steps(3);
    window.harness.event(Event::Paste("4".into()));
    window.harness.run_steps(3);
    assert_eq!(speeds(&mut window), [0.0, 4.0, 1.0, 4.0]);
    window
        .harness
        .event(Event::Paste("1\n2\n3\n4\n5\n6".into()));
    window.harness.run_steps(3);
    assert!(has_notice(window.app(), "6 lines are pasted"));
    // Garbage changes nothing, in the table and over the drawing.
    for text in [
        "\u{0}\u{1}\t\u{202e}\n\n\t\t\t\t\t\t\t\t\t",
        "",
        "\n\n",
        "\u{feff}{\"lif\":",
    ] {
        window.harness.event(Event::Paste(text.into()));
        window.harness.run_steps(3);
        assert_eq!(speeds(&mut window), [0.0, 4.0, 1.0, 4.0], "{text:?}");
    }
    let at = window.at(5.0, 50.0);
    window.click(at);
    window.harness.event(Event::Paste("\u{0}garbage".into()));
    window.harness.run_steps(3);
    assert!(has_notice(window.app(), "Nothing is copied"));
}

#[test]
fn nodes_are_moved_by_their_cells() {
    let mut window = table_of(2);
    window.app().bottom.table.of = Table::Nodes;
    window.harness.run_steps(4);
    let at = cell(&window, "n1 10");
    let x = Pos2::new(at.x + 200.0, at.y);
    double_click(&mut window, x);
    window.key(CTRL, Key::A);
    window.harness.event(Event::Text("12".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.harness.run_steps(3);
    let end = window.document().layout().paths.get(1).ends().unwrap().1;
    assert_eq!((end.x, end.y), (12.0, 2.0));
}
