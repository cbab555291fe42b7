//! Pictures that the window shows and exports.

use eframe::egui::{Key, Modifiers};

use super::services::lanes;
use super::test_window::{TestWindow, has_notice};
use crate::app::App;
use crate::canvas::shown_colors;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn crowd_of_paths_is_shown_as_density_until_the_user_decides() {
    let mut window = TestWindow::showing(lanes(3));
    window.harness.run_steps(3);
    assert!(
        !window.app().settings.shows_density(),
        "three lanes are none"
    );
    drop(window);
    let mut window = TestWindow::showing(lanes(12_000));
    let is_shown = |app: &App| app.settings.shows_density() && app.files.is_settled();
    window.wait(|app| is_shown(app) && has_notice(app, "so it shows their density"));
    window.wait(|app| shown_colors(&app.files, &app.settings).is_some());
    let app = window.app();
    let legend = shown_colors(&app.files, &app.settings);
    assert_eq!(legend.unwrap().column, "paths per pixel");
    // It is no setting that outlives the file.
    assert!(!window.app().settings.is_density);
    window.key(NONE, Key::Y);
    assert!(!window.app().settings.shows_density());
    window.key(NONE, Key::F);
    window.wait(|app| app.files.is_settled());
    assert!(
        !window.app().settings.shows_density(),
        "the user has decided"
    );
    window.app().settings.is_crowded = true;
    window.key(CTRL, Key::W);
    assert!(!window.app().settings.shows_density());
}
