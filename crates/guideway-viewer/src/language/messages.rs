//! Texts that other crates make, such as findings and reports, in the language of the window.
//!
//! They arrive in English with their values. A line of `messages.tsv` has the form of such a text,
//! with names in braces in place of the values, and its German form; `message_parts.tsv` has the
//! forms of values that are texts themselves. A value `{more?}` is absent or one of these, and
//! `{~more}` stands for its German form.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::{GERMAN_NOUNS, Language, counted, language, t};

/// An English form and its German one.
struct Form {
    english: Vec<Piece>,
    german: Vec<Piece>,
}

enum Piece {
    Text(&'static str),
    Value { name: &'static str, kind: ValueKind },
}

#[derive(Clone, Copy, PartialEq)]
enum ValueKind {
    /// Any text, the same in both languages.
    Plain,
    /// In English: absent, or a known part.
    Optional,
    /// In German: translated in turn.
    Translated,
}

/// Values by their names.
type Values<'t> = Vec<(&'static str, &'t str)>;

static MESSAGES: LazyLock<Vec<Form>> = LazyLock::new(|| forms(include_str!("messages.tsv")));
static PARTS: LazyLock<Vec<Form>> = LazyLock::new(|| forms(include_str!("message_parts.tsv")));

/// A text of another crate in the language of this thread; in English if no form fits it.
pub(crate) fn translated(english: &str) -> Cow<'_, str> {
    match language() {
        Language::English => english.into(),
        Language::German => {
            let known = by_forms(&MESSAGES, english).or_else(|| by_forms(&PARTS, english));
            let known = known.or_else(|| count_of_things(english));
            known.map_or_else(|| t(english).into(), Cow::Owned)
        }
    }
}

/// `3 paths` in the language of this thread.
fn count_of_things(english: &str) -> Option<String> {
    let (count, things) = english.split_once(' ')?;
    let count: u64 = count.replace(',', "").parse().ok()?;
    let noun = [Some(things), things.strip_suffix('s')];
    let noun = noun.into_iter().flatten();
    let noun = noun
        .into_iter()
        .find(|noun| GERMAN_NOUNS.contains_key(noun))?;
    Some(counted(count, noun))
}

fn by_forms(forms: &[Form], english: &str) -> Option<String> {
    forms.iter().find_map(|form| {
        let mut values = Values::new();
        let fits = take_values(&form.english, english, &mut values);
        fits.then(|| form.fill(&values))
    })
}

impl Form {
    fn fill(&self, values: &Values<'_>) -> String {
        let mut text = String::new();
        for piece in &self.german {
            match piece {
                Piece::Text(piece) => text += piece,
                Piece::Value { name, kind } => {
                    let value = values.iter().find(|(known, _)| known == name);
                    let value = value.map_or("", |(_, value)| *value);
                    match kind {
                        ValueKind::Translated => text += &translated(value),
                        ValueKind::Plain | ValueKind::Optional => text += value,
                    }
                }
            }
        }
        text
    }
}

/// Adds the values of a text that has a form. Returns `false` if it has not.
fn take_values<'t>(form: &[Piece], text: &'t str, values: &mut Values<'t>) -> bool {
    match form {
        [] => text.is_empty(),
        [Piece::Text(piece), rest @ ..] => {
            let after = text.strip_prefix(piece);
            after.is_some_and(|after| take_values(rest, after, values))
        }
        [Piece::Value { name, kind }, rest @ ..] => ends(rest, text).into_iter().any(|end| {
            let (value, after) = text.split_at(end);
            let is_allowed = match kind {
                ValueKind::Optional => value.is_empty() || by_forms(&PARTS, value).is_some(),
                ValueKind::Plain | ValueKind::Translated => !value.is_empty(),
            };
            let known = values.len();
            values.push((name, value));
            let fits = is_allowed && take_values(rest, after, values);
            if !fits {
                values.truncate(known);
            }
            fits
        }),
    }
}

/// The places where a value may end, nearest first, by the piece behind it.
fn ends(rest: &[Piece], text: &str) -> Vec<usize> {
    match rest {
        [] => vec![text.len()],
        [Piece::Text(next), ..] => text.match_indices(next).map(|(at, _)| at).collect(),
        [Piece::Value { .. }, ..] => {
            let inside = text.char_indices().map(|(at, _)| at);
            inside.chain([text.len()]).collect()
        }
    }
}

fn forms(table: &'static str) -> Vec<Form> {
    let pairs = table.lines().filter_map(|line| line.split_once('\t'));
    let forms = pairs.map(|(english, german)| Form {
        english: pieces(english),
        german: pieces(german),
    });
    forms.collect()
}

