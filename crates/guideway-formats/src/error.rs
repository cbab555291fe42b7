use std::fmt;
use std::io;

use guideway_layout::Place;

/// Why a file could not be read: which file, where in it, what is wrong, and what to do about it.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {problem}. {}", .problem.remedy())]
pub struct ReadError {
    /// The file, or another name for the source, as given.
    pub file: String,
    /// What is wrong.
    pub problem: Problem,
}

impl ReadError {
    /// An error of the named file.
    pub fn new(file: impl Into<String>, problem: Problem) -> Self {
        Self {
            file: file.into(),
            problem,
        }
    }

    /// The stable name of the kind of problem, for programs.
    pub fn code(&self) -> &'static str {
        self.problem.code()
    }

    /// What to do about it.
    pub fn remedy(&self) -> String {
        self.problem.remedy()
    }
}

/// What is wrong with a file that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// There is no such file.
    #[error("there is no file of this name")]
    NotFound,
    /// It is something else than a file.
    #[error("this is a {0}, not a file")]
    NotAFile(&'static str),
    /// The operating system refused.
    #[error("cannot read the file: {0}")]
    Io(#[from] io::Error),
    /// There is nothing in it.
    #[error("the file is empty")]
    Empty,
    /// The bytes are of no known format.
    #[error("the format is not known; the file begins with {first_bytes}")]
    UnknownFormat {
        /// The first bytes, made readable.
        first_bytes: String,
    },
    /// The bytes end before the content does.
    #[error("the file ends too early, after {at} bytes: {detail}")]
    Truncated {
        /// Number of bytes there are.
        at: u64,
        /// What is missing.
        detail: String,
    },
    /// The bytes break the rules of JSON, XML or Arrow.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line, from 1.
        line: u64,
        /// Column, from 1.
        column: u64,
        /// Which rule.
        message: String,
    },
    /// The bytes contradict themselves.
    #[error("{place}: the file is damaged: {detail}")]
    Damaged {
        /// Where.
        place: Place,
        /// What does not fit.
        detail: String,
    },
    /// Nested too deeply.
    #[error("line {line}, column {column}: nested more than {limit} levels deep")]
    TooDeep {
        /// Deepest nesting that is accepted.
        limit: u64,
        /// Line, from 1.
        line: u64,
        /// Column, from 1.
        column: u64,
    },
    /// More of something than is accepted.
    #[error("{what}: {actual} found, {limit} at most")]
    LimitReached {
        /// What there is too much of, such as `bytes in the file`.
        what: &'static str,
        /// How much is accepted.
        limit: u64,
        /// How much there is, as far as it was counted.
        actual: u64,
    },
    /// The text is not UTF-8.
    #[error("the text is not UTF-8 at byte {at}: {detail}")]
    NotUtf8 {
        /// Position in the file, from 0.
        at: u64,
        /// What it is instead, as far as that can be told.
        detail: &'static str,
    },
    /// Sound text, but not what the format asks for.
    #[error("{place}: expected {expected}, found {found}")]
    Structure {
        /// Where.
        place: Place,
        /// What the format asks for.
        expected: String,
        /// What is there.
        found: String,
    },
    /// Legal in the format, and not supported here.
    #[error("{place}: {what} is not supported")]
    Unsupported {
        /// Where.
        place: Place,
        /// What is not supported.
        what: String,
        /// What to do instead.
        remedy: String,
    },
    /// The caller asked to stop.
    #[error("reading was stopped before it was done")]
    Cancelled,
}

impl Problem {
    /// The stable name of the kind of problem, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotFound => "not-found",
            Self::NotAFile(_) => "not-a-file",
            Self::Io(_) => "io",
            Self::Empty => "empty",
            Self::UnknownFormat { .. } => "unknown-format",
            Self::Truncated { .. } => "truncated",
            Self::Syntax { .. } => "syntax",
            Self::Damaged { .. } => "damaged",
            Self::TooDeep { .. } => "too-deep",
            Self::LimitReached { .. } => "limit",
            Self::NotUtf8 { .. } => "not-utf8",
            Self::Structure { .. } => "structure",
            Self::Unsupported { .. } => "unsupported",
            Self::Cancelled => "cancelled",
        }
    }

    /// What to do about it.
    pub fn remedy(&self) -> String {
        match self {
            Self::NotFound => "Check the spelling and the folder".into(),
            Self::NotAFile(_) => {
                "Give the name of a layout file; a stream has to be written to a file first".into()
            }
            Self::Io(_) => "Check that you may read the file and that its disk is there".into(),
            Self::Empty => "Export the layout again; the last export wrote nothing".into(),
            Self::UnknownFormat { .. } => format!("Guideway reads {FormatList}"),
            Self::Truncated { .. } | Self::Damaged { .. } => {
                "Copy or export the file again; the last copy is not whole".into()
            }
            Self::Syntax { .. } => {
                "Correct the file at that place, or export it again from the tool that wrote it"
                    .into()
            }
            Self::TooDeep { .. } => {
                "No layout needs such nesting: check what wrote the file, or raise the limit `depth`"
                    .into()
            }
            Self::LimitReached { .. } => {
                "If the file is meant to be so large, raise the limit; else check what wrote it"
                    .into()
            }
            Self::NotUtf8 { .. } => "Save the file as UTF-8".into(),
            Self::Structure { .. } => {
                format!("Check that this is a layout file; Guideway reads {FormatList}")
            }
            Self::Unsupported { remedy, .. } => remedy.clone(),
            Self::Cancelled => "Read the file again to have all of it".into(),
        }
    }
}

struct FormatList;

impl fmt::Display for FormatList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, format) in crate::Format::ALL.iter().enumerate() {
            f.write_str(if i == 0 { "" } else { ", " })?;
            f.write_str(format.description())?;
        }
        Ok(())
    }
}
