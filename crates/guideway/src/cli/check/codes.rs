//! Codes of findings by name, and severities, in arguments and settings.

use clap::ValueEnum;
use guideway::layout::{Code, Severity, near_names};
use serde::{Deserialize, Deserializer, de};

/// Parses the code of a finding.
pub(super) fn code(text: &str) -> Result<Code, String> {
    Code::named(text).ok_or_else(|| {
        let near = near_names(text, Code::ALL.iter().map(|code| code.name()));
        let near = match near.is_empty() {
            true => String::new(),
            false => format!(", the nearest is {}", near.join(", then ")),
        };
        format!("no finding has the code `{text}`{near}; docs/diagnostics.md lists all")
    })
}

/// A code in a file of settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CodeName(pub(super) Code);

impl<'de> Deserialize<'de> for CodeName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        code(&text).map(Self).map_err(de::Error::custom)
    }
}

/// The least severity of a finding that the command does not pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum FailOn {
    /// Errors only
    Error,
    /// Errors and warnings
    Warning,
    /// Any finding
    Info,
}

impl FailOn {
    pub(super) fn severity(self) -> Severity {
        match self {
            Self::Error => Severity::Error,
            Self::Warning => Severity::Warning,
            Self::Info => Severity::Info,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_codes_name_the_nearest_one() {
        assert_eq!(code("node-gap"), Ok(Code::NodeGap));
        let error = code("dead-ends").unwrap_err();
        assert!(
            error.contains("`dead-ends`, the nearest is dead-end;"),
            "{error}"
        );
        assert!(!code("qqq").unwrap_err().contains("nearest"));
    }
}
