//! The files of an installation below a folder: `bin` and `share`.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};

use super::Binaries;

/// Files that shells read for completion: the shell, and the name below `share`.
const COMPLETIONS: [(&str, &str); 3] = [
    ("bash", "bash-completion/completions/guideway"),
    ("zsh", "zsh/vendor-completions/_guideway"),
    ("fish", "fish/vendor_completions.d/guideway.fish"),
];

/// Files of `packaging/`, and their names below `share`.
const DESKTOP: [(&str, &str); 3] = [
    ("guideway.desktop", "applications/guideway.desktop"),
    ("guideway-mime.xml", "mime/packages/guideway.xml"),
    ("guideway.svg", "icons/hicolor/scalable/apps/guideway.svg"),
];

/// Writes the files of an installation below `prefix`, which is `/usr` or `~/.local` later.
/// `notices` are the licenses of the dependencies.
///
/// # Errors
/// When a file cannot be written, or a program does not run.
pub fn stage(top: &Path, binaries: &Binaries, notices: &str, prefix: &Path) -> Result<()> {
    stage_command(top, &binaries.command, notices, prefix)?;
    copy_program(&binaries.window, prefix)?;
    for (file, name) in DESKTOP {
        save(
            &prefix.join("share").join(name),
            &fs::read(top.join("packaging").join(file))?,
        )?;
    }
    Ok(())
}

/// Writes the files of an installation without the window; see [`stage`].
///
/// # Errors
/// When a file cannot be written, or the command does not run.
pub fn stage_command(top: &Path, command: &Path, notices: &str, prefix: &Path) -> Result<()> {
    copy_program(command, prefix)?;
    let share = prefix.join("share");
    let run = |args: &[&str]| {
        let output = Command::new(command).args(args).output()?;
        if !output.status.success() {
            bail!(
                "guideway {args:?}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
        }
        Ok(output.stdout)
    };
    let man = share.join("man/man1");
    fs::create_dir_all(&man)?;
    run(&["man", "--quiet", &man.to_string_lossy()])?;
    for page in fs::read_dir(&man)? {
        gzip(&page?.path())?;
    }
    for (shell, name) in COMPLETIONS {
        save(&share.join(name), &run(&["completions", shell])?)?;
    }
    stage_notices(top, notices, &share.join("doc/guideway"))
}

fn copy_program(program: &Path, prefix: &Path) -> Result<()> {
    let bin = prefix.join("bin");
    fs::create_dir_all(&bin)?;
    let name = program.file_name().context("a program has a name")?;
    fs::copy(program, bin.join(name))
        .with_context(|| format!("{}: build it first", program.display()))?;
    Ok(())
}

/// Writes licenses and changes to the folder of a package's documentation.
///
/// # Errors
/// When a file cannot be read or written.
pub fn stage_notices(top: &Path, notices: &str, doc: &Path) -> Result<()> {
    save(&doc.join("copyright"), copyright(top)?.as_bytes())?;
    for (name, text) in [
        ("changelog", fs::read(top.join("CHANGELOG.md"))?),
        ("THIRD-PARTY", notices.as_bytes().to_vec()),
    ] {
        let file = doc.join(name);
        save(&file, &text)?;
        gzip(&file)?;
    }
    Ok(())
}

/// Both licenses of Guideway, of which the user chooses one.
fn copyright(top: &Path) -> Result<String> {
    let mut text = "Guideway is licensed under either of the following licenses, at your option.\n\
                    THIRD-PARTY.gz beside this file has those of its dependencies.\n"
        .to_owned();
    for name in ["LICENSE-MIT", "LICENSE-APACHE"] {
        text += &format!("\n{:=<72}\n", "");
        text += &fs::read_to_string(top.join(name))?;
    }
    Ok(text)
}

fn save(file: &Path, bytes: &[u8]) -> Result<()> {
    let folder = file.parent().context("a file is in a folder")?;
    fs::create_dir_all(folder)?;
    fs::write(file, bytes).with_context(|| format!("{}", file.display()))
}

/// Compresses a file without its name and time, so that equal files stay equal.
fn gzip(file: &Path) -> Result<()> {
    let done = Command::new("gzip").arg("-9n").arg(file).status()?;
    if !done.success() {
        bail!("gzip {}: {done}", file.display());
    }
    Ok(())
}
