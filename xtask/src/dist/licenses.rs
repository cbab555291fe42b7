//! The license texts of all crates in the programs, each text once.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use super::Dependency;

/// Begins of the names of files with licenses and notices, in lower case.
const NAMES: [&str; 6] = [
    "license",
    "licence",
    "copying",
    "notice",
    "copyright",
    "unlicense",
];
/// Longest text: a file beyond is no license.
const MAX_BYTES: u64 = 200_000;

/// A file for people: every crate with its license and origin, then the texts with the crates that
/// have them. A crate without a text has its license expression alone.
///
/// # Errors
/// When the folder of a crate cannot be read.
pub fn notices(dependencies: &[Dependency]) -> Result<String> {
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut list = String::new();
    for krate in dependencies.iter().filter(|krate| !krate.is_own()) {
        let Dependency {
            name,
            version,
            license,
            repository,
            ..
        } = krate;
        list += &format!("{name} {version}: {license} {repository}\n");
        for text in texts_in(&krate.folder)? {
            let users = texts.entry(text).or_default();
            users.push(format!("{name} {version}"));
        }
    }
    let mut all = format!("Crates in these programs\n========================\n\n{list}");
    for (text, users) in texts {
        let users = users.join(", ");
        all += &format!("\n{:=<72}\nThe following text is part of: {users}\n\n", "");
        all += text.trim_end();
        all.push('\n');
    }
    Ok(all)
}

/// The texts of a crate, in the order of their names, without spaces at the ends of lines.
fn texts_in(folder: &Path) -> Result<Vec<String>> {
    let entries = fs::read_dir(folder).with_context(|| format!("{}", folder.display()))?;
    let mut files = Vec::new();
    for entry in entries {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().to_lowercase();
        let is_license = NAMES.iter().any(|begin| name.starts_with(begin));
        let about = entry.metadata()?;
        if is_license && about.is_file() && about.len() <= MAX_BYTES {
            files.push(entry.path());
        }
    }
    files.sort();
    let mut texts = Vec::new();
    for file in files {
        let text = String::from_utf8_lossy(&fs::read(&file)?).into_owned();
        let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
        texts.push(lines.join("\n"));
    }
    Ok(texts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_of_several_crates_appears_once() {
        let folder = tempfile::tempdir().unwrap();
        let krate = |name: &str, text: Option<&str>| {
            let folder = folder.path().join(name);
            fs::create_dir(&folder).unwrap();
            fs::write(folder.join("lib.rs"), "code").unwrap();
            if let Some(text) = text {
                fs::write(folder.join("LICENSE-MIT"), text).unwrap();
            }
            Dependency {
                name: name.to_owned(),
                version: "1.0.0".to_owned(),
                license: "MIT".to_owned(),
                repository: "https://example.org".to_owned(),
                folder,
                checksum: Some("00".to_owned()),
                links: Vec::new(),
            }
        };
        let own = Dependency {
            checksum: None,
            ..krate("own", Some("ours"))
        };
        let all = [
            krate("a", Some("Text \r\nof a")),
            krate("b", Some("Text\nof a")),
            own,
        ];
        let said = notices(&all).unwrap();
        assert_eq!(said.matches("Text\nof a\n").count(), 1);
        assert!(said.contains("part of: a 1.0.0, b 1.0.0"), "{said}");
        assert!(!said.contains("ours") && !said.contains("code"), "{said}");
        let without = notices(&[krate("c", None)]).unwrap();
        assert!(without.contains("c 1.0.0: MIT https://example.org"));
    }
}
