//! The language of the window: every text stands in the code in English, and in `german.tsv` beside
//! its German form; [`messages`] has the texts of other crates.
//!
//! A line of the table has an English text and the German one; for a thing that is counted, its
//! English singular, and singular and plural in German. A thread has the language of the thread
//! that started it.

mod keys;
mod messages;

use std::cell::Cell;
use std::collections::HashMap;
use std::fmt::Display;
use std::io;
use std::sync::LazyLock;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use guideway_document::text_format;
use guideway_layout::Direction;
use serde::{Deserialize, Serialize};

pub(crate) use keys::shortcut_text;
pub(crate) use messages::translated;

/// A language of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Language {
    #[default]
    English,
    German,
}

impl Language {
    pub(crate) const ALL: [Self; 2] = [Self::English, Self::German];

    /// Its name in itself.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::German => "Deutsch",
        }
    }

    /// The language of the desktop, by the value of `LC_ALL`, `LC_MESSAGES` or `LANG`.
    pub(crate) fn of_locale(locale: &str) -> Self {
        match locale.starts_with("de") {
            true => Self::German,
            false => Self::English,
        }
    }
}

thread_local! {
    static LANGUAGE: Cell<Language> = const { Cell::new(Language::English) };
}

/// German texts by the English ones.
static GERMAN: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| {
    let pairs = lines().filter_map(|line| line.split_once('\t'));
    pairs.filter(|(_, german)| !german.contains('\t')).collect()
});

/// Singular and plural in German by the English singular.
static GERMAN_NOUNS: LazyLock<HashMap<&str, (&str, &str)>> = LazyLock::new(|| {
    let nouns = lines().filter_map(|line| {
        let (english, german) = line.split_once('\t')?;
        Some((english, german.split_once('\t')?))
    });
    nouns.collect()
});

fn lines() -> std::str::Lines<'static> {
    include_str!("german.tsv").lines()
}

/// The language of this thread.
pub(crate) fn language() -> Language {
    LANGUAGE.get()
}

/// Sets the language of this thread.
pub(crate) fn set_language(language: Language) {
    LANGUAGE.set(language);
}

/// Starts a thread with the language of this one.
pub(crate) fn start_thread(work: impl FnOnce() + Send + 'static) -> io::Result<JoinHandle<()>> {
    let language = language();
    thread::Builder::new().spawn(move || {
        set_language(language);
        work();
    })
}

/// A text in the language of this thread; in English where the table lacks it.
pub(crate) fn t(english: &str) -> &str {
    match language() {
        Language::English => english,
        Language::German => GERMAN.get(english).copied().unwrap_or(english),
    }
}

/// The name of a direction.
pub(crate) fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Forward => t("one-way"),
        Direction::Both => t("two-way"),
    }
}

/// A text with values in place of names in braces; see [`say!`].
pub(crate) fn fill(english: &str, values: &[(&str, &dyn Display)]) -> String {
    let mut rest = t(english);
    let mut text = String::with_capacity(rest.len() + 16 * values.len());
    while let Some((before, after)) = rest.split_once('{') {
        text.push_str(before);
        let Some((name, after)) = after.split_once('}') else {
            break;
        };
        let value = values.iter().find(|(known, _)| *known == name);
        debug_assert!(value.is_some(), "{english}: no value for {name}");
        if let Some((_, value)) = value {
            text += &value.to_string();
        }
        rest = after;
    }
    text + rest
}

/// A text with values: `say!("Saved {name}", name)`, or `say!("{n} m", n = length)`.
macro_rules! say {
    ($text:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        $crate::language::fill(
            $text,
            &[$((stringify!($name), $crate::language::value!($name $(= $value)?))),*],
        )
    };
}

/// The value of a name in [`say!`].
macro_rules! value {
    ($name:ident) => {
        &$name
    };
    ($name:ident = $value:expr) => {
        &$value
    };
}

pub(crate) use {say, value};

/// A count with thousands separators: `1,020,350`.
pub(crate) fn grouped(n: u64) -> String {
    let english = text_format::count(n);
    match language() {
        Language::English => english,
        Language::German => english.replace(',', "."),
    }
}

/// A count of things: `1 step`, `1,020 steps`. The thing is a word of the table of nouns.
pub(crate) fn counted(n: u64, thing: &str) -> String {
    match language() {
        Language::English => text_format::counted(n, thing),
        Language::German => {
            let noun = GERMAN_NOUNS.get(thing).copied();
            let (one, more) = noun.unwrap_or((thing, thing));
            let word = if n == 1 { one } else { more };
            format!("{} {word}", grouped(n))
        }
    }
}

