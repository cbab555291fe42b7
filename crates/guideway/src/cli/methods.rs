use guideway::{AUTO, Available, MethodOption};
use serde_json::{Value, json};

use super::{Exit, Failure, Output};

/// Room for the longest name of a method.
const INDENT: usize = 20;

pub(crate) fn run(out: &Output) -> Result<Exit, Failure> {
    let all = guideway::methods();
    let auto = all.iter().find(|m| m.why_not.is_none());
    let body = json!({
        "auto": auto.map(|m| m.info.name),
        "methods": all.iter().map(json_of).collect::<Vec<Value>>(),
    });
    out.report("methods", &body, || {
        let mut text = String::new();
        if let Some(method) = auto {
            text += &format!("{AUTO:<INDENT$} chooses `{}` here\n", method.info.name);
        }
        for method in &all {
            let Available {
                info,
                options,
                why_not,
            } = method;
            text += &format!("{:<INDENT$} {}\n", info.name, info.summary);
            text += &match why_not {
                None => format!("{:<INDENT$} runs on {}\n", "", info.device),
                Some(why) => format!("{:<INDENT$} does not run here: {why}\n", ""),
            };
            for MethodOption { name, summary } in *options {
                text += &format!("{:<INDENT$}   +{name:<16} {summary}\n", "");
            }
        }
        text
    })?;
    Ok(Exit::Clean)
}

fn json_of(method: &Available) -> Value {
    let options = method.options.iter();
    let options = options.map(|o| json!({ "name": o.name, "summary": o.summary }));
    json!({
        "name": method.info.name,
        "summary": method.info.summary,
        "device": method.why_not.is_none().then_some(&method.info.device),
        "runs": method.why_not.is_none(),
        "why_not": method.why_not,
        "options": options.collect::<Vec<Value>>(),
    })
}
