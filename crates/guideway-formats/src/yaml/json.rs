//! YAML to JSON: writes a value of a YAML file as JSON text.

use guideway_layout::Value;
use serde_json::Value as Json;

use super::node::YamlNode;

/// Deepest nesting of a converted value; aliases can nest a short file without end.
const MAX_DEPTH: usize = 64;

impl YamlNode<'_> {
    /// Returns the value as JSON without spaces; `None` if it would take more than `max_bytes`, or
    /// is nested too deeply.
    pub(crate) fn to_json(self, max_bytes: usize) -> Option<String> {
        let mut json = String::new();
        self.append_json(&mut json, max_bytes, MAX_DEPTH)?;
        Some(json)
    }

    fn append_json(self, json: &mut String, max_bytes: usize, depth: usize) -> Option<()> {
        let depth = depth.checked_sub(1)?;
        if self.is_list() {
            json.push('[');
            for (i, item) in self.items().enumerate() {
                json.push_str(if i == 0 { "" } else { "," });
                item.append_json(json, max_bytes, depth)?;
            }
            json.push(']');
        } else if self.is_map() {
            json.push('{');
            for (i, (key, value)) in self.entries().enumerate() {
                json.push_str(if i == 0 { "" } else { "," });
                json.push_str(&Json::from(key).to_string());
                json.push(':');
                value.append_json(json, max_bytes, depth)?;
            }
            json.push('}');
        } else {
            json.push_str(&scalar(self));
        }
        (json.len() <= max_bytes).then_some(())
    }
}

/// Returns a single value as JSON. A number keeps its digits where JSON has the same notation.
fn scalar(node: YamlNode<'_>) -> String {
    let text = node.text().unwrap_or_default();
    let is_json_number = serde_json::from_str::<serde_json::Number>(text).is_ok();
    match node.value() {
        None => "null".to_owned(),
        Some(Value::Bool(value)) => value.to_string(),
        Some(Value::Int(_) | Value::Float(_)) if is_json_number => text.to_owned(),
        Some(Value::Int(value)) => value.to_string(),
        Some(Value::Float(value)) if value.is_finite() => Json::from(value).to_string(),
        _ => Json::from(text).to_string(),
    }
}
