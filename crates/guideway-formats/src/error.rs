//! Read errors: the file, the place, the problem and its remedy, with a stable code per kind.

use std::fmt;
use std::io;

use guideway_layout::{Place, TextPosition, shown_text};

use crate::Format;

/// Place of a problem that concerns the file as a whole.
const WHOLE_FILE: &str = "the file";

/// Reason why a file cannot be read: the file, the place, the problem and its remedy.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}. {}", shown_text(file), .problem.remedy())]
pub struct ReadError {
    /// Name of the file or source, as given.
    pub file: String,
    /// The problem.
    pub problem: Problem,
}

impl ReadError {
    /// Makes an error of the named file.
    pub fn new(file: impl Into<String>, problem: Problem) -> Self {
        Self {
            file: file.into(),
            problem,
        }
    }

    /// Returns the stable code of the kind of problem, for programs.
    pub fn code(&self) -> &'static str {
        self.problem.code()
    }

    /// Returns the remedy, a sentence for the user.
    pub fn remedy(&self) -> String {
        self.problem.remedy()
    }
}

/// Problem of a file that cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file does not exist.
    #[error("the file does not exist")]
    NotFound,
    /// The name is that of a folder, pipe, socket or device.
    #[error("this is a {0}, not a file")]
    NotAFile(&'static str),
    /// The operating system reported an error.
    #[error("cannot read the file: {0}")]
    Io(#[from] io::Error),
    /// The file has no bytes.
    #[error("the file is empty")]
    Empty,
    /// The bytes match no known format.
    #[error("unknown file format; the file begins with {first_bytes}")]
    UnknownFormat {
        /// The first bytes: quoted text, or hexadecimal.
        first_bytes: String,
    },
    /// The caller does not want files of this format.
    #[error("this is a file of {}, a format that is shut off", .0.name())]
    FormatOff(Format),
    /// The file ends before its content is complete.
    #[error("the file is incomplete, it ends after {at} bytes: {detail}")]
    Truncated {
        /// Size of the file in bytes.
        at: u64,
        /// Description of the missing part.
        detail: String,
    },
    /// The text violates the syntax of JSON, XML or YAML.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line, from 1.
        line: u64,
        /// Column, from 1.
        column: u64,
        /// Violated rule.
        message: String,
    },
    /// The file contradicts itself.
    #[error("{place}: the file is damaged: {detail}")]
    Damaged {
        /// Place of the contradiction.
        place: Place,
        /// Description of the contradiction.
        detail: String,
    },
    /// The nesting exceeds the limit.
    #[error("line {line}, column {column}: nesting exceeds the limit of {limit} levels")]
    TooDeep {
        /// Largest accepted depth.
        limit: u64,
        /// Line, from 1.
        line: u64,
        /// Column, from 1.
        column: u64,
    },
    /// A size exceeds its limit.
    #[error("{what}: {actual}, above the limit of {limit}")]
    LimitReached {
        /// The measured size, such as `bytes in the file`.
        what: &'static str,
        /// Largest accepted value.
        limit: u64,
        /// Actual value, as far as it was counted.
        actual: u64,
    },
    /// The text is not UTF-8.
    #[error("the text is not UTF-8 at byte {at}: {detail}")]
    NotUtf8 {
        /// Position in the file, from 0.
        at: u64,
        /// Description of the bytes.
        detail: &'static str,
    },
    /// The text is not in the encoding that it declares.
    #[error("the text is not {encoding} at byte {at}, as the file declares")]
    WrongEncoding {
        /// Name of the declared encoding.
        encoding: &'static str,
        /// Position in the file, from 0.
        at: u64,
    },
    /// The syntax is valid, the structure is not that of the format.
    #[error("{place}: expected {expected}, found {found}")]
    Structure {
        /// Place of the element.
        place: Place,
        /// Structure that the format requires.
        expected: String,
        /// Structure of the file.
        found: String,
    },
    /// The format allows it, but this reader does not support it.
    #[error("{place}: {what} is not supported")]
    Unsupported {
        /// Place of the element.
        place: Place,
        /// Unsupported feature.
        what: String,
        /// Remedy for the user.
        remedy: String,
    },
    /// The file is a floor plan, not a layout.
    #[error("this is a ROS map, an image of the floor: it has no paths")]
    FloorPlan,
    /// A floor plan has a missing, unknown or wrong value.
    #[error("{place}: {detail}")]
    InvalidValue {
        /// Place of the value.
        place: Place,
        /// Description of the problem, with the value and its limits.
        detail: String,
        /// Remedy for the user.
        remedy: String,
    },
    /// The caller cancelled the read.
    #[error("the read was cancelled")]
    Cancelled,
}

