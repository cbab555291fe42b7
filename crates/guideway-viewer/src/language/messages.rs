//! Texts that other crates make, such as findings and reports, in the language of the window.
//!
//! They arrive in English with their values. A line of `messages.tsv` has the form of such a text,
//! with names in braces in place of the values, and its German form; `message_parts.tsv` has the
//! forms of values that are texts themselves. A value `{more?}` is absent or one of these, and
//! `{~more}` stands for its German form. Of several messages that fit, the one with the most
//! letters of its own counts, of several parts the first.

use std::borrow::Cow;
use std::cell::RefCell;
use std::cmp::Reverse;
use std::collections::HashMap;
use std::sync::LazyLock;

use super::{GERMAN, GERMAN_NOUNS, Language, counted, language};

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
    /// As `Plain`, and may be empty.
    Quoted,
    /// In English: absent, or a known part.
    Optional,
    /// In German: translated in turn.
    Translated,
}

/// Values by their names.
type Values<'t> = Vec<(&'static str, &'t str)>;

/// Those with the most letters of their own first.
static MESSAGES: LazyLock<Vec<Form>> = LazyLock::new(|| {
    let mut forms = forms(include_str!("messages.tsv"));
    forms.sort_by_key(|form| Reverse(form.letters()));
    forms
});
static PARTS: LazyLock<Vec<Form>> = LazyLock::new(|| forms(include_str!("message_parts.tsv")));

/// Most texts that are kept translated: more than a window shows at once.
const MAX_KEPT: usize = 4_096;

thread_local! {
    /// German texts by the English ones: a text is shown in many frames.
    static KEPT: RefCell<HashMap<String, String>> = RefCell::default();
}

/// A text of another crate in the language of this thread; in English if no form fits it.
pub(crate) fn translated(english: &str) -> Cow<'_, str> {
    match language() {
        Language::English => english.into(),
        Language::German => kept(english).into(),
    }
}

/// The German text, from those that are kept if it is there.
fn kept(english: &str) -> String {
    if let Some(known) = KEPT.with_borrow(|kept| kept.get(english).cloned()) {
        return known;
    }
    let text = german(english);
    KEPT.with_borrow_mut(|kept| {
        if kept.len() >= MAX_KEPT {
            kept.clear();
        }
        kept.insert(english.to_owned(), text.clone());
    });
    text
}

fn german(english: &str) -> String {
    by_message(english)
        .or_else(|| sentences(english))
        .or_else(|| by_part(english))
        .or_else(|| count_of_things(english))
        .or_else(|| GERMAN.get(english).map(|&text| text.to_owned()))
        .or_else(|| parts(english, ": "))
        .unwrap_or_else(|| english.to_owned())
}

/// An error as `message. Remedy`, or as `place: message` with a known message.
fn sentences(english: &str) -> Option<String> {
    parts(english, ". ").or_else(|| {
        let (_, after) = english.split_at_checked(end_of_part(english, ": ")? + 2)?;
        by_message(after)?;
        parts(english, ": ")
    })
}

/// Two parts with this sign between them, each translated by itself.
fn parts(english: &str, sign: &str) -> Option<String> {
    let (before, after) = english.split_at(end_of_part(english, sign)?);
    let after = translated(&after[sign.len()..]);
    Some(format!("{}{sign}{after}", translated(before)))
}

/// The end of the part of a text before a sign outside of quotes.
fn end_of_part(text: &str, sign: &str) -> Option<usize> {
    let is_quoted = |end: usize| text[..end].matches(['"', '`']).count() % 2 == 1;
    let mut ends = text.match_indices(sign).map(|(end, _)| end);
    ends.find(|&end| !is_quoted(end))
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

/// A message by its form. A value at its start is no more than one part of an error.
fn by_message(english: &str) -> Option<String> {
    MESSAGES.iter().find_map(|form| {
        let values = form.values_of(english)?;
        let is_long = |value: &str| [": ", ". "].iter().any(|s| end_of_part(value, s).is_some());
        let starts_with_value = matches!(form.english.first(), Some(Piece::Value { .. }));
        let is_whole = !starts_with_value || !is_long(values.first()?.1);
        is_whole.then(|| form.fill(&values))
    })
}

fn by_part(english: &str) -> Option<String> {
    let fitting = |form: &Form| Some(form.fill(&form.values_of(english)?));
    PARTS.iter().find_map(fitting)
}

impl Form {
    /// Letters of the English form, without values.
    fn letters(&self) -> usize {
        let letters = self.english.iter().map(|piece| match piece {
            Piece::Text(text) => text.len(),
            Piece::Value { .. } => 0,
        });
        letters.sum()
    }

    /// The values of a text of this form.
    fn values_of<'t>(&self, text: &'t str) -> Option<Values<'t>> {
        let mut values = Values::new();
        take_values(&self.english, text, &mut values).then_some(values)
    }

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
                        ValueKind::Plain | ValueKind::Optional | ValueKind::Quoted => {
                            text += value;
                        }
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
                ValueKind::Optional => value.is_empty() || by_part(value).is_some(),
                ValueKind::Quoted => true,
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
            _ if before.ends_with(['"', '`']) => (name, ValueKind::Quoted),
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
mod tests;
