//! Compares the public interfaces of the crates with those of the last version, by
//! cargo-semver-checks.

use anyhow::{Result, bail};

use crate::prerequisites::SEMVER_CHECKS;
use crate::step::command;

/// Fails when a change is greater than the step from the last tag to the version of `Cargo.toml`.
pub(crate) fn check() -> Result<()> {
    compare(last_tag()?)
}

/// The same, but says so where git does not know the last tag, as in an unpacked archive.
pub(crate) fn check_if_known() -> Result<()> {
    match last_tag() {
        Ok(tag) => compare(tag),
        Err(unknown) => {
            println!("NOT CHECKED: {unknown:#}");
            Ok(())
        }
    }
}

/// The last tag before this commit, whose own is of the version that is about to be published.
fn last_tag() -> Result<Option<String>> {
    let tags = command("git")
        .args(["tag", "--list", "v[0-9]*", "--sort=-version:refname"])
        .args(["--merged", "HEAD^"])
        .capture()?;
    if !tags.succeeded {
        bail!(
            "git cannot list the tags before this commit: {}. In a shallow clone, run `git fetch \
             --unshallow --tags`",
            tags.stderr.trim()
        );
    }
    Ok(newest(&tags.stdout).map(str::to_owned))
}

fn compare(tag: Option<String>) -> Result<()> {
    let Some(tag) = tag else {
        println!("NOT CHECKED: no version was tagged before, so there is nothing to compare with");
        return Ok(());
    };
    println!("compared with {tag}");
    SEMVER_CHECKS.ensure()?;
    command(env!("CARGO"))
        .args(["semver-checks", "--workspace", "--baseline-rev", &tag])
        .run()
}

/// The first version of a list of tags.
fn newest(tags: &str) -> Option<&str> {
    tags.lines().map(str::trim).find(|tag| !tag.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_the_first_tag_and_none_of_an_empty_list() {
        assert_eq!(newest("v0.10.0\nv0.9.0\n"), Some("v0.10.0"));
        assert_eq!(newest("\n"), None);
    }
}
