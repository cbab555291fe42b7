//! Runs the commands of README.md and docs/first-hour.md as printed, in a folder of their own, and
//! compares what docs/first-hour.md shows with what they print. Those of other pages run on files
//! with the names that they have.
//!
//! `GUIDEWAY_SLOW_COMMANDS=1` runs those, too, that take minutes without optimization.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::{stderr, stdout};

/// Begins of commands that need a window, install something or measure for minutes.
const NEVER: [&str; 5] = [
    "cargo ",
    "guideway view",
    "guideway bench",
    "guideway reproduce",
    "guideway man",
];
/// Parts of commands on a million paths.
const SLOW: [&str; 2] = ["1M", "million"];

/// A command with the lines that it is to print.
struct Step {
    command: String,
    printed: Vec<String>,
}

fn page(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    fs::read_to_string(root.join(name)).expect("a page of this repository")
}

/// The lines of the blocks of a language.
fn lines<'t>(page: &'t str, language: &str) -> Vec<&'t str> {
    let (mut found, mut is_in) = (Vec::new(), false);
    for line in page.lines() {
        match line.strip_prefix("```") {
            Some(named) => is_in = !is_in && named == language,
            None if is_in => found.push(line),
            None => {}
        }
    }
    found
}

/// The commands of a page, `$ ` before each, with the output below it.
fn session(page: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for line in lines(page, "console") {
        match (line.strip_prefix("$ "), steps.last_mut()) {
            (Some(command), _) => steps.push(Step {
                command: command.to_owned(),
                printed: Vec::new(),
            }),
            (None, Some(step)) => step.printed.push(line.to_owned()),
            (None, None) => panic!("output before a command: {line}"),
        }
    }
    steps
}

/// Runs a command by the shell, with this program in its path, `None` if it is left out. `cd`
/// changes the folder of the commands to come.
fn run(command: &str, folder: &mut PathBuf) -> Option<Output> {
    if let Some(name) = command.strip_prefix("cd ") {
        folder.push(name);
        return None;
    }
    let output = run_in(command, folder)?;
    // 1 says that `check` or `diff` found something.
    let is_done = output.status.code().is_some_and(|code| code < 2);
    assert!(is_done, "{command}: {}", stderr(&output));
    Some(output)
}

/// Runs a command in a folder, however it ends.
fn run_in(command: &str, folder: &Path) -> Option<Output> {
    let is_slow = SLOW.iter().any(|part| command.contains(part));
    let runs_slow = std::env::var_os("GUIDEWAY_SLOW_COMMANDS").is_some();
    if NEVER.iter().any(|begin| command.starts_with(begin)) || (is_slow && !runs_slow) {
        return None;
    }
    let program = Path::new(env!("CARGO_BIN_EXE_guideway"));
    let programs = program.parent().expect("a folder").to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(programs).chain(std::env::split_paths(&path));
    let output = Command::new("sh")
        .args(["-c", command])
        .current_dir(folder)
        .env("PATH", std::env::join_paths(all).expect("paths"))
        .output();
    Some(output.expect("a shell"))
}

/// Returns `true` if a text is as printed; `...` stands for anything within a line, and on a line
/// of its own for any lines.
fn is_as_printed(printed: &[String], said: &[&str]) -> bool {
    let Some((first, others)) = printed.split_first() else {
        return said.is_empty();
    };
    if first.trim() == "..." {
        return (0..=said.len()).any(|skipped| is_as_printed(others, &said[skipped..]));
    }
    let Some((line, rest)) = said.split_first() else {
        return false;
    };
    let mut left = *line;
    let parts: Vec<&str> = first.trim_end().split("...").collect();
    for (i, part) in parts.iter().enumerate() {
        match left.find(part) {
            Some(at) if i > 0 || at == 0 => left = &left[at + part.len()..],
            _ => return false,
        }
    }
    (left.trim().is_empty() || parts.last() == Some(&"")) && is_as_printed(others, rest)
}

