//! `guideway methods`: the render methods, their options, and whether they run on this computer.

use guideway::layout::UserError;
use guideway::{AUTO, Available, MethodOption};
use serde_json::{Value, json};

use super::error::Exit;
use super::output::Output;

/// Width of the column of names: the longest name of a method.
const NAME_WIDTH: usize = 20;

pub(crate) fn run(out: &Output) -> Result<Exit, UserError> {
    let all = guideway::methods();
    let auto = all.iter().find(|m| m.unavailable.is_none());
    let body = json!({
        "auto": auto.map(|m| m.info.name),
        "methods": all.iter().map(method_json).collect::<Vec<Value>>(),
    });
    out.report("methods", &body, || {
        let mut text = String::new();
        if let Some(method) = auto {
            text += &format!("{AUTO:<NAME_WIDTH$} selects `{}` here\n", method.info.name);
        }
        for method in &all {
            let Available {
                info,
                options,
                unavailable,
            } = method;
            text += &format!("{:<NAME_WIDTH$} {}\n", info.name, info.summary);
            text += &match unavailable {
                None => format!("{:<NAME_WIDTH$} runs on {}\n", "", info.device),
                Some(reason) => format!("{:<NAME_WIDTH$} does not run here: {reason}\n", ""),
            };
            for MethodOption { name, summary } in *options {
                text += &format!("{:<NAME_WIDTH$}   +{name:<16} {summary}\n", "");
            }
        }
        text
    })?;
    Ok(Exit::Clean)
}

fn method_json(method: &Available) -> Value {
    let options = method.options.iter();
    let options = options.map(|o| json!({ "name": o.name, "summary": o.summary }));
    json!({
        "name": method.info.name,
        "summary": method.info.summary,
        "device": method.unavailable.is_none().then_some(&method.info.device),
        "runs": method.unavailable.is_none(),
        "why_not": method.unavailable,
        "options": options.collect::<Vec<Value>>(),
    })
}
