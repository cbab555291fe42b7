//! The example site is the output of its generator. The example repository: its site passes its own
//! checks, and git shows changes in words by the commands of its README.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::{command, stderr, stdout};

#[expect(dead_code, reason = "`main` is not called here")]
#[path = "../../examples/make_site/main.rs"]
mod make_site;

fn example() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/site-repository")
}

/// A copy of the repository in a folder.
fn copy(folder: &Path) -> PathBuf {
    let copy = folder.join("repository");
    fs::create_dir(&copy).unwrap();
    for name in ["site.lif.json", "guideway.toml", "README.md"] {
        fs::copy(example().join(name), copy.join(name)).unwrap();
    }
    copy
}

fn check(folder: &Path) -> Output {
    let mut check = command();
    check.current_dir(folder).args(["check", "site.lif.json"]);
    check.output().unwrap()
}

#[test]
fn site_passes_by_the_settings_of_its_repository() {
    let folder = tempfile::tempdir().unwrap();
    let repository = copy(folder.path());
    let output = check(&repository);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    assert!(
        stdout(&output).contains("guideway.toml"),
        "{}",
        stdout(&output)
    );
    // Faster bends break the rule of the file.
    let site = repository.join("site.lif.json");
    let text = fs::read_to_string(&site).unwrap();
    fs::write(
        &site,
        text.replace("\"maxSpeed\": 0.8", "\"maxSpeed\": 1.2"),
    )
    .unwrap();
    let output = check(&repository);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stdout(&output).contains("lateral-acceleration"),
        "{}",
        stdout(&output)
    );
    fs::remove_file(repository.join("guideway.toml")).unwrap();
    assert_eq!(check(&repository).status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn git_difftool_shows_the_change_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let repository = copy(folder.path());
    let program = Path::new(env!("CARGO_BIN_EXE_guideway")).parent().unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let path = format!("{}:{path}", program.display());
    // Settings of the user would change what git does.
    let shell = |script: &str| {
        let mut shell = Command::new("sh");
        shell
            .args(["-c", script])
            .current_dir(&repository)
            .env("PATH", &path);
        shell
            .env("GIT_CONFIG_GLOBAL", "/dev/null")
            .env("GIT_CONFIG_SYSTEM", "/dev/null");
        shell.output().unwrap()
    };
    if !shell("git --version").status.success() {
        println!("SKIPPED: there is no git");
        return;
    }
    let begin = "git init -q . && git config user.name n && git config user.email n@example.org \
                 && git add -A && git commit -q -m first";
    let begun = shell(begin);
    assert!(begun.status.success(), "{}", stderr(&begun));
    let site = repository.join("site.lif.json");
    let text = fs::read_to_string(&site).unwrap();
    fs::write(
        &site,
        text.replacen("\"maxSpeed\": 1.2", "\"maxSpeed\": 0.9", 1),
    )
    .unwrap();
    let second = shell("git commit -q -a -m second");
    assert!(second.status.success(), "{}", stderr(&second));
    let readme = fs::read_to_string(repository.join("README.md")).unwrap();
    let commands = readme
        .lines()
        .filter_map(|line| line.strip_prefix("    git "));
    let commands: Vec<String> = commands.map(|command| format!("git {command}")).collect();
    assert_eq!(commands.len(), 3, "{commands:?}");
    let shown = shell(&commands.join(" && "));
    assert!(shown.status.success(), "{}", stderr(&shown));
    let said = stdout(&shown);
    assert!(
        said.contains("dock--south-east") && said.contains("1.2 m/s -> 0.9 m/s"),
        "{said}"
    );
}

#[test]
fn committed_site_equals_generated_site() {
    let committed = include_str!("../../examples/site.lif.json");
    assert!(
        committed == make_site::site(),
        "run `cargo run --example make_site > crates/guideway/examples/site.lif.json`"
    );
}

#[test]
fn campus_repeats_the_site_with_distinct_names() {
    let read = |text: &str| {
        let options = guideway::formats::ReadOptions::default();
        guideway::formats::read_bytes("site.lif.json", text.as_bytes(), &options)
            .unwrap_or_else(|problem| panic!("{problem}"))
    };
    let (one, six) = (read(&make_site::site()), read(&make_site::campus(3, 2)));
    assert_eq!(six.paths.len(), 6 * one.paths.len());
    assert_eq!(six.nodes.len(), 6 * one.nodes.len());
    assert_eq!(six.stations.len(), 6 * one.stations.len());
    assert!(six.diagnostics.is_empty(), "all names are known and unique");
    let (small, large) = (
        one.paths.hull_bounds().unwrap(),
        six.paths.hull_bounds().unwrap(),
    );
    assert!(large.max.x - small.max.x == 300.0 && large.max.y - small.max.y == 95.0);
}
