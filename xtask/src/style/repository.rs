//! Applies all rules to the files of a repository.

use std::path::Path;
use std::process::Command;

use super::links::check_links;
use super::rules::check_file;
use super::violation::Violation;

/// Checks every file of the repository at `top` that git tracks or could track.
///
/// # Errors
/// When git cannot list the files.
pub fn check_repository(top: &Path) -> std::io::Result<Vec<Violation>> {
    let listed = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(top)
        .output()?;
    if !listed.status.success() {
        let reason = String::from_utf8_lossy(&listed.stderr).trim().to_owned();
        return Err(std::io::Error::other(format!("git ls-files: {reason}")));
    }
    let names = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut violations = Vec::new();
    for name in names.lines() {
        if let Ok(text) = std::fs::read_to_string(top.join(name)) {
            violations.extend(check_file(name, &text));
            if name.ends_with(".md") {
                violations.extend(check_links(top, name, &text));
            }
        }
    }
    Ok(violations)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_outside_any_repository_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(check_repository(folder.path()).is_err());
    }
}
