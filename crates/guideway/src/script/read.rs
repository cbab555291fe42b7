//! Reads a script: checks that each step is known and has no unknown members.

use std::io::Read;
use std::path::PathBuf;

use guideway_document::Document;
use guideway_layout::UserError;
use serde_json::{Map, Value};

use super::error::StepError;
use super::members::{Folder, Members};
use super::step::{StepKind, Touched};
use super::steps::STEPS;

/// A list of steps that edit a layout: see `docs/edit-script.md`.
pub struct Script {
    pub(super) steps: Vec<ScriptStep>,
    /// Folder of the script, from which it names other files.
    pub(super) folder: PathBuf,
}

/// One step of a script.
pub(super) struct ScriptStep {
    pub(super) name: String,
    kind: &'static StepKind,
    members: Map<String, Value>,
}

impl ScriptStep {
    /// Performs the step on a document.
    pub(super) fn perform(
        &self,
        document: &mut Document,
        folder: &Folder<'_>,
    ) -> Result<Touched, StepError> {
        let members = Members {
            members: &self.members,
            folder,
        };
        (self.kind.perform)(&members, document)
    }
}

impl Script {
    /// Reads and checks a script of at most `max_bytes` bytes. It names other files from `folder`.
    ///
    /// # Errors
    /// When the source cannot be read, or is no script: see [`Self::from_json`].
    pub fn read(
        source: impl Read,
        folder: impl Into<PathBuf>,
        max_bytes: u64,
    ) -> Result<Self, UserError> {
        let mut bytes = Vec::new();
        let mut source = source.take(max_bytes.saturating_add(1));
        source
            .read_to_end(&mut bytes)
            .map_err(|error| script_error(error.to_string(), "Name a JSON file with steps"))?;
        if bytes.len() as u64 > max_bytes {
            return Err(script_error(
                format!("the script has more than {max_bytes} bytes"),
                "Split it, or raise the limit with `--limit file-bytes=N`",
            ));
        }
        Self::from_json(&bytes, folder)
    }

    /// Checks a script: `{"steps": [{"do": "rename", "node": "N7", "to": "gate"}]}`. It names other
    /// files from `folder`.
    ///
    /// # Errors
    /// When the bytes are no JSON of this form, a step is unknown, or a member of a step is unknown
    /// or missing.
    pub fn from_json(bytes: &[u8], folder: impl Into<PathBuf>) -> Result<Self, UserError> {
        Ok(Self {
            steps: Self::steps(bytes)?,
            folder: folder.into(),
        })
    }

    fn steps(bytes: &[u8]) -> Result<Vec<ScriptStep>, UserError> {
        const FORM: &str = "Write {\"steps\": [{\"do\": \"rename\", ...}, ...]}; `guideway edit \
                            --help` lists the steps";
        let script: Value = serde_json::from_slice(bytes)
            .map_err(|error| script_error(format!("no JSON: {error}"), FORM))?;
        let Value::Object(mut script) = script else {
            return Err(script_error("the script is no object".into(), FORM));
        };
        let steps = script.remove("steps");
        if let Some(unknown) = script.keys().next() {
            let message = format!("unknown member `{unknown}`; a script has `steps`");
            return Err(script_error(message, FORM));
        }
        let Some(Value::Array(steps)) = steps else {
            return Err(script_error("`steps` is no list".into(), FORM));
        };
        let steps = steps.into_iter().zip(1..);
        steps
            .map(|(step, number)| Self::step(step, number))
            .collect()
    }

    fn step(step: Value, number: u32) -> Result<ScriptStep, UserError> {
        let Value::Object(mut members) = step else {
            let message = format!("step {number} is no object");
            return Err(script_error(
                message,
                "Write a step as {\"do\": \"rename\", ...}",
            ));
        };
        let known = || {
            STEPS
                .iter()
                .map(|kind| kind.name)
                .collect::<Vec<_>>()
                .join(", ")
        };
        let Some(Value::String(name)) = members.remove("do") else {
            let remedy = format!("Name the step, one of {}", known());
            return Err(script_error(
                format!("step {number} has no text `do`"),
                &remedy,
            ));
        };
        let Some(kind) = STEPS.iter().find(|kind| kind.name == name) else {
            let remedy = format!("Choose one of {}", known());
            return Err(script_error(
                format!("step {number}: unknown step `{name}`"),
                &remedy,
            ));
        };
        let is_known = |name: &&String| kind.members.iter().any(|member| member.name == **name);
        if let Some(unknown) = members.keys().find(|name| !is_known(name)) {
            let names: Vec<&str> = kind.members.iter().map(|member| member.name).collect();
            return Err(script_error(
                format!("step {number} (`{name}`): unknown member `{unknown}`"),
                &format!("The members of `{name}` are {}", names.join(", ")),
            ));
        }
        let missing = kind
            .members
            .iter()
            .find(|m| m.is_required && !members.contains_key(m.name));
        if let Some(missing) = missing {
            return Err(script_error(
                format!(
                    "step {number} (`{name}`) lacks the member `{}`",
                    missing.name
                ),
                &format!("Add it: {}", missing.meaning),
            ));
        }
        Ok(ScriptStep {
            name,
            kind,
            members,
        })
    }
}

/// An error of the script as a whole.
fn script_error(message: String, remedy: &str) -> UserError {
    UserError::new("edit-script", message, remedy)
}
