//! The list of changes as text, Markdown and JSON.

use std::collections::BTreeMap;
use std::path::Path;

use guideway::layout::{Change, ChangedTexts, Changes, ElementChange, shown_path};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::cli::text;

/// Characters of a value, beyond which it is cut.
const MAX_VALUE: usize = 60;

/// Characters of the name of a file, beyond which it is cut.
const MAX_NAME: usize = 200;

/// Counts of the changes, with the names of the files.
pub(super) struct Report {
    files: [String; 2],
    /// Number of elements per kind of element and of change.
    counts: BTreeMap<(&'static str, &'static str), u64>,
    ms: [f64; 2],
}

impl Report {
    pub(super) fn new(files: [&Path; 2], found: &Changes<'_>, ms: [f64; 2]) -> Self {
        let mut counts = BTreeMap::new();
        for of in found.elements.iter() {
            let key = (of.element.name(), of.change.name());
            *counts.entry(key).or_default() += 1;
        }
        let name = |file: &Path| text::single_line(&shown_path(file), MAX_NAME);
        Self {
            files: files.map(name),
            counts,
            ms,
        }
    }

    /// Counts, then one block per element.
    pub(super) fn text(&self, found: &Changes<'_>, max: usize) -> String {
        let [old, new] = &self.files;
        let mut lines = format!("{old} -> {new}: {}\n", self.summary(found));
        for all in found.elements.by_element().take(max) {
            lines += &format!("{}\n", name_of(found, &all));
            for change in &all {
                lines += &format!("  {}\n", describe(found, change));
            }
        }
        if let Some(more) = rest(found, max) {
            lines += &format!("and {more}; --max lists more\n");
        }
        for group in &found.groups {
            lines += &format!("{}: {}\n", group.what, cut(&group.example));
        }
        let [read, compare] = self.ms.map(text::time);
        lines + &format!("took {read} to read, {compare} to compare\n")
    }

    /// A heading with counts and a table with one row per element.
    pub(super) fn markdown(&self, found: &Changes<'_>, max: usize) -> String {
        let [old, new] = &self.files;
        let mut lines = format!(
            "### `{old}` to `{new}`\n\n{}\n",
            capitalized(&self.summary(found))
        );
        if !found.elements.is_empty() {
            lines += "\n| element | change |\n|---|---|\n";
        }
        for all in found.elements.by_element().take(max) {
            let changes: Vec<String> = all.iter().map(|of| describe(found, of)).collect();
            let name = cell(&name_of(found, &all));
            lines += &format!("| {name} | {} |\n", cell(&changes.join("; ")));
        }
        if let Some(more) = rest(found, max) {
            lines += &format!("\nAnd {more}.\n");
        }
        for group in &found.groups {
            lines += &format!("\n- {}: {}", group.what, cell(&cut(&group.example)));
        }
        lines.trim_end().to_owned() + "\n"
    }

    /// The whole list. The changes become JSON one by one as they are written.
    pub(super) fn json<'a>(&'a self, found: &'a Changes) -> impl Serialize + 'a {
        let counts = self.counts.iter().map(|((element, kind), count)| {
            json!({ "element": element, "change": kind, "count": count })
        });
        let groups = found.groups.iter().map(
            |group| json!({ "what": group.what, "count": group.count, "example": group.example }),
        );
        Body {
            old: &self.files[0],
            new: &self.files[1],
            counts: counts.collect(),
            changes: found,
            groups: groups.collect(),
            ms: json!({ "read": self.ms[0], "compare": self.ms[1] }),
        }
    }

    /// `2 nodes moved, 1 path added`.
    fn summary(&self, found: &Changes<'_>) -> String {
        if found.is_empty() {
            return "no difference".to_owned();
        }
        let counts = self
            .counts
            .iter()
            .map(|((element, kind), &count)| match *kind {
                "set" => format!("{} of {element}s", text::counted(count, "value")),
                kind => format!("{} {kind}", text::counted(count, element)),
            });
        let groups = found.groups.iter().map(|group| group.what.clone());
        counts.chain(groups).collect::<Vec<_>>().join(", ")
    }
}

