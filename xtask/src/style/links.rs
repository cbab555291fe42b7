//! Links of Markdown files to files of the repository.

use std::path::Path;

use super::violation::Violation;

/// Finds relative links of a Markdown file at `name` whose target does not exist below `top`.
pub fn check_links(top: &Path, name: &str, text: &str) -> Vec<Violation> {
    let folder = top.join(name);
    let folder = folder.parent().unwrap_or(top);
    let mut found = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        for target in targets(line) {
            let file = target.split('#').next().unwrap_or("");
            if !file.is_empty() && !file.contains(':') && !folder.join(file).exists() {
                found.push(Violation {
                    file: name.to_owned(),
                    line: number,
                    message: format!("link to `{file}`, which does not exist"),
                });
            }
        }
    }
    found
}

/// The targets of the links in a line: `[text](target)`.
fn targets(line: &str) -> impl Iterator<Item = &str> {
    line.split("](")
        .skip(1)
        .filter_map(|rest| rest.split(')').next())
}
