//! Actions of an order: completes lists of actions from other formats, which lack identifiers.

use serde_json::{Value, json};

use super::version::Version;

/// Completes a list of actions: `Some(None)` if it is complete, `None` if it is no list of actions.
/// An action without a valid blocking type blocks everything, which is safe.
pub(super) fn complete(text: &str, version: Version, owner: &str) -> Option<Option<String>> {
    let Ok(Value::Array(mut actions)) = serde_json::from_str::<Value>(text) else {
        return None;
    };
    let blocking: &[&str] = match version {
        Version::V2 => &["NONE", "SOFT", "HARD"],
        Version::V3 => &["NONE", "SOFT", "SINGLE", "HARD"],
    };
    let mut is_changed = false;
    for (i, action) in actions.iter_mut().enumerate() {
        let members = action.as_object_mut()?;
        if !members.get("actionType").is_some_and(Value::is_string) {
            return None;
        }
        let parameters = members.get("actionParameters");
        if !parameters.is_none_or(are_parameters) {
            return None;
        }
        if !members.get("actionId").is_some_and(Value::is_string) {
            members.insert("actionId".to_owned(), json!(format!("{owner}-{i}")));
            is_changed = true;
        }
        let own = members.get("blockingType").and_then(Value::as_str);
        if !own.is_some_and(|own| blocking.contains(&own)) {
            members.insert("blockingType".to_owned(), json!("HARD"));
            is_changed = true;
        }
    }
    Some(is_changed.then(|| Value::Array(actions).to_string()))
}

fn are_parameters(value: &Value) -> bool {
    let is_parameter = |parameter: &Value| {
        let has_key = parameter.get("key").is_some_and(Value::is_string);
        has_key && parameter.get("value").is_some_and(|value| !value.is_null())
    };
    let list = value.as_array();
    list.is_some_and(|list| list.iter().all(is_parameter))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn completes_what_the_schema_requires() {
        let whole = r#"[{"actionType":"pick","actionId":"7","blockingType":"SOFT"}]"#;
        assert_eq!(complete(whole, Version::V2, "e"), Some(None));
        let text = r#"[{"actionType":"pick","blockingType":"SINGLE"}]"#;
        let completed = complete(text, Version::V2, "e-1").flatten().unwrap();
        let completed: Value = serde_json::from_str(&completed).unwrap();
        assert_eq!(completed[0]["actionId"], "e-1-0");
        assert_eq!(completed[0]["blockingType"], "HARD");
        let completed = complete(text, Version::V3, "e-1").flatten().unwrap();
        assert!(completed.contains("SINGLE"));
        for bad in [
            "{}",
            "[1]",
            "[{}]",
            r#"[{"actionType":"a","actionParameters":[{}]}]"#,
        ] {
            assert_eq!(complete(bad, Version::V2, "e"), None, "{bad}");
        }
    }
}
