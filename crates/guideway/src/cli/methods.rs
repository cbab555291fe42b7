use guideway::{AUTO, Available};
use serde_json::{Value, json};

use super::{Exit, Failure, Output};

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
            text += &format!("{AUTO:<12} chooses `{}` here\n", method.info.name);
        }
        for Available { info, why_not } in &all {
            text += &format!("{:<12} {}\n", info.name, info.summary);
            text += &match why_not {
                None => format!("{:<12} runs on {}\n", "", info.device),
                Some(why) => format!("{:<12} does not run here: {why}\n", ""),
            };
        }
        text
    })?;
    Ok(Exit::Clean)
}

fn json_of(method: &Available) -> Value {
    json!({
        "name": method.info.name,
        "summary": method.info.summary,
        "device": method.why_not.is_none().then_some(&method.info.device),
        "runs": method.why_not.is_none(),
        "why_not": method.why_not,
    })
}
