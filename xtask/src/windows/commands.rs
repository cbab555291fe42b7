//! Runs the same commands here and under Wine, each in a folder of its own, and compares answers,
//! exit codes and files, byte by byte.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};
use xtask::files::files_below;

use super::build::FOLDER;
use super::wine::Wine;

/// Commands in order, one per line; `@long` is a folder with a path of 300 letters. Those after `=`
/// also give the same answer.
const CALLS: &str = "
    demo --output demo --paths 20k
  = info demo/site.lif.json
  = check demo/faulty.lif.json
  = check --format sarif demo/faulty.lif.json
    check demo/faulty.lif.json --picture faults.svg
    convert demo/site.lif.json site.arrow
    convert demo/site.lif.json site.dxf
    convert demo/site.lif.json site.geojson
    convert demo/site.lif.json site.lif2.json
    convert demo/site.lif.json site.nav2.geojson
    convert demo/site.lif.json site.nav_graph.yaml
    convert demo/site.lif.json site.opentcs.xml
    convert demo/site.lif.json --to opentcs6 site6.xml
    convert demo/site.lif.json site.svg
    convert site.arrow from-arrow.lif.json
    convert site.dxf from-dxf.geojson
    convert site.geojson from-geojson.lif.json
    convert site.lif2.json from-lif2.geojson
    convert site.nav2.geojson from-nav2.geojson
    convert site.nav_graph.yaml from-rmf.geojson
    convert site.opentcs.xml from-opentcs.geojson
    convert site.svg from-svg.geojson
    convert site.lif2.json from-svg.geojson
    convert demo/site.lif.json Übersicht-計画.arrow
    convert Übersicht-計画.arrow größe.dxf
    convert demo/site.lif.json @long/site.arrow
  = info @long/site.arrow
    render demo/site.lif.json -o plain.png --plain
    render demo/site.lif.json -o site.png --site --size 1600x900
    render demo/site.lif.json -o speed.png --color-by maxSpeed --legend
    render demo/site.lif.json -o plan.svg --site
    render demo/site.lif.json -o plan.pdf --site
    render site.arrow -o oracle.png --method oracle --size 240x160
  = render site.arrow -o - --quiet --size 320x200
    generate d1 --paths 10k -o d1.arrow
    generate d2 --paths 1k -o d2.arrow
    render d1.arrow -o d1.png --shade density
    tiles demo/site.lif.json -o site.pmtiles --zoom 0-2
    share demo/site.lif.json -o site.html --title Site
  = diff demo/site.lif.json demo/faulty.lif.json
    network site.dxf -o network.lif.json --split
  = route demo/site.lif.json dock-1 dock-3 --vehicle-type tugger-3000
  = schema check
  = completions powershell
    man manual
  = check nothing.json
  = info demo
  = render site.arrow -o picture.bmp
  = convert site.arrow missing/site.dxf
";

/// Result of a command: its exit code and, where it is compared, its answer.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Answer {
    code: Option<i32>,
    printed: Vec<u8>,
}

/// Runs all commands by both programs; fails with every difference.
pub(super) fn test(wine: &Wine, programs: &Path) -> Result<()> {
    let folder = std::env::current_dir()?.join(FOLDER).join("commands");
    let here = std::env::current_exe()?.with_file_name("guideway");
    let there = programs.join("guideway.exe");
    let native = run_all(&folder.join("here"), &|| Command::new(&here))?;
    let foreign = run_all(&folder.join("wine"), &|| wine.command(&there))?;
    let mut found = Vec::new();
    for ((call, native), (_, foreign)) in native.iter().zip(&foreign) {
        if native != foreign {
            found.push(format!("{call}\n  here: {native}\n  Wine: {foreign}"));
        }
    }
    let (native_files, foreign_files) = (
        read_below(&folder.join("here"))?,
        read_below(&folder.join("wine"))?,
    );
    found.extend(differences(&native_files, &foreign_files));
    if !found.is_empty() {
        bail!("{} differences:\n{}", found.len(), found.join("\n"));
    }
    println!(
        "{} commands and their {} files are the same",
        native.len(),
        native_files.len()
    );
    Ok(())
}

