//! Names of keys in the language of the window.

use eframe::egui::{Context, KeyboardShortcut};

use super::{Language, language};

/// German keyboards have other names on their keys.
const GERMAN: [(&str, &str); 15] = [
    ("Backspace", "Rücktaste"),
    ("Ctrl", "Strg"),
    ("Delete", "Entf"),
    ("Down", "Unten"),
    ("Enter", "Eingabe"),
    ("Equals", "Gleich"),
    ("Escape", "Esc"),
    ("Home", "Pos1"),
    ("Insert", "Einfg"),
    ("Left", "Links"),
    ("PageDown", "Bild ab"),
    ("PageUp", "Bild auf"),
    ("Right", "Rechts"),
    ("Shift", "Umschalt"),
    ("Up", "Oben"),
];

/// A shortcut as menus show it: `Ctrl+Shift+S`, `Strg+Umschalt+S`.
pub(crate) fn shortcut_text(ctx: &Context, shortcut: &KeyboardShortcut) -> String {
    let english = ctx.format_shortcut(shortcut);
    match language() {
        Language::English => english,
        Language::German => german(&english),
    }
}

fn german(english: &str) -> String {
    let name = |key: &str| {
        let known = GERMAN.iter().find(|(english, _)| *english == key);
        known.map_or_else(|| key.to_owned(), |(_, german)| (*german).to_owned())
    };
    english.split('+').map(name).collect::<Vec<_>>().join("+")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_key_of_a_shortcut_has_its_german_name() {
        assert_eq!(german("Ctrl+Shift+S"), "Strg+Umschalt+S");
        assert_eq!(german("Alt+Left"), "Alt+Links");
        assert_eq!(german("F2"), "F2");
        assert_eq!(german("Equals"), "Gleich");
    }
}
