//! Reads the text of a project file for the window.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use guideway::layout::UserError;
use guideway_viewer::MAX_PROJECT_BYTES;

/// Reads a project file.
///
/// # Errors
/// When it cannot be read, is too long, or is no text.
pub(crate) fn read(path: &Path) -> Result<String, UserError> {
    read_text(path).map_err(|error| {
        UserError::new(
            "project",
            format!("cannot read the project: {error}"),
            "Choose a file that File > Save project wrote",
        )
    })
}

fn read_text(path: &Path) -> io::Result<String> {
    // Opening a pipe would wait for a writer.
    if !path.is_file() {
        return Err(io::Error::new(ErrorKind::NotFound, "there is no such file"));
    }
    let mut text = String::new();
    let file = File::open(path)?;
    let bytes = file.take(MAX_PROJECT_BYTES + 1).read_to_string(&mut text)?;
    if bytes as u64 > MAX_PROJECT_BYTES {
        let limit = format!("it is longer than {MAX_PROJECT_BYTES} bytes, which no project is");
        return Err(io::Error::new(ErrorKind::FileTooLarge, limit));
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn what_is_no_project_is_an_error_with_its_reason() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.guideway-project.toml");
        let said = |path: &Path| read(path).unwrap_err().message;
        assert!(said(&path).contains("no such file"));
        assert!(said(folder.path()).contains("no such file"), "a folder");
        fs::write(&path, b"\xff\xfe").unwrap();
        assert!(said(&path).contains("UTF-8"));
        fs::write(&path, vec![b' '; MAX_PROJECT_BYTES as usize + 1]).unwrap();
        assert!(said(&path).contains("1048576"));
        fs::write(&path, vec![b' '; MAX_PROJECT_BYTES as usize]).unwrap();
        assert_eq!(read(&path).unwrap().len() as u64, MAX_PROJECT_BYTES);
    }
}
