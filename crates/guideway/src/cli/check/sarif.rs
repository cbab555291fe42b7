//! The findings as SARIF 2.1.0 for code review tools: Static Analysis Results Interchange Format
//! (<https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html>).

use std::collections::BTreeSet;

use guideway::layout::{Code, Diagnostic, FindingKind, Severity, UserError};
use serde_json::{Value, json};

use super::findings::CheckedFile;
use crate::cli::error::json_error;
use crate::cli::exit::Exit;

const SCHEMA: &str =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

pub(super) fn bytes(files: &[CheckedFile], exit: Exit) -> Result<Vec<u8>, UserError> {
    let kinds = FindingKind::of(files.iter().map(|file| &file.found));
    let codes: BTreeSet<Code> = kinds.iter().map(|kind| kind.code).collect();
    let rules: Vec<Value> = codes.iter().map(|&code| rule(code)).collect();
    let rule_index = |code: Code| codes.iter().position(|known| *known == code);
    let results = files.iter().enumerate().flat_map(|(i, file)| {
        let result = move |finding| result(finding, &file.file, i, rule_index(finding.code));
        file.found.iter().map(result)
    });
    let all: u64 = kinds.iter().map(|kind| kind.count).sum();
    let listed: usize = files.iter().map(|file| file.found.iter().count()).sum();
    let mut invocation = json!({ "executionSuccessful": true, "exitCode": exit.code() });
    if all > listed as u64 {
        let text = format!(
            "{} findings of very frequent kinds are left out",
            all - listed as u64
        );
        let note = json!({ "level": "note", "message": { "text": text } });
        invocation["toolExecutionNotifications"] = json!([note]);
    }
    let artifact = |file: &CheckedFile| json!({ "location": { "uri": uri(&file.file) } });
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
            "invocations": [invocation],
            "artifacts": files.iter().map(artifact).collect::<Vec<Value>>(),
            "results": results.collect::<Vec<Value>>(),
        }],
    });
    let bytes = serde_json::to_vec_pretty(&log);
    let mut bytes = bytes.map_err(|error| json_error(&error, "Use another --format"))?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn rule(code: Code) -> Value {
    let page = concat!(
        env!("CARGO_PKG_REPOSITORY"),
        "/blob/main/docs/diagnostics.md"
    );
    json!({
        "id": code.name(),
        "shortDescription": { "text": code.meaning() },
        "helpUri": format!("{page}#{}-{}", code.name(), code.severity()),
        "defaultConfiguration": { "level": level(code.severity()) },
    })
}

fn result(finding: &Diagnostic, file: &str, index: usize, rule: Option<usize>) -> Value {
    let Diagnostic {
        code,
        severity,
        place,
        message,
        remedy,
    } = finding;
    let mut physical = json!({ "artifactLocation": { "uri": uri(file), "index": index } });
    if let Some(line) = place.line.filter(|&line| line > 0) {
        physical["region"] = json!({ "startLine": line });
    }
    json!({
        "ruleId": code.name(),
        "ruleIndex": rule,
        "level": level(*severity),
        "message": { "text": format!("{}: {message}. {remedy}.", place.element) },
        "locations": [{
            "physicalLocation": physical,
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

/// A file name as a URI reference (RFC 3986). Relative names stay relative, as tools expect.
fn uri(file: &str) -> String {
    let mut uri = String::new();
    for byte in file.bytes() {
        match byte {
            b'\\' if cfg!(windows) => uri.push('/'),
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(char::from(byte));
            }
            _ => uri += &format!("%{byte:02X}"),
        }
    }
    match uri.starts_with('/') {
        true => format!("file://{uri}"),
        false => uri,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodes_file_names_as_uris() {
        assert_eq!(uri("a b/hälle.json"), "a%20b/h%C3%A4lle.json");
        assert_eq!(uri("/tmp/x#1.dxf"), "file:///tmp/x%231.dxf");
    }
}
