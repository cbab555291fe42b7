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
    let parts: Vec<&str> = code.split('"').collect();
    let is_shown = |number: &usize| !parts[number - 1].ends_with("reason = ");
    let literals = (1..parts.len()).step_by(2).filter(is_shown);
    let literals = literals.map(|number| parts[number]);
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

/// The sources below a file or folder, without tests.
fn sources(of: &Path) -> Vec<PathBuf> {
    if of.is_file() {
        return vec![of.to_owned()];
    }
    let entries = fs::read_dir(of).unwrap().map(|entry| entry.unwrap().path());
    let is_code = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy();
        // Names of formats and encodings are the same in all languages.
        let has_names = ["format.rs", "target.rs", "browser.rs"].contains(&&*name);
        let is_shown = !name.contains("test") && !has_names;
        is_shown && (path.is_dir() || name.ends_with(".rs"))
    };
    entries
        .filter(is_code)
        .flat_map(|path| sources(&path))
        .collect()
}

/// Checks that each text of these sources of other crates is part of a form.
fn assert_translated(of: &[&str], least: usize, is_text: impl Fn(&str) -> bool) {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let files = of.iter().flat_map(|of| sources(&crates.join(of)));
    let tables = [
        include_str!("../messages.tsv"),
        include_str!("../message_parts.tsv"),
    ];
    let forms = tables.iter().flat_map(|table| table.lines());
    let forms = forms.filter_map(|line| line.split_once('\t'));
    let forms: Vec<String> = forms.map(|(form, _)| without_names(form)).collect();
    let texts = files.flat_map(|file| texts(&file));
    let texts: Vec<String> = texts.filter(|text| is_text(text)).collect();
    assert!(texts.len() > least, "{}", texts.len());
    let is_missing = |text: &&String| !forms.iter().any(|form| form.contains(&***text));
    let missing: Vec<&String> = texts.iter().filter(is_missing).collect();
    assert!(missing.is_empty(), "without a German form: {missing:#?}");
}

#[test]
fn each_text_of_findings_reports_and_edits_has_a_german_form() {
    let sources = [
        "guideway-layout/src/check",
        "guideway-layout/src/place.rs",
        "guideway-layout/src/property.rs",
        "guideway-network/src/analyze",
        "guideway-network/src/build/error.rs",
        "guideway-network/src/build/report.rs",
        "guideway-network/src/route/error.rs",
        "guideway-network/src/route/rows.rs",
        "guideway-document/src/edit/error.rs",
        "guideway-document/src/edit/property_value.rs",
        "guideway-document/src/edit/shapes/error.rs",
        "guideway-document/src/fixes",
        "guideway-document/src/query/parse.rs",
        "guideway-scene/src/edit/error.rs",
        "guideway-spline/src/construct/error.rs",
        "guideway-spline/src/nurbs.rs",
        "guideway-envelope/src/clearance",
        "guideway-envelope/src/no_envelope.rs",
    ];
    assert_translated(&sources, 200, |_| true);
}

#[test]
fn each_text_of_readers_and_writers_has_a_german_form() {
    // Contents of files, words of JSON's parser, and what the test takes for texts.
    let others = [
        "<",
        "    ",
        "  {}",
        "\" and \"",
        " at ",
        ")",
        " =>",
        ", CONVERT",
        ", and ",
        "0 secs",
        "AutoCAD ",
        "a column of type ",
        "Default layer",
        "Guideway ",
        "SQLite ",
        "building_name:",
        "column ",
        "doors:",
        "expected `",
        "expected value",
        "graph ",
        "human lane",
        "key must be",
        "lifts:",
        "list<",
        "number out of range",
        "one schema, one precision",
        "only screen",
        "recursion limit",
        "struct<",
        "trailing ",
        "version https",
        "width=",
        "{}[]",
        "{}({}(",
        "{} years",
        "{}{}{}.{}",
    ];
    let is_text = |text: &str| {
        let is_sentence = text.replace("{}", "").trim().contains(' ');
        let is_other = text.contains('\\') || others.iter().any(|o| text.starts_with(o));
        is_sentence && !is_other
    };
    assert_translated(&["guideway-formats/src"], 900, is_text);
    let others = [
        "guideway-compose/src/error.rs",
        "guideway-scene/src/error.rs",
        "guideway-window/src/project_file.rs",
        "guideway-window/src/save.rs",
        "guideway/src/cli/floor_plan",
        "guideway/src/files.rs",
    ];
    assert_translated(&others, 30, |text| {
        text != "reading {}" && text != "is no {}"
    });
}

#[test]
fn no_form_is_hidden_by_an_earlier_one() {
    let sample = |form: &Form| {
        let pieces = form.english.iter().map(|piece| match piece {
            Piece::Text(text) => *text,
            Piece::Value { kind, .. } if *kind == ValueKind::Optional => "",
            Piece::Value { name, .. } => *name,
        });
        pieces.collect::<String>()
    };
    let mut hidden = Vec::new();
    for forms in [&*MESSAGES, &*PARTS] {
        for (number, form) in forms.iter().enumerate() {
            let text = sample(form);
            let fits = |form: &Form| form.values_of(&text).is_some();
            let first = forms.iter().position(fits);
            if first != Some(number) {
                hidden.push((text, first.map(|first| sample(&forms[first]))));
            }
        }
    }
    assert!(hidden.is_empty(), "behind an earlier form: {hidden:#?}");
}

#[test]
fn each_format_is_named_in_german() {
    let formats = guideway_formats::Format::ALL.iter();
    let list = german("Guideway reads x");
    let missing: Vec<&str> = formats.map(|format| format.name()).collect();
    let missing = missing.iter().filter(|name| !list.contains(*name));
    assert_eq!(missing.count(), 0, "{list}");
}

#[test]
fn errors_are_translated_part_by_part() {
    assert_eq!(
        german("halle.json: nodes[2]: expected an object, found an array. Save the file as UTF-8"),
        "halle.json: nodes[2]: erwartet ein Objekt, vorhanden eine Liste. Speichern Sie die \
         Datei als UTF-8"
    );
}
