//! Parses and prints an archive of small files: readable text, an entry per file, diffable by line.
//!
//! ```text
//! # Comments, up to the first entry.
//! -- broken.json --
//! {"layouts": [
//! -- no-final-newline.json (escaped) --
//! {"layouts": [\
//! -- magic-only.arrow (base64) --
//! QVJST1cxAAA=
//! ```
//!
//! The lines below `-- NAME --` are the bytes of the file. An entry is `(escaped)` when its file
//! has bytes that are no plain text, a line that reads as an entry, or no newline at its end; see
//! [`crate::escape`]. A binary file is `(base64)`, each line on its own.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::path::Path;
use std::{fs, io};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use crate::escape::{EscapeError, escape, is_plain, unescape};

/// Marks the first line of an entry, and ends it.
const START: &str = "-- ";
const END: &str = " --";
const ESCAPED: &str = " (escaped)";
const BASE64: &str = " (base64)";
/// Bytes per line of base64: 76 columns.
const LINE_BYTES: usize = 57;
/// Bytes that no text has in a row, in any encoding.
const BINARY: [u8; 4] = [0; 4];

/// Named files, sorted by name, and the comment above them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Archive {
    comment: String,
    files: BTreeMap<String, Vec<u8>>,
}

/// Reason why a text is no archive. Lines count from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ArchiveError {
    /// The text does not end with a newline, so its end may be lost.
    #[error("no newline at the end: the archive may be truncated")]
    Truncated,
    /// The archive has no entry.
    #[error("the archive has no entry `-- NAME --`")]
    Empty,
    /// A line above the first entry is no comment.
    #[error("line {line}: expected a comment `# ...` or an entry `-- NAME --`")]
    Comment {
        /// Line of the archive.
        line: usize,
    },
    /// A line begins as an entry does, but is none.
    #[error(
        "line {line}: expected `-- NAME --`, `-- NAME (escaped) --` or `-- NAME (base64) --`, a \
         name of letters, digits and `-._`; in the lines of a file, mark the entry (escaped) and \
         write `\\x2d- `"
    )]
    Header {
        /// Line of the archive.
        line: usize,
    },
    /// Two entries have the same name.
    #[error("line {line}: a second entry `{name}`")]
    Duplicate {
        /// Line of the archive.
        line: usize,
        /// Name of the file.
        name: String,
    },
    /// A line of an entry has characters that an editor or git may change.
    #[error(
        "line {line}: `{name}` has control characters; mark the entry (escaped) and write `\\xHH`"
    )]
    NotPlain {
        /// Line of the archive.
        line: usize,
        /// Name of the file.
        name: String,
    },
    /// An escaped line has an invalid escape.
    #[error("line {line}: `{name}`: {error}")]
    Escape {
        /// Line of the archive.
        line: usize,
        /// Name of the file.
        name: String,
        /// Reason.
        error: EscapeError,
    },
    /// A line of base64 has other characters, or the wrong length.
    #[error("line {line}: `{name}`: {error}")]
    Base64 {
        /// Line of the archive.
        line: usize,
        /// Name of the file.
        name: String,
        /// Reason.
        error: base64::DecodeError,
    },
}

impl Archive {
    /// Reads an archive from a file.
    ///
    /// # Errors
    /// When it cannot be read or is malformed; the message names its path and line.
    pub fn read(path: &Path) -> io::Result<Self> {
        let name = |kind, error: &dyn std::error::Error| {
            io::Error::new(kind, format!("{}: {error}", path.display()))
        };
        let text = fs::read_to_string(path).map_err(|e| name(e.kind(), &e))?;
        Self::parse(&text).map_err(|e| name(io::ErrorKind::InvalidData, &e))
    }

    /// Parses the text of an archive.
    ///
    /// # Errors
    /// When the text is malformed in any way: nothing is skipped or repaired.
    pub fn parse(text: &str) -> Result<Self, ArchiveError> {
        if !text.is_empty() && !text.ends_with('\n') {
            return Err(ArchiveError::Truncated);
        }
        let mut archive = Self::default();
        let mut entry: Option<Entry<'_>> = None;
        for (line, content) in (1..).zip(text.split_inclusive('\n')) {
            if content.starts_with(START) {
                let next = Entry::parse(content).ok_or(ArchiveError::Header { line })?;
                if archive.files.contains_key(next.name) {
                    let name = next.name.to_owned();
                    return Err(ArchiveError::Duplicate { line, name });
                }
                archive.files.insert(next.name.to_owned(), Vec::new());
                entry = Some(next);
            } else if let Some(entry) = &entry {
                let bytes = entry.decode(content, line)?;
                archive.add_bytes(entry.name, bytes);
            } else if content.starts_with('#') {
                archive.comment.push_str(content);
            } else {
                return Err(ArchiveError::Comment { line });
            }
        }
        if archive.files.is_empty() {
            return Err(ArchiveError::Empty);
        }
        Ok(archive)
    }

