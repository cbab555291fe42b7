//! Checks a written file by the schemas of VDMA and openTCS. Needs Python with jsonschema and
//! lxml; `GUIDEWAY_PYTHON` names the interpreter.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

const SCRIPT: &str = "
import json, sys
schema, text = sys.argv[1], sys.stdin.buffer.read()
if schema.endswith('.json'):
    import jsonschema
    validator = jsonschema.Draft7Validator(json.load(open(schema)))
    found = validator.iter_errors(json.loads(text))
    errors = [f'{list(error.absolute_path)} {error.message[:200]}' for error in found]
else:
    from lxml import etree
    validator = etree.XMLSchema(etree.parse(schema))
    validator.validate(etree.fromstring(text))
    errors = [str(error) for error in validator.error_log]
print('checked', *errors, sep='\\n')
";

/// The errors of a file by a schema below `shared/conformance/schemas`, one per line; `None` (and a
/// message) without the schema, or a Python that can check it.
pub(super) fn schema_errors(schema: &str, file: &[u8]) -> Option<String> {
    let shared = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../shared/conformance/schemas"
    );
    let path = Path::new(shared).join(schema);
    if !path.is_file() {
        println!("SKIPPED: there is no schema at {}", path.display());
        return None;
    }
    let interpreter = std::env::var("GUIDEWAY_PYTHON").unwrap_or_else(|_| "python3".into());
    let python = Command::new(&interpreter)
        .args(["-c", SCRIPT])
        .arg(path)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn();
    let mut python = python.ok()?;
    // A Python without the modules does not read.
    let _ = python.stdin.take()?.write_all(file);
    let output = python.wait_with_output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let errors = text.strip_prefix("checked\n").map(str::to_owned);
    if errors.is_none() {
        println!("SKIPPED: {interpreter} lacks jsonschema or lxml; set GUIDEWAY_PYTHON");
    }
    errors
}

#[test]
fn schemas_find_what_is_wrong() {
    for (schema, wrong) in [
        ("LIF-1.0.schema.json", &b"{\"layouts\": []}"[..]),
        (
            "opentcs-model-7.0.0.xsd",
            b"<model version=\"7.0.0\"><point/></model>",
        ),
    ] {
        if let Some(errors) = schema_errors(schema, wrong) {
            assert!(!errors.trim().is_empty(), "{schema}");
        }
    }
}