/// The list of changes as JSON.
#[derive(Serialize)]
struct Body<'a> {
    old: &'a str,
    new: &'a str,
    counts: Vec<Value>,
    #[serde(serialize_with = "each_change")]
    changes: &'a Changes<'a>,
    groups: Vec<Value>,
    ms: Value,
}

fn each_change<S: Serializer>(found: &Changes<'_>, to: S) -> Result<S::Ok, S::Error> {
    to.collect_seq(found.elements.iter().map(|of| element_json(found, &of)))
}

/// Kind and name of the element of some changes.
fn name_of(found: &Changes<'_>, all: &[ElementChange]) -> String {
    let of = all.first();
    of.map_or_else(String::new, |of| {
        format!("{} `{}`", of.element.name(), cut(found.id(of)))
    })
}

/// The number of elements beyond those that are listed.
fn rest(found: &Changes<'_>, max: usize) -> Option<String> {
    let more = found.elements.element_count().saturating_sub(max) as u64;
    (more > 0).then(|| text::counted(more, "more element"))
}

fn describe(found: &Changes<'_>, of: &ElementChange) -> String {
    match of.change {
        Change::Added => "added".to_owned(),
        Change::Removed => "removed".to_owned(),
        Change::Renamed => {
            let to = found.new_id(of).unwrap_or_default();
            format!("renamed to `{}`", cut(to))
        }
        Change::Moved { distance_m } => format!("moved by {}", distance(distance_m)),
        Change::Reshaped { greatest_m } => {
            format!("reshaped, by at most {}", distance(greatest_m))
        }
        Change::Set(_) => found.values(of).map_or_else(String::new, |of| set(&of)),
    }
}

/// A distance, which below half a millimeter takes more digits.
fn distance(meters: f64) -> String {
    match meters < 0.0005 {
        true => format!("{} mm", text::number(meters * 1000.0)),
        false => text::meters(meters),
    }
}

fn set(values: &ChangedTexts<'_>) -> String {
    let of = values.vehicle_type;
    let of = of.map_or_else(String::new, |of| format!(" for `{}`", cut(of)));
    let [before, after] = [&values.before, &values.after]
        .map(|value| value.as_deref().map_or_else(|| "none".into(), cut));
    format!("{}{of}: {before} -> {after}", values.property)
}

fn element_json(found: &Changes<'_>, of: &ElementChange) -> Value {
    let mut object = json!({
        "element": of.element.name(),
        "id": found.id(of),
        "change": of.change.name(),
    });
    match of.change {
        Change::Added | Change::Removed => {}
        Change::Renamed => object["to"] = json!(found.new_id(of)),
        Change::Moved { distance_m } => object["distance_m"] = json!(distance_m),
        Change::Reshaped { greatest_m } => object["greatest_m"] = json!(greatest_m),
        Change::Set(_) => {
            if let Some(values) = found.values(of) {
                object["property"] = json!(values.property);
                object["vehicle_type"] = json!(values.vehicle_type);
                object["before"] = json!(values.before);
                object["after"] = json!(values.after);
            }
        }
    }
    object
}

/// A value on one line, cut to a length that can be read.
fn cut(value: &str) -> String {
    text::single_line(value, MAX_VALUE)
}

/// A text as a cell of a Markdown table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cuts_long_values_and_keeps_rows_apart() {
        assert_eq!(cut("short"), "short");
        assert_eq!(cut(&"x".repeat(100)).chars().count(), MAX_VALUE + 1);
        assert_eq!(cell("a|b"), "a\\|b");
        let values = ChangedTexts {
            property: "maxSpeed",
            vehicle_type: Some("tug"),
            before: None,
            after: Some("1.5 m/s".into()),
        };
        assert_eq!(set(&values), "maxSpeed for `tug`: none -> 1.5 m/s");
    }
}
