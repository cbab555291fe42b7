use std::path::Path;

use guideway::formats::ReadError;
use guideway::render::RenderError;
use guideway::scene::SceneError;
use guideway::{MethodError, SaveError};

/// Why a command did not work: for people the message and what to do, for programs the code.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    /// Stable name of the kind of failure.
    pub(crate) code: &'static str,
    /// What went wrong.
    pub(crate) message: String,
    /// What to do about it.
    pub(crate) remedy: String,
}

impl Failure {
    /// Arguments that make no sense together.
    pub(crate) fn arguments(message: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            code: "usage",
            message: message.into(),
            remedy: remedy.into(),
        }
    }

    /// What the argument parser refused, in one line.
    pub(crate) fn usage(error: &clap::Error) -> Self {
        let text = error.to_string();
        let message = text.strip_prefix("error: ").unwrap_or(&text);
        let first = message.split("\n\n").next().unwrap_or(message);
        let words: Vec<&str> = first.split_whitespace().collect();
        Self::arguments(words.join(" "), "See `guideway --help`")
    }

    /// Output that would destroy its input.
    pub(crate) fn same_file(path: &Path) -> Self {
        Self {
            code: "same-file",
            message: format!(
                "{}: the output would replace the file that is read",
                path.display()
            ),
            remedy: "Give the output another name".into(),
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self {
            code: error.code(),
            message: format!("{}: {}", error.file, error.problem),
            remedy: error.remedy(),
        }
    }
}

impl From<SaveError> for Failure {
    fn from(error: SaveError) -> Self {
        Self {
            code: "save",
            remedy: error.remedy().into(),
            message: error.to_string(),
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let (code, what) = match &error {
            SceneError::UnknownLevel { .. } => ("unknown-level", "level"),
            SceneError::UnknownColumn { .. } => ("unknown-column", "column"),
        };
        Self {
            code,
            message: error.to_string(),
            remedy: format!("Name a {what} that there is; `guideway info FILE` shows them"),
        }
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        let (code, remedy) = match &error {
            RenderError::FrameSize { .. } => ("size", "Ask for a smaller picture with --size"),
            RenderError::Strips { .. } => (
                "size",
                "Draw it by `--method cpu`, which has no such limit, or ask for a smaller one with --size",
            ),
            RenderError::View { .. } => {
                ("view", "Leave --center and --scale out to see everything")
            }
            RenderError::Budget { .. } => (
                "memory",
                "Allow more with --memory, or ask for a smaller picture with --size",
            ),
            RenderError::Unsupported { remedy, .. } => ("unsupported", remedy.as_str()),
            RenderError::Device { .. } => (
                "device",
                "`--method cpu` needs no graphics device; `guideway methods` shows what there is",
            ),
            RenderError::Edit(_) => (
                "edit",
                "`guideway check` names the paths that lie too far out to be moved",
            ),
            RenderError::Cancelled => ("cancelled", "Run the command again"),
        };
        Self {
            code,
            message: error.to_string(),
            remedy: remedy.into(),
        }
    }
}

impl From<MethodError> for Failure {
    fn from(error: MethodError) -> Self {
        let code = match &error {
            MethodError::Unknown { .. } => "unknown-method",
            MethodError::Option { .. } => "method-option",
            MethodError::Unavailable { .. } => "method-unavailable",
        };
        Self {
            code,
            message: error.to_string(),
            remedy: "`guideway methods` shows what runs here; `--method auto` chooses for you"
                .into(),
        }
    }
}
