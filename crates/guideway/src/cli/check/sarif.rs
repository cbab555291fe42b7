//! The findings as SARIF 2.1.0 for code review tools: Static Analysis Results Interchange Format
//! (<https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html>), within the limits of
//! GitHub's code scanning.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use guideway::layout::{Code, Diagnostic, FindingKind, Severity, UserError};
use serde_json::{Value, json};

use super::findings::CheckedFile;
use super::fingerprint::fingerprint;
use crate::cli::error::{Exit, json_error};
use crate::cli::input::{relative, resolved};
use crate::cli::output::json_text;

const SCHEMA: &str =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

/// Results that GitHub shows.
const MAX_RESULTS: usize = 5000;

/// Remedies that the help of a rule lists.
const MAX_REMEDIES: usize = 3;

/// A finding and the index of its file.
type FileFinding<'a> = (usize, &'a Diagnostic);

pub(super) fn bytes(files: &[CheckedFile], exit: Exit) -> Result<Vec<u8>, UserError> {
    let all = FindingKind::of(files.iter().map(|file| &file.found));
    let codes: BTreeSet<Code> = all.iter().map(|kind| kind.code).collect();
    let rule_index = |code: Code| codes.iter().position(|known| *known == code);
    let found = files.iter().enumerate();
    let found = found.flat_map(|(i, file)| file.found.iter().map(move |finding| (i, finding)));
    let mut found: Vec<FileFinding<'_>> = found.collect();
    found.sort_by_key(|(_, finding)| std::cmp::Reverse(finding.severity));
    found.truncate(MAX_RESULTS);
    let rules = codes.iter().map(|&code| rule(code, &remedies(code, files)));
    let rules: Vec<Value> = rules.collect();
    let uris: Vec<String> = files.iter().map(|file| uri(&file.path)).collect();
    let mut seen: HashMap<(usize, String), u64> = HashMap::new();
    let results = found.iter().map(|&(file, finding)| {
        let fingerprint = fingerprint(finding);
        let number = seen.entry((file, fingerprint.clone())).or_default();
        *number += 1;
        let mut result = result(finding, &uris[file], file, rule_index(finding.code));
        result["partialFingerprints"] = json!({
            // GitHub reads this one only.
            "primaryLocationLineHash": format!("{fingerprint}:{number}"),
            "guidewayFinding/v1": fingerprint,
        });
        result
    });
    let results: Vec<Value> = results.collect();
    let mut invocation = json!({
        "executionSuccessful": exit != Exit::Failed,
        "exitCode": exit.code(),
    });
    if let Some(text) = left_out(&all, &found) {
        let note = json!({ "level": "note", "message": { "text": text } });
        invocation["toolExecutionNotifications"] = json!([note]);
    }
    let artifact = |uri: &String| json!({ "location": { "uri": uri } });
    let log = json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": {
                "driver": {
                    "name": "Guideway",
                    "semanticVersion": env!("CARGO_PKG_VERSION"),
                    "informationUri": env!("CARGO_PKG_REPOSITORY"),
                    "rules": rules,
                },
            },
            "columnKind": "unicodeCodePoints",
            "invocations": [invocation],
            "artifacts": uris.iter().map(artifact).collect::<Vec<Value>>(),
            "results": results,
        }],
    });
    json_text(&log).map_err(|error| json_error(&error, "Use another --format"))
}

