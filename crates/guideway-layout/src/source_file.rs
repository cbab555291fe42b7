//! [`SourceFile`]: the file of a layout whose text is too large to keep in memory.

use std::fs::{File, Metadata};
use std::io::{self, Read, Seek};
use std::sync::Arc;
use std::time::SystemTime;

/// An open file whose text is read again when it is wanted. It stays readable after another file
/// took its name.
#[derive(Clone, Debug)]
pub struct SourceFile {
    file: Arc<File>,
    state: FileState,
}

/// State of a file by which a change is detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FileState {
    bytes: u64,
    modified: Option<SystemTime>,
}

impl SourceFile {
    /// Remembers the present state of a file.
    ///
    /// # Errors
    /// When the operating system does not report the state.
    pub fn new(file: File) -> io::Result<Self> {
        let state = FileState::of(&file.metadata()?);
        let file = Arc::new(file);
        Ok(Self { file, state })
    }

    /// The whole text; `None` if the file changed since, cannot be read or is not UTF-8.
    pub fn read(&self) -> Option<String> {
        let mut file = &*self.file;
        let capacity = usize::try_from(self.state.bytes).ok()?;
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(capacity).ok()?;
        file.rewind().ok()?;
        file.take(self.state.bytes).read_to_end(&mut bytes).ok()?;
        let is_same = FileState::of(&file.metadata().ok()?) == self.state;
        let text = String::from_utf8(bytes).ok()?;
        (is_same && text.len() == capacity).then_some(text)
    }
}

impl PartialEq for SourceFile {
    fn eq(&self, other: &Self) -> bool {
        self.state == other.state
    }
}

impl FileState {
    fn of(metadata: &Metadata) -> Self {
        Self {
            bytes: metadata.len(),
            modified: metadata.modified().ok(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn text_is_read_until_the_file_changes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site");
        fs::write(&path, "one").unwrap();
        let source = SourceFile::new(File::open(&path).unwrap()).unwrap();
        for _ in 0..2 {
            assert_eq!(source.read().as_deref(), Some("one"));
        }
        // Another file of that name is not the source.
        let other = folder.path().join("other");
        fs::write(&other, "other").unwrap();
        fs::rename(&other, &path).unwrap();
        assert_eq!(source.read().as_deref(), Some("one"));
        let source = SourceFile::new(File::open(&path).unwrap()).unwrap();
        for text in ["others", "oth", "\u{FEFF}xx"] {
            fs::write(&path, text).unwrap();
            let later = SystemTime::now() + std::time::Duration::from_secs(9);
            let written = File::options().write(true).open(&path).unwrap();
            written.set_modified(later).unwrap();
            assert_eq!(source.read(), None, "{text}");
        }
    }
}