#[cfg(unix)]
#[test]
fn commands_of_the_readme_run_as_printed() {
    let folder = tempfile::tempdir().unwrap();
    let mut at = folder.path().to_owned();
    let readme = page("README.md");
    let (mut done, mut guideways) = (0, 0);
    for line in lines(&readme, "sh") {
        let command = line.split("  #").next().unwrap_or_default().trim();
        guideways += usize::from(command.starts_with("guideway "));
        // The demo without its million paths.
        let command = match command {
            "guideway demo" => "guideway demo --paths 1k",
            command => command,
        };
        done += usize::from(run(command, &mut at).is_some());
    }
    assert!(done >= 8 && guideways >= 12, "{done} of {guideways}");
}

#[cfg(unix)]
#[test]
fn the_first_hour_prints_what_it_shows() {
    let folder = tempfile::tempdir().unwrap();
    let mut at = folder.path().to_owned();
    let steps = session(&page("docs/first-hour.md"));
    assert!(steps.len() >= 8, "{}", steps.len());
    for Step { command, printed } in &steps {
        let command = match command.as_str() {
            "guideway demo" => "guideway demo --paths 1k",
            command => command,
        };
        let Some(output) = run(command, &mut at) else {
            continue;
        };
        let said = stdout(&output) + &stderr(&output);
        let lines: Vec<&str> = said.lines().collect();
        assert!(
            is_as_printed(printed, &lines),
            "$ {command}\n{said}\nis not\n{}",
            printed.join("\n")
        );
    }
}

/// Pages with commands, indented, and least number of these.
const PAGES: [(&str, usize); 4] = [
    ("docs/command-line.md", 18),
    ("docs/network.md", 1),
    ("docs/guide.md", 1),
    ("examples/site-repository/README.md", 5),
];
/// Names that these commands give to a site.
const SITES: [&str; 7] = ["site", "hall", "annex", "old", "new", "fleet-a", "fleet-b"];

/// The commands of a page, without what the shell does with their output, and without the list of
/// all commands, which has placeholders.
fn indented(page: &str) -> impl Iterator<Item = &str> {
    let commands = page.lines().filter_map(|line| line.strip_prefix("    "));
    let commands = commands.filter(|line| line.starts_with("guideway ") && !line.contains("   "));
    commands.filter_map(|line| line.split([';', '|', '>']).next())
}

#[cfg(unix)]
#[test]
fn commands_of_the_pages_have_arguments_that_the_command_knows() {
    let folder = tempfile::tempdir().unwrap();
    let mut at = folder.path().to_owned();
    let site = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/site.lif.json");
    for name in SITES {
        fs::copy(&site, at.join(format!("{name}.lif.json"))).unwrap();
    }
    for drawing in ["plan.dxf", "annex.dxf"] {
        let convert = format!("guideway convert site.lif.json {drawing}");
        run(&convert, &mut at).unwrap();
    }
    for (name, least) in PAGES {
        let text = page(name);
        let commands: Vec<&str> = indented(&text).collect();
        assert!(commands.len() >= least, "{} in {name}", commands.len());
        for command in commands {
            if let Some(output) = run_in(command, &at) {
                assert!(
                    !is_of_arguments(&output),
                    "{name}: {command}: {}",
                    stderr(&output)
                );
            }
        }
    }
    let wrong = run_in("guideway info --no-such site.lif.json", &at).unwrap();
    assert!(is_of_arguments(&wrong));
}

/// Returns `true` if a command ended for its arguments.
fn is_of_arguments(output: &Output) -> bool {
    stderr(output).contains("try '--help'")
}

#[test]
fn other_output_is_not_as_printed() {
    let printed = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let is = |a: &str, b: &str| is_as_printed(&printed(a), &b.lines().collect::<Vec<_>>());
    assert!(is("a\n...\nd 1...", "a\nb\nc\nd 12 s"));
    assert!(is("took ... ms", "took 12 ms"));
    for (a, b) in [
        ("a", "b"),
        ("a", "a\nb"),
        ("a\nb", "a"),
        ("x ... y", "x 1 z"),
        ("a", "ab"),
    ] {
        assert!(!is(a, b), "{a} {b}");
    }
}