/// Runs all commands in a fresh folder.
fn run_all(folder: &Path, program: &dyn Fn() -> Command) -> Result<Vec<(String, Answer)>> {
    let long = ["l".repeat(100), "o".repeat(100), "n".repeat(100)].join("/");
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    fs::create_dir_all(folder.join(&long))?;
    let mut answers = Vec::new();
    for call in CALLS.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (is_compared, words) = match call.strip_prefix("= ") {
            Some(words) => (true, words),
            None => (false, call),
        };
        let words = words.split(' ').map(|word| word.replace("@long", &long));
        let output = program().args(words).current_dir(folder).output();
        let output = output.with_context(|| format!("cannot start guideway {call}"))?;
        let printed = match is_compared {
            true => without_times([output.stdout, output.stderr].concat()),
            false => Vec::new(),
        };
        let code = output.status.code();
        answers.push((call.to_owned(), Answer { code, printed }));
    }
    Ok(answers)
}

/// Drops lines that say how long a command took, and makes zeros of times such as
/// `2026-01-31T12:00:00.000Z`, which LIF has of its export.
fn without_times(mut bytes: Vec<u8>) -> Vec<u8> {
    const MARKS: [(usize, u8); 6] = [
        (4, b'-'),
        (7, b'-'),
        (10, b'T'),
        (13, b':'),
        (16, b':'),
        (23, b'Z'),
    ];
    let len = MARKS[MARKS.len() - 1].0 + 1;
    for at in 0..(bytes.len() + 1).saturating_sub(len) {
        if MARKS.iter().all(|&(index, mark)| bytes[at + index] == mark) {
            bytes[at..at + len].fill(b'0');
        }
    }
    let lines = bytes.split_inclusive(|byte| *byte == b'\n');
    let lines = lines.filter(|line| !line.starts_with(b"took "));
    lines.flatten().copied().collect()
}

/// The files below a folder by name.
fn read_below(folder: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let files = files_below(folder)?.into_iter();
    let read = files.map(|(name, path)| Ok((name, without_times(fs::read(path)?))));
    read.collect()
}

/// Names the files that one side lacks, and those with other bytes.
fn differences(
    native: &BTreeMap<String, Vec<u8>>,
    foreign: &BTreeMap<String, Vec<u8>>,
) -> Vec<String> {
    let mut found = Vec::new();
    for (name, bytes) in native {
        match foreign.get(name) {
            None => found.push(format!("{name}: not written under Wine")),
            Some(other) if other != bytes => {
                let at = bytes.iter().zip(other).position(|(a, b)| a != b);
                let at = at.unwrap_or_else(|| bytes.len().min(other.len()));
                found.push(format!("{name}: differs from byte {at} on"));
            }
            Some(_) => {}
        }
    }
    let only = foreign.keys().filter(|name| !native.contains_key(*name));
    found.extend(only.map(|name| format!("{name}: written under Wine alone")));
    found
}

impl std::fmt::Display for Answer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let printed = String::from_utf8_lossy(&self.printed);
        let start: String = printed.chars().take(2000).collect();
        write!(f, "{:?} {start}", self.code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_difference_of_files_is_named() {
        let files = |list: &[(&str, &str)]| -> BTreeMap<String, Vec<u8>> {
            let own = |(name, text): &(&str, &str)| ((*name).to_owned(), text.as_bytes().to_vec());
            list.iter().map(own).collect()
        };
        let native = files(&[("a", "same"), ("b", "text"), ("c", "long"), ("d", "")]);
        let foreign = files(&[("a", "same"), ("b", "test"), ("c", "longer"), ("e", "")]);
        let expected = [
            "b: differs from byte 2 on",
            "c: differs from byte 4 on",
            "d: not written under Wine",
            "e: written under Wine alone",
        ];
        assert_eq!(differences(&native, &foreign), expected);
        assert!(differences(&native, &native).is_empty());
    }

    #[test]
    fn times_do_not_count_but_everything_else() {
        let without = |text: &str| String::from_utf8(without_times(text.into())).unwrap();
        let export = "{\"at\":\"2026-01-31T12:00:00.000Z\"}";
        assert_eq!(
            without(export),
            export.replace("2026-01-31T12:00:00.000Z", &"0".repeat(24))
        );
        assert_eq!(without("took 3 ms\nit took 3 ms\n"), "it took 3 ms\n");
        assert_eq!(without("2026-01-31"), "2026-01-31");
    }

    #[test]
    fn another_answer_is_another_result() {
        let folder = tempfile::tempdir().unwrap();
        let answers = |program: &'static str| {
            run_all(folder.path(), &|| {
                let mut command = Command::new("sh");
                command.args(["-c", program]);
                command
            })
            .unwrap()
        };
        let same = answers("echo answer");
        assert_eq!(same, answers("echo answer"));
        assert_ne!(same, answers("echo other"));
        assert_ne!(same, answers("echo answer; exit 2"));
    }
}
