//! YAML as text: names, values and objects in flow style.

use guideway_layout::Value;
use serde_json::value::RawValue;

/// Returns a text in double quotes. Characters that YAML does not allow are escaped.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            '\u{2028}' | '\u{2029}' | '\u{FEFF}' | '\u{FFFE}' | '\u{FFFF}' => {
                quoted += &format!("\\u{:04X}", u32::from(c));
            }
            c if c.is_control() => quoted += &format!("\\u{:04X}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// Returns a key: plain where no YAML reader takes it for another type.
pub(super) fn key(name: &str) -> String {
    const OTHER_TYPES: [&str; 10] = [
        "null", "true", "false", "yes", "no", "on", "off", "y", "n", "nan",
    ];
    let mut chars = name.chars();
    let begins_with_letter = chars.next().is_some_and(|c| c.is_ascii_alphabetic());
    let is_word = begins_with_letter && chars.all(|c| c.is_ascii_alphanumeric() || c == '_');
    match is_word && !OTHER_TYPES.contains(&name.to_ascii_lowercase().as_str()) {
        true => name.to_owned(),
        false => quoted(name),
    }
}

/// Returns a number, with a fraction or an exponent.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        return ".nan".to_owned();
    }
    match value.is_finite() {
        true => serde_json::Value::from(value).to_string(),
        false if value > 0.0 => ".inf".to_owned(),
        false => "-.inf".to_owned(),
    }
}

/// Returns a value of a column. Lists and objects are written as JSON, which is YAML; `None` for a
/// text that is no JSON, or a list or an object that the reader would not take for one.
pub(super) fn value(value: Value<'_>) -> Option<String> {
    Some(match value {
        Value::Bool(value) => value.to_string(),
        Value::Int(value) => value.to_string(),
        Value::Float(value) => number(value),
        Value::Text(text) => quoted(text),
        Value::Json(json) => {
            let is_nested = json.trim_start().starts_with(['[', '{']);
            let is_json = serde_json::from_str::<&RawValue>(json).is_ok();
            return (is_nested && is_json).then(|| on_one_line(json));
        }
    })
}

/// Replaces the white space between the values of a JSON text: a tab could not be read as YAML.
fn on_one_line(json: &str) -> String {
    let (mut line, mut in_string, mut is_escaped) = (String::new(), false, false);
    for c in json.chars() {
        if in_string {
            let ends = c == '"' && !is_escaped;
            is_escaped = c == '\\' && !is_escaped;
            in_string = !ends;
            line.push(c);
        } else {
            in_string = c == '"';
            line.push(if c.is_whitespace() { ' ' } else { c });
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_keys_are_quoted_where_yaml_needs_it() {
        assert_eq!(quoted("a \"b\"\t\u{7f}"), r#""a \"b\"\u0009\u007F""#);
        assert_eq!(key("speed_limit"), "speed_limit");
        for name in ["Yes", "no", "7", "a b", "", "null", "ä"] {
            assert!(key(name).starts_with('"'), "{name}");
        }
    }

    #[test]
    fn values_keep_their_type() {
        assert_eq!(value(Value::Float(1.0)).as_deref(), Some("1.0"));
        assert_eq!(value(Value::Float(f64::NAN)).as_deref(), Some(".nan"));
        assert_eq!(value(Value::Text("1")).as_deref(), Some("\"1\""));
        let json = Value::Json("{\"a\t\":\t[1,\n2]}");
        assert_eq!(value(json), None, "a tab in a string is no JSON");
        let json = Value::Json("{\"a\":\t[1,\n2]}");
        assert_eq!(value(json).as_deref(), Some("{\"a\": [1, 2]}"));
        assert_eq!(value(Value::Json("3")), None);
    }
}