/// The number of findings by severity that the log does not list, if there are some.
fn left_out(all: &[FindingKind], listed: &[FileFinding<'_>]) -> Option<String> {
    let mut counts: BTreeMap<Severity, u64> = BTreeMap::new();
    for kind in all {
        *counts.entry(kind.severity).or_default() += kind.count;
    }
    for (_, finding) in listed {
        *counts.entry(finding.severity).or_default() -= 1;
    }
    let left = counts.into_iter().rev().filter(|(_, count)| *count > 0);
    let left: Vec<String> = left
        .map(|(severity, n)| format!("{n} of severity {severity}"))
        .collect();
    (!left.is_empty()).then(|| {
        format!(
            "findings are left out: {}; a log has at most {MAX_RESULTS}, the most severe ones",
            left.join(", ")
        )
    })
}

/// The remedies of the findings of a kind, the first few.
fn remedies(code: Code, files: &[CheckedFile]) -> Vec<String> {
    let mut remedies: Vec<String> = Vec::new();
    let found = files.iter().flat_map(|file| file.found.iter());
    for finding in found.filter(|finding| finding.code == code) {
        if remedies.len() < MAX_REMEDIES && !remedies.contains(&finding.remedy) {
            remedies.push(finding.remedy.clone());
        }
    }
    remedies
}

fn rule(code: Code, remedies: &[String]) -> Value {
    let page = concat!(
        env!("CARGO_PKG_REPOSITORY"),
        "/blob/main/docs/diagnostics.md"
    );
    let page = format!("{page}#{}-{}", code.name(), code.severity());
    let meaning = code.meaning();
    let sentences: String = remedies
        .iter()
        .map(|remedy| format!(" {remedy}."))
        .collect();
    let list: String = remedies
        .iter()
        .map(|remedy| format!("- {remedy}.\n"))
        .collect();
    json!({
        "id": code.name(),
        "name": code.name(),
        "shortDescription": { "text": meaning },
        "fullDescription": { "text": meaning },
        "help": {
            "text": format!("{meaning}{sentences}"),
            "markdown": format!("{meaning}\n\n{list}\n[Explanation and examples]({page})\n"),
        },
        "helpUri": page,
        "defaultConfiguration": { "level": level(code.severity()) },
        "properties": { "tags": ["layout"] },
    })
}

fn result(finding: &Diagnostic, uri: &str, index: usize, rule: Option<usize>) -> Value {
    let Diagnostic {
        code,
        severity,
        place,
        message,
        remedy,
    } = finding;
    // GitHub rejects results without a line: those of the whole file are at its begin.
    let mut region = json!({ "startLine": place.line.unwrap_or(1).max(1) });
    if let Some(column) = place.column.filter(|_| place.line.is_some()) {
        region["startColumn"] = column.into();
    }
    json!({
        "ruleId": code.name(),
        "ruleIndex": rule,
        "level": level(*severity),
        "message": { "text": format!("{}: {message}. {remedy}.", place.element) },
        "locations": [{
            "physicalLocation": {
                "artifactLocation": { "uri": uri, "index": index },
                "region": region,
            },
            "logicalLocations": [{ "fullyQualifiedName": place.element, "kind": "element" }],
        }],
    })
}

fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Info => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

/// A file as a URI reference (RFC 3986): relative to the working folder if it is inside of it, as
/// tools expect that run at the root of a repository.
fn uri(file: &Path) -> String {
    let working = std::env::current_dir().map(|folder| resolved(&folder));
    let inside = working
        .ok()
        .map(|folder| relative(&resolved(file), &folder));
    match inside.filter(|path| path != ".." && !path.starts_with("../")) {
        Some(path) => encoded(&path),
        None => absolute_uri(&resolved(file)),
    }
}

fn absolute_uri(file: &Path) -> String {
    let path = file.to_string_lossy();
    match cfg!(windows) {
        true => windows_uri(&path),
        false => format!("file:///{}", encoded(path.trim_start_matches('/'))),
    }
}

/// The URI of `C:\a` or `\\server\a` (RFC 8089, appendix E), also with the prefix `\\?\` of long
/// paths.
fn windows_uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let long = path.strip_prefix("//?/");
    let share = match long {
        Some(long) => long.strip_prefix("UNC/"),
        None => path.strip_prefix("//"),
    };
    if let Some(share) = share {
        return format!("file://{}", encoded(share));
    }
    let path = long.unwrap_or(&path);
    match path.split_once(':') {
        Some((drive, rest)) => format!("file:///{drive}:{}", encoded(rest)),
        None => format!("file:///{}", encoded(path.trim_start_matches('/'))),
    }
}

fn encoded(path: &str) -> String {
    let mut uri = String::new();
    for byte in path.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(char::from(byte));
            }
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodes_file_names_as_uris() {
        assert_eq!(encoded("a b/hälle.json"), "a%20b/h%C3%A4lle.json");
        assert_eq!(
            absolute_uri(Path::new("/tmp/x#1.dxf")),
            "file:///tmp/x%231.dxf"
        );
        assert_eq!(uri(Path::new("./src/x.json")), "src/x.json");
    }

    #[test]
    fn encodes_files_of_windows_as_uris() {
        for (path, uri) in [
            (r"Z:\Hall 2\x.json", "file:///Z:/Hall%202/x.json"),
            (r"\\?\C:\x.json", "file:///C:/x.json"),
            (r"\\server\plans\x.json", "file://server/plans/x.json"),
            (r"\\?\UNC\server\x.json", "file://server/x.json"),
        ] {
            assert_eq!(windows_uri(path), uri);
        }
    }

    #[test]
    fn findings_beyond_the_limit_are_counted_by_severity() {
        let kinds = [(Severity::Error, 2), (Severity::Info, 7)];
        let kinds = kinds.map(|(severity, count)| FindingKind {
            code: Code::Kink,
            severity,
            count,
        });
        let text = left_out(&kinds, &[]).unwrap();
        assert!(
            text.contains("2 of severity error, 7 of severity info;"),
            "{text}"
        );
        assert_eq!(left_out(&[], &[]), None);
    }
}