impl Problem {
    /// Returns the place of the problem in the file: the whole file, where it is nowhere else.
    pub fn place(&self) -> Place {
        match self {
            Self::Syntax { line, column, .. } | Self::TooDeep { line, column, .. } => {
                let [line, column] = [line, column].map(|n| u32::try_from(*n).unwrap_or(u32::MAX));
                Place::element(WHOLE_FILE).at(TextPosition { line, column })
            }
            Self::Damaged { place, .. }
            | Self::Structure { place, .. }
            | Self::Unsupported { place, .. }
            | Self::InvalidValue { place, .. } => place.clone(),
            _ => Place::element(WHOLE_FILE),
        }
    }

    /// Returns the stable code of the kind of problem, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotFound => "not-found",
            Self::NotAFile(_) => "not-a-file",
            Self::Io(_) => "io",
            Self::Empty => "empty",
            Self::UnknownFormat { .. } => "unknown-format",
            Self::FormatOff(_) => "format-off",
            Self::Truncated { .. } => "truncated",
            Self::Syntax { .. } => "syntax",
            Self::Damaged { .. } => "damaged",
            Self::TooDeep { .. } => "too-deep",
            Self::LimitReached { .. } => "limit",
            Self::NotUtf8 { .. } => "not-utf8",
            Self::WrongEncoding { .. } => "wrong-encoding",
            Self::Structure { .. } => "structure",
            Self::Unsupported { .. } => "unsupported",
            Self::FloorPlan => "floor-plan",
            Self::InvalidValue { .. } => "invalid-value",
            Self::Cancelled => "cancelled",
        }
    }

    /// Returns the remedy, a sentence for the user.
    pub fn remedy(&self) -> String {
        match self {
            Self::NotFound => "Check the spelling and the folder".into(),
            Self::NotAFile(_) => {
                "Give the name of a layout file; write a stream to a file first".into()
            }
            Self::Io(_) => "Check the permissions of the file, and that its disk is mounted".into(),
            Self::Empty => "Export the layout again; this export is empty".into(),
            Self::UnknownFormat { .. } => format!("Guideway reads {FormatList}"),
            Self::FormatOff(_) => "Add the format to `--formats` if you trust the file".into(),
            Self::Truncated { .. } | Self::Damaged { .. } => {
                "Copy or export the file again; this copy is damaged or incomplete".into()
            }
            Self::Syntax { .. } => {
                "Correct the file at this place, or export it again from its source application"
                    .into()
            }
            Self::TooDeep { .. } => {
                "Check the application that wrote the file, or raise the limit with `--limit \
                 depth=N`"
                    .into()
            }
            Self::LimitReached { what, .. } => match limit_option(what) {
                Some(option) => format!(
                    "Raise the limit with `--limit {option}=N` if this size is intended; else \
                     check the application that wrote the file"
                ),
                None => "Check the application that wrote the file, or split it into several \
                         files"
                    .into(),
            },
            Self::NotUtf8 { .. } | Self::WrongEncoding { .. } => "Save the file as UTF-8".into(),
            Self::Structure { .. } => {
                format!("Check that this is a layout file; Guideway reads {FormatList}")
            }
            Self::Unsupported { remedy, .. } | Self::InvalidValue { remedy, .. } => remedy.clone(),
            Self::FloorPlan => {
                "Show it below a layout with `--floor-plan`, such as `guideway render \
                 site.lif.json -o site.png --floor-plan map.yaml`; in the window press Ctrl+L"
                    .into()
            }
            Self::Cancelled => "Read the file again to load the complete layout".into(),
        }
    }
}

/// The things that [`Problem::LimitReached`] counts, and the option of the command that sets the
/// limit of each. Others have a limit that cannot be set.
pub const LIMIT_OPTIONS: &[(&str, &str)] = &[
    ("bytes in the file", "file-bytes"),
    ("bytes in one text", "text-bytes"),
    ("control points", "control-points"),
    ("control points or knots of one curve", "curve-points"),
    ("elements in the file", "elements"),
    ("elements of one kind", "elements"),
    ("paths", "paths"),
    ("rows in the table", "paths"),
];

fn limit_option(what: &str) -> Option<&'static str> {
    let found = LIMIT_OPTIONS.iter().find(|(counted, _)| *counted == what);
    found.map(|(_, option)| *option)
}

struct FormatList;

impl fmt::Display for FormatList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, format) in Format::ALL.iter().enumerate() {
            f.write_str(if i == 0 { "" } else { ", " })?;
            f.write_str(format.description())?;
        }
        Ok(())
    }
}
