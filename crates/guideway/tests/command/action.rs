//! The steps of `action.yml`, run as the forge runs them, over a repository with a changed layout.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use super::support::{names_in, stderr, stdout};

/// The script of a step.
fn script(step: &str) -> String {
    let action = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../action.yml");
    let action = fs::read_to_string(action).unwrap();
    let (_, rest) = action.split_once(&format!("- name: {step}\n")).unwrap();
    let (_, rest) = rest.split_once("run: |\n").unwrap();
    let lines = rest.lines().take_while(|line| line.starts_with("        "));
    let script = lines.map(|line| &line[8..]).collect::<Vec<_>>().join("\n");
    assert!(!script.is_empty(), "{step}");
    script
}

/// A repository in which one of two layouts has changed, without a commit of that.
struct Repository {
    folder: PathBuf,
}

impl Repository {
    fn new(folder: &Path) -> Self {
        let folder = folder.join("repository");
        fs::create_dir_all(folder.join("halls/a")).unwrap();
        let site = super::support::site();
        for hall in ["halls/a/site.lif.json", "halls/b.lif.json"] {
            fs::copy(&site, folder.join(hall)).unwrap();
        }
        let repository = Self { folder };
        let commit = "git init -q . && git config user.name n && git config user.email n@e.org \
                      && git add -A && git commit -q -m first && git remote add origin .";
        let begun = repository.bash(commit, &[]);
        assert!(begun.status.success(), "{}", stderr(&begun));
        let changed = repository.folder.join("halls/a/site.lif.json");
        let text = fs::read_to_string(&changed).unwrap();
        let text = text.replacen("\"maxSpeed\":0.8", "\"maxSpeed\":800.0", 1);
        fs::write(&changed, text).unwrap();
        repository
    }

    /// Runs a script as a step of an action does.
    fn bash(&self, script: &str, env: &[(&str, &str)]) -> Output {
        let program = Path::new(env!("CARGO_BIN_EXE_guideway")).parent().unwrap();
        let path = std::env::var("PATH").unwrap_or_default();
        let mut bash = Command::new("bash");
        bash.args(["--noprofile", "--norc", "-eo", "pipefail", "-c", script])
            .current_dir(&self.folder)
            .env("PATH", format!("{}:{path}", program.display()))
            .env("GIT_CONFIG_GLOBAL", "/dev/null")
            .env("GIT_CONFIG_SYSTEM", "/dev/null")
            .env("GITHUB_OUTPUT", "output.txt")
            .env("GITHUB_STEP_SUMMARY", "summary.md")
            .envs(env.iter().copied());
        bash.output().unwrap()
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.folder.join(name)).unwrap()
    }
}

#[test]
fn action_reports_findings_and_draws_what_changed() {
    if Command::new("git").arg("--version").output().is_err() {
        println!("SKIPPED: there is no git");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let repository = Repository::new(folder.path());
    let files = ("FILES", "halls/**/*.lif.json");
    let check = script("Check");
    let passed = repository.bash(&check, &[files, ("FAIL_ON", "error")]);
    assert!(passed.status.success(), "{}", stderr(&passed));
    assert_eq!(repository.text("output.txt"), "status=0\n");
    let sarif = repository.text("guideway.sarif");
    assert!(sarif.contains("implausible") && sarif.contains("halls/a/site.lif.json"));

    // The last step fails with the status of the check.
    let found = repository.bash(&check, &[files, ("FAIL_ON", "warning")]);
    assert!(found.status.success(), "{}", stderr(&found));
    assert!(repository.text("output.txt").ends_with("status=1\n"));
    fs::remove_file(repository.folder.join("guideway.sarif")).unwrap();
    let wrong = repository.bash(&check, &[files, ("FAIL_ON", "never")]);
    assert!(
        !wrong.status.success(),
        "a check that did not run fails its step"
    );

    let draw = script("Draw the differences");
    let drawn = repository.bash(&draw, &[files, ("BASE", "HEAD")]);
    assert!(drawn.status.success(), "{}", stderr(&drawn));
    let summary = repository.text("summary.md");
    assert!(summary.contains("### halls/a/site.lif.json"), "{summary}");
    assert!(summary.contains("maxSpeed"), "{summary}");
    assert!(!summary.contains("halls/b"), "{summary}");
    let pictures = names_in(&repository.folder.join("guideway-diff"));
    assert_eq!(
        pictures,
        ["halls-a-site.lif.json.png"],
        "{}",
        stdout(&drawn)
    );
    assert_comments(&repository);
}

/// Comments twice, by a program in the place of the forge's: the second time changes the comment of
/// the first.
fn assert_comments(repository: &Repository) {
    let program = "#!/bin/sh\n\
        case \"$*\" in\n\
        *--paginate*) cat id.txt 2> /dev/null ;;\n\
        *) echo \"$*\" >> calls.txt; echo 7 > id.txt; exit \"${REFUSED:-0}\" ;;\n\
        esac\n";
    let comment = "mkdir -p bin && printf '%s' \"$PROGRAM\" > bin/gh && chmod +x bin/gh\n\
                   PATH=\"$PWD/bin:$PATH\"\n";
    let comment = comment.to_owned() + &script("Comment on the differences");
    let env = [
        ("PROGRAM", program),
        ("GITHUB_REPOSITORY", "o/r"),
        ("NUMBER", "3"),
        ("PICTURES", "https://example.org/7"),
    ];
    for _ in 0..2 {
        let said = repository.bash(&comment, &env);
        assert!(said.status.success(), "{}", stderr(&said));
        assert!(!stdout(&said).contains("::warning::"));
    }
    let body = "-F body=@guideway-comment.md";
    let calls = format!(
        "api --silent --method POST repos/o/r/issues/3/comments {body}\n\
         api --silent --method PATCH repos/o/r/issues/comments/7 {body}\n"
    );
    assert_eq!(repository.text("calls.txt"), calls);
    let text = repository.text("guideway-comment.md");
    assert!(text.starts_with("<!-- guideway -->\n[Pictures"), "{text}");
    assert!(
        text.contains("https://example.org/7") && text.contains("maxSpeed"),
        "{text}"
    );

    let refused = repository.bash(&comment, &[&env[..], &[("REFUSED", "1")]].concat());
    assert!(refused.status.success() && stdout(&refused).contains("::warning::"));
}
