//! The rules, applied to one file.

use super::violation::Violation;
use super::words::FORBIDDEN;

/// Widest line of code, comments and prose, in characters.
const MAX_COLUMNS: usize = 100;
/// Longest Rust file.
const MAX_RUST_LINES: usize = 400;
/// Longest shader.
const MAX_SHADER_LINES: usize = 200;
/// The call that prints a file name as it is.
const RAW_NAME: &str = ".display()";
/// First words of headings and of comment paragraphs that make a riddle of the subject.
const QUESTION_WORDS: &[&str] = &["What", "Which", "Who", "Where", "How", "Whether"];

/// Kind of a file: the rules differ by it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rust,
    Shader,
    Markdown,
}

/// Checks a file by its name relative to the repository; files of other kinds pass.
pub fn check_file(name: &str, text: &str) -> Vec<Violation> {
    let Some(kind) = kind(name) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let mut add = |line: usize, message: String| {
        found.push(Violation {
            file: name.to_owned(),
            line,
            message,
        });
    };
    let lines = text.lines().count();
    let limit = match kind {
        Kind::Rust => Some(MAX_RUST_LINES),
        Kind::Shader => Some(MAX_SHADER_LINES),
        Kind::Markdown => None,
    };
    if let Some(limit) = limit.filter(|&limit| lines > limit) {
        add(
            1,
            format!("{lines} lines, limit {limit}: split the file by what it does"),
        );
    }
    if kind == Kind::Rust && needs_header(name) && !has_header(text) {
        add(
            1,
            "no module header: begin with `//!`, what it does, its input and output".to_owned(),
        );
    }
    let mut in_fence = false;
    for (line, number) in text.lines().zip(1..) {
        if kind == Kind::Markdown && line.trim_start().starts_with("```") {
            in_fence = !in_fence;
        }
        if is_too_wide(line, kind, in_fence) {
            let columns = line.chars().count();
            add(
                number,
                format!("{columns} columns, limit {MAX_COLUMNS}: wrap the line"),
            );
        }
        if kind == Kind::Rust && is_product(name) && line.contains(RAW_NAME) {
            let message = "a raw file name may steer the terminal: use `shown_path`";
            add(number, message.to_owned());
        }
        let prose = prose(line, kind, in_fence);
        if let Some(word) = prose.and_then(question_subject) {
            add(
                number,
                format!("`{word}` as subject: write subject, verb, object"),
            );
        }
        for (word, term) in FORBIDDEN {
            let is_name = word.starts_with(char::is_uppercase);
            let place = if is_name { Some(line) } else { prose };
            if place.is_some_and(|place| has_word(place, word)) {
                add(number, format!("`{word}`: use {term} (docs/glossary.md)"));
            }
        }
    }
    found
}

fn kind(name: &str) -> Option<Kind> {
    let is_exempt = name.starts_with("xtask/src/style/")
        || name.starts_with("xtask/tests/style")
        || name.starts_with("bench/runs/");
    let ending = name.rsplit_once('.')?.1;
    match ending {
        _ if is_exempt => None,
        "rs" => Some(Kind::Rust),
        "wgsl" | "glsl" | "vert" | "frag" | "tesc" | "tese" | "comp" => Some(Kind::Shader),
        "md" => Some(Kind::Markdown),
        _ => None,
    }
}

/// Returns `true` if a file is a module of a crate: tests and build scripts describe themselves by
/// their names.
fn needs_header(name: &str) -> bool {
    name.contains("/src/") && !name.contains("tests")
}

/// Returns `true` if a file is a part of what users run.
fn is_product(name: &str) -> bool {
    needs_header(name) && name.starts_with("crates/")
}

fn has_header(text: &str) -> bool {
    text.lines()
        .find(|line| !line.trim().is_empty())
        .is_some_and(|line| line.starts_with("//!"))
}

/// Tables cannot be wrapped, in Markdown as in documentation comments.
fn is_too_wide(line: &str, kind: Kind, in_fence: bool) -> bool {
    let text = line
        .trim_start()
        .trim_start_matches(['/', '!'])
        .trim_start();
    let is_exempt = text.starts_with('|')
        || line.contains("http")
        || kind == Kind::Markdown && (in_fence || line.contains("]("));
    !is_exempt && line.chars().count() > MAX_COLUMNS
}

/// The prose of a line: the text of a comment, or a line of Markdown.
fn prose(line: &str, kind: Kind, in_fence: bool) -> Option<&str> {
    match kind {
        Kind::Markdown => (!in_fence).then_some(line),
        Kind::Rust | Kind::Shader => {
            let comment = line.trim_start().strip_prefix("//")?;
            Some(comment.trim_start_matches(['/', '!']).trim_start())
        }
    }
}

/// The question word with which a heading or a one-line comment begins.
fn question_subject(prose: &str) -> Option<&'static str> {
    let text = prose.trim_start_matches('#').trim_start();
    let first = text.split(' ').next()?;
    let is_sentence = text.ends_with('.') || prose.starts_with('#');
    let is_question = text.ends_with('?');
    QUESTION_WORDS
        .iter()
        .find(|&&word| word == first && is_sentence && !is_question)
        .copied()
}

/// Returns `true` if a text has a word or a phrase, not as part of a longer word.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}