/// A duration in its largest whole unit: `40 seconds`, `3 hours`.
pub(crate) fn duration(duration: Duration) -> String {
    let seconds = duration.as_secs();
    match seconds {
        0..60 => counted(seconds, "second"),
        60..3_600 => counted(seconds / 60, "minute"),
        3_600..86_400 => counted(seconds / 3_600, "hour"),
        _ => counted(seconds / 86_400, "day"),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::fs;
    use std::path::Path;

    use guideway_layout::Code;

    use super::*;
    use crate::command::MENUS;
    use crate::panels::title_of;
    use crate::tools::FORMS;

    #[test]
    fn texts_follow_the_language_of_the_thread() {
        assert_eq!(t("Open…"), "Open…");
        set_language(Language::German);
        assert_eq!(t("Open…"), "Öffnen…");
        assert_eq!(t("not in the table"), "not in the table");
        let name = "a {b}";
        let saved = say!("Saved {name}", name);
        assert_eq!(saved, "a {b} ist gespeichert");
        assert_eq!(counted(1, "path"), "1 Weg");
        assert_eq!(counted(1020, "path"), "1.020 Wege");
        assert_eq!(grouped(1_020_350), "1.020.350");
        set_language(Language::English);
        assert_eq!(counted(1020, "path"), "1,020 paths");
    }

    #[test]
    fn durations_have_their_largest_unit() {
        let texts = [1, 59, 61, 7_200, 200_000].map(|s| duration(Duration::from_secs(s)));
        let expected = ["1 second", "59 seconds", "1 minute", "2 hours", "2 days"];
        assert_eq!(texts, expected);
    }

    #[test]
    fn table_has_each_text_once_with_the_same_values() {
        let mut seen = HashSet::new();
        for line in lines() {
            let columns: Vec<&str> = line.split('\t').collect();
            assert!((2..=3).contains(&columns.len()), "{line}");
            let [english, german] = [columns[0], columns[1]];
            assert!(
                seen.insert((english, columns.len())),
                "{english} is there twice"
            );
            assert_eq!(values(english), values(german), "{english}");
        }
    }

    /// The names in braces, in alphabetical order.
    fn values(text: &str) -> Vec<&str> {
        let parts = text.split('{').skip(1);
        let mut names: Vec<&str> = parts
            .filter_map(|part| Some(part.split_once('}')?.0))
            .collect();
        names.sort_unstable();
        names
    }

    /// Each literal that the sources hand to `t`, `say!` or `counted`.
    fn literals() -> Vec<String> {
        let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
        let mut found = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() && !path.ends_with("tests") && !path.ends_with("language") {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "rs") {
                    let text = fs::read_to_string(path).unwrap();
                    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap();
                    found.extend(["t(", "say!("].iter().flat_map(|call| calls(code, call)));
                }
            }
        }
        found
    }

    /// The literals that are the first argument of a call.
    fn calls(code: &str, call: &str) -> Vec<String> {
        let parts: Vec<&str> = code.split(call).collect();
        let literal = |[before, after]: &[&str; 2]| {
            let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
            if before.ends_with(is_word) {
                return None;
            }
            let text = after.trim_start().strip_prefix('"')?;
            let text = text.split('"').next()?;
            let lines: Vec<&str> = text.split("\\\n").collect();
            let joined = lines.iter().enumerate().map(|(number, line)| match number {
                0 => *line,
                _ => line.trim_start(),
            });
            Some(joined.collect())
        };
        parts.array_windows().filter_map(literal).collect()
    }

    #[test]
    fn each_text_of_the_window_is_in_the_table() {
        let literals = literals();
        assert!(literals.len() > 400, "{}", literals.len());
        let missing: Vec<&String> = literals
            .iter()
            .filter(|text| !GERMAN.contains_key(text.as_str()))
            .collect();
        assert!(missing.is_empty(), "not in german.tsv: {missing:#?}");
        for code in Code::ALL {
            assert!(GERMAN.contains_key(&*title_of(*code)), "{code}");
            assert!(GERMAN.contains_key(code.meaning()), "{code}");
        }
        for menu in &MENUS {
            assert!(GERMAN.contains_key(menu.name), "{}", menu.name);
        }
        assert!(GERMAN.contains_key(FORMS) && GERMAN.contains_key("paths per pixel"));
    }

    #[test]
    fn each_step_of_undo_is_in_the_table() {
        let edits = concat!(env!("CARGO_MANIFEST_DIR"), "/../guideway-document/src/edit");
        let mut folders = vec![Path::new(edits).to_owned()];
        let mut steps = Vec::new();
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else {
                    let text = fs::read_to_string(path).unwrap();
                    let code = text.split("#[cfg(test)]").next().unwrap();
                    steps.extend(calls(code, "self.perform("));
                }
            }
        }
        assert!(steps.len() > 15, "{steps:?}");
        steps.retain(|step| !GERMAN.contains_key(step.as_str()));
        assert!(steps.is_empty(), "not in german.tsv: {steps:?}");
    }
}