    fn add_bytes(&mut self, name: &str, bytes: Vec<u8>) {
        if let Some(file) = self.files.get_mut(name) {
            file.extend(bytes);
        }
    }

    /// Adds a file. Returns whether the name is free and has only letters, digits and `-._`.
    #[must_use]
    pub fn insert(&mut self, name: &str, bytes: Vec<u8>) -> bool {
        let is_free = is_name(name) && !self.files.contains_key(name);
        if is_free {
            self.files.insert(name.to_owned(), bytes);
        }
        is_free
    }

    /// An archive with the same comment and no files.
    #[must_use]
    pub fn emptied(&self) -> Self {
        Self {
            comment: self.comment.clone(),
            files: BTreeMap::new(),
        }
    }

    /// The bytes of a file, if the archive has it.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.get(name).map(Vec::as_slice)
    }

    /// Names and bytes of all files, sorted by name.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[u8])> {
        let files = self.files.iter();
        files.map(|(name, bytes)| (name.as_str(), bytes.as_slice()))
    }
}

/// Prints the text that [`Archive::parse`] reads.
impl Display for Archive {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.comment)?;
        for (name, bytes) in self.iter() {
            match str::from_utf8(bytes) {
                Ok(text) if is_whole(text) => write!(f, "{START}{name}{END}\n{text}")?,
                _ if bytes.windows(BINARY.len()).any(|part| part == BINARY) => {
                    writeln!(f, "{START}{name}{BASE64}{END}")?;
                    for line in bytes.chunks(LINE_BYTES) {
                        writeln!(f, "{}", BASE64_STANDARD.encode(line))?;
                    }
                }
                _ => write!(f, "{START}{name}{ESCAPED}{END}\n{}", escape(bytes))?,
            }
        }
        Ok(())
    }
}

/// Returns `true` if a text needs no escapes.
fn is_whole(text: &str) -> bool {
    let is_closed = text.is_empty() || text.ends_with('\n');
    let is_header = |line: &str| line.starts_with(START);
    is_closed && is_plain(text) && !text.lines().any(is_header)
}

fn is_name(name: &str) -> bool {
    let is_allowed = |b: u8| b.is_ascii_alphanumeric() || b"-._".contains(&b);
    name.starts_with(|c: char| c.is_ascii_alphanumeric()) && name.bytes().all(is_allowed)
}

/// The first line of an entry.
struct Entry<'a> {
    name: &'a str,
    encoding: Encoding,
}

#[derive(Clone, Copy)]
enum Encoding {
    Plain,
    Escaped,
    Base64,
}

impl<'a> Entry<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let middle = line.strip_suffix('\n')?.strip_prefix(START)?;
        let middle = middle.strip_suffix(END)?;
        let encodings = [(ESCAPED, Encoding::Escaped), (BASE64, Encoding::Base64)];
        let mut encoded = encodings.into_iter();
        let encoded = encoded.find_map(|(mark, is)| Some((middle.strip_suffix(mark)?, is)));
        let (name, encoding) = encoded.unwrap_or((middle, Encoding::Plain));
        is_name(name).then_some(Self { name, encoding })
    }

    /// The bytes of a line of the entry.
    fn decode(&self, content: &str, line: usize) -> Result<Vec<u8>, ArchiveError> {
        let name = || self.name.to_owned();
        if !is_plain(content) {
            return Err(ArchiveError::NotPlain { line, name: name() });
        }
        match self.encoding {
            Encoding::Plain => Ok(content.into()),
            Encoding::Escaped => unescape(content).map_err(|error| {
                let name = name();
                ArchiveError::Escape { line, name, error }
            }),
            Encoding::Base64 => BASE64_STANDARD.decode(content.trim_end()).map_err(|error| {
                let name = name();
                ArchiveError::Base64 { line, name, error }
            }),
        }
    }
}