fn pieces(form: &'static str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut rest = form;
    while let Some((before, after)) = rest.split_once('{') {
        let (name, after) = after.split_once('}').unwrap_or((after, ""));
        let (name, kind) = match (name.strip_suffix('?'), name.strip_prefix('~')) {
            (Some(name), _) => (name, ValueKind::Optional),
            (_, Some(name)) => (name, ValueKind::Translated),
            _ => (name, ValueKind::Plain),
        };
        pieces.push(Piece::Text(before));
        pieces.push(Piece::Value { name, kind });
        rest = after;
    }
    pieces.push(Piece::Text(rest));
    pieces.retain(|piece| !matches!(piece, Piece::Text("")));
    pieces
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use super::*;
    use crate::language::set_language;

    fn german(english: &str) -> String {
        set_language(Language::German);
        let german = translated(english).into_owned();
        set_language(Language::English);
        german
    }

    #[test]
    fn values_move_into_the_german_text() {
        for (english, expected) in [
            (
                "vehicles can enter this part of 1,020 nodes, but not leave it, for vehicle \
                 types \"tug\", \"fork\" and 3 more",
                "Fahrzeuge kommen in diesen Teil (1.020 Knoten), aber nicht heraus, für \
                 Fahrzeugtyp \"tug\", \"fork\" und 3 weiteren",
            ),
            (
                "gap of 0.250 m at (1.000, 2.000) m, and at 3 other places",
                "Lücke von 0.250 m bei (1.000, 2.000) m, und an 3 weiteren Stellen",
            ),
            (
                "gap of 0.250 m at (1.000, 2.000) m",
                "Lücke von 0.250 m bei (1.000, 2.000) m",
            ),
            (
                "has the curve of path \"a and b\"; they differ in maxSpeed: 1 and 0.5 m/s; \
                 direction: two-way and one-way; and 2 other properties",
                "hat die Kurve von Weg „a and b“; verschieden sind maxSpeed: 1 und 0.5 m/s; \
                 Richtung: beide Richtungen und Einbahn; und 2 weitere Eigenschaften",
            ),
            ("path \"none\" (line 7)", "Weg „none“ (Zeile 7)"),
            ("Rename it to none", "In none umbenennen"),
            (
                "left: 2 lines drawn twice",
                "ausgelassen: 2 Linien, doppelt gezeichnet",
            ),
            ("of no known form", "of no known form"),
        ] {
            assert_eq!(german(english), expected);
            assert_eq!(translated(english), english);
        }
    }

    #[test]
    fn german_forms_have_no_value_that_the_english_ones_lack() {
        let name = |piece: &Piece| match piece {
            Piece::Value { name, .. } => Some(*name),
            Piece::Text(_) => None,
        };
        for form in MESSAGES.iter().chain(PARTS.iter()) {
            let known: Vec<&str> = form.english.iter().filter_map(name).collect();
            let is_known = |name: &str| known.contains(&name);
            assert!(
                form.german.iter().filter_map(name).all(is_known),
                "{known:?}"
            );
        }
    }

    /// A text with `{}` in place of each value.
    fn without_names(text: &str) -> String {
        let mut parts = text.split('{');
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |text, part| {
            text + "{}" + part.split_once('}').map_or("", |(_, after)| after)
        })
    }

    /// The texts of a source file: literals of several words, or with values and words.
    fn texts(file: &Path) -> Vec<String> {
        let source = fs::read_to_string(file).unwrap();
        let code = source.split("#[cfg(test)]").next().unwrap();
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        let lines = code.lines().filter(is_code).map(str::trim_start);
        let code = lines.collect::<Vec<_>>().join("\n").replace("\\\n", "");
        let code = code.replace("'\"'", "").replace("\\\"", "\u{1}");
        let literals = code.split('"').skip(1).step_by(2);
        let is_text = |text: &String| {
            let has_word = text.split("{}").any(|part| {
                let is_small = |c: &u8| c.is_ascii_lowercase();
                part.as_bytes()
                    .array_windows()
                    .any(|[a, b]| is_small(a) && is_small(b))
            });
            has_word && (text.contains(' ') || text.contains('{'))
        };
        let literals = literals.map(|text| without_names(text).replace('\u{1}', "\""));
        literals.filter(is_text).collect()
    }

    #[test]
    fn each_text_of_findings_reports_and_edits_has_a_german_form() {
        let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let folders = [
            "guideway-layout/src/check",
            "guideway-network/src/analyze",
            "guideway-document/src/fixes",
        ];
        let mut files: Vec<PathBuf> = folders
            .iter()
            .flat_map(|folder| fs::read_dir(crates.join(folder)).unwrap())
            .map(|entry| entry.unwrap().path())
            .collect();
        let single = [
            "guideway-layout/src/place.rs",
            "guideway-layout/src/property.rs",
            "guideway-network/src/build/error.rs",
            "guideway-network/src/build/report.rs",
            "guideway-network/src/route/error.rs",
            "guideway-network/src/route/rows.rs",
            "guideway-document/src/edit/error.rs",
            "guideway-document/src/edit/property_value.rs",
            "guideway-document/src/edit/shapes/error.rs",
            "guideway-document/src/query/parse.rs",
            "guideway-scene/src/edit/error.rs",
            "guideway-spline/src/construct/error.rs",
        ];
        files.extend(single.map(|file| crates.join(file)));
        let tables = [
            include_str!("messages.tsv"),
            include_str!("message_parts.tsv"),
        ];
        let forms = tables.iter().flat_map(|table| table.lines());
        let forms = forms.filter_map(|line| line.split_once('\t'));
        let forms: Vec<String> = forms.map(|(form, _)| without_names(form)).collect();
        let texts: Vec<String> = files.iter().flat_map(|file| texts(file)).collect();
        assert!(texts.len() > 200, "{}", texts.len());
        let is_missing = |text: &&String| !forms.iter().any(|form| form.contains(&***text));
        let missing: Vec<&String> = texts.iter().filter(is_missing).collect();
        assert!(missing.is_empty(), "without a German form: {missing:#?}");
    }
}
