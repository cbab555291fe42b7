//! Paths of files relative to a folder, with `/` between their parts on every system.

use std::path::{Component, Path, PathBuf};

/// A path without links, also of a file that does not exist in a folder that does.
pub(crate) fn resolved(path: &Path) -> PathBuf {
    let whole = path.canonicalize();
    let in_folder = || {
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
        Some(folder.join(path.file_name()?))
    };
    let resolved = whole.ok().or_else(in_folder);
    resolved.unwrap_or_else(|| std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
}

/// A resolved path as seen from a resolved folder: `a/b.json`, or `../a/b.json` outside of it.
pub(crate) fn relative(path: &Path, folder: &Path) -> String {
    let [own, base]: [Vec<Component<'_>>; 2] = [path, folder].map(|p| p.components().collect());
    let common = own.iter().zip(&base).take_while(|(a, b)| a == b).count();
    let up = base[common..].iter().map(|_| "..".into());
    let down = own[common..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy());
    up.chain(down).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_paths_lead_from_the_folder_to_the_file() {
        let seen = |path: &str, folder: &str| relative(Path::new(path), Path::new(folder));
        assert_eq!(seen("/site/a/b.json", "/site"), "a/b.json");
        assert_eq!(seen("/site/a/b.json", "/site/c/d"), "../../a/b.json");
        assert_eq!(seen("/b.json", "/"), "b.json");
    }
}
