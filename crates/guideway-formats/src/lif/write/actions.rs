//! Actions of LIF 1.0: tells whether a list of actions follows its schema, which is narrower than
//! those of LIF 2.0 and VDA 5050.

use serde_json::Value;

const BLOCKING_TYPES: [&str; 3] = ["NONE", "SOFT", "HARD"];
const REQUIREMENT_TYPES: [&str; 3] = ["REQUIRED", "CONDITIONAL", "OPTIONAL"];

/// Returns whether a JSON text is a list of actions of LIF 1.0.
pub(super) fn are_actions_of_1(text: &str) -> bool {
    match serde_json::from_str::<Value>(text) {
        Ok(Value::Array(actions)) => actions.iter().all(is_action),
        _ => false,
    }
}

fn is_action(action: &Value) -> bool {
    let is_one_of = |key: &str, choices: &[&str]| {
        let text = action.get(key).and_then(Value::as_str);
        text.is_some_and(|text| choices.contains(&text))
    };
    let is_text = |key: &str| action.get(key).is_some_and(Value::is_string);
    let lacks = |key: &str| action.get(key).is_none();
    let parameters = match action.get("actionParameters") {
        None => Some(&[][..]),
        Some(list) => list.as_array().map(Vec::as_slice),
    };
    let is_parameter = |parameter: &Value| {
        let has_text = |key: &str| parameter.get(key).is_some_and(Value::is_string);
        has_text("key") && has_text("value")
    };
    is_text("actionType")
        && is_one_of("blockingType", &BLOCKING_TYPES)
        && (lacks("requirementType") || is_one_of("requirementType", &REQUIREMENT_TYPES))
        && (lacks("actionDescription") || is_text("actionDescription"))
        && parameters.is_some_and(|list| list.iter().all(is_parameter))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_the_schema() {
        assert!(are_actions_of_1("[]"));
        let valid = r#"[{"actionType": "pick", "blockingType": "HARD",
            "actionParameters": [{"key": "a", "value": "1"}]}]"#;
        assert!(are_actions_of_1(valid));
        for (from, to) in [
            ("\"1\"", "1"),
            ("HARD", "SINGLE"),
            ("actionType", "type"),
            ("[{\"key\"", "{\"key\""),
        ] {
            assert!(!are_actions_of_1(&valid.replacen(from, to, 1)), "{to}");
        }
    }
}
