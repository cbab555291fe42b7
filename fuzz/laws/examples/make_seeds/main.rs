//! Writes the seeds of `fuzz/seeds`, one archive per target: the made ones anew, and the kept ones
//! as they are.
//!
//! `-- keep TARGET FOLDER` adds files of a minimized corpus, of all sizes, up to a size in all.

mod attacks;
mod made;

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::Path;

use guideway_bad_files::Archive;
use guideway_laws::{TARGETS, archive_path};

/// Prefix of the names of kept files.
const KEPT: &str = "kept-";
/// Most bytes of the kept files of a target.
const MOST_KEPT_BYTES: usize = 16 << 10;
/// Most bytes of a kept file. Larger ones slow every run, and their parts are in smaller ones.
const LARGEST_KEPT_BYTES: usize = 2 << 10;

type Files = BTreeMap<String, Vec<u8>>;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    match args[..] {
        [] => {
            let mut made = made::files()?;
            for (target, name, bytes) in attacks::files() {
                made.entry(target).or_default().insert(name.into(), bytes);
            }
            for target in TARGETS {
                let files = made.remove(target.name).unwrap_or_default();
                let kept = stored(target.name)?.into_iter();
                let kept = kept.filter(|(name, _)| name.starts_with(KEPT));
                write(target.name, kept.chain(files).collect())?;
            }
            Ok(())
        }
        ["keep", target, folder] => keep(target, Path::new(folder)),
        _ => Err("usage: make_seeds [keep TARGET FOLDER]".into()),
    }
}

/// The files of an archive; empty if it does not exist.
fn stored(target: &str) -> Result<Files, Box<dyn Error>> {
    let path = archive_path(target);
    if !path.exists() {
        return Ok(Files::new());
    }
    let archive = Archive::read(&path)?;
    let files = archive.iter();
    Ok(files
        .map(|(name, bytes)| (name.to_owned(), bytes.to_vec()))
        .collect())
}

fn write(target: &str, files: Files) -> Result<(), Box<dyn Error>> {
    let comment = format!(
        "# Seeds of the fuzz target `{target}`. `make_seeds` made them, and took those named \
         {KEPT} \
         from\n# a minimized corpus.\n-- none --\n"
    );
    let mut archive = Archive::parse(&comment)?.emptied();
    for (name, bytes) in files {
        if !archive.insert(&name, bytes) {
            return Err(format!("{target}: {name} is no name of a file").into());
        }
    }
    if archive.iter().next().is_some() {
        fs::write(archive_path(target), archive.to_string())?;
    }
    Ok(())
}

fn keep(target: &str, folder: &Path) -> Result<(), Box<dyn Error>> {
    let known = TARGETS.iter().find(|known| known.name == target);
    let known = known.ok_or_else(|| format!("unknown target {target}"))?;
    let mut files = stored(target)?;
    let mut found: Vec<Vec<u8>> = Vec::new();
    for entry in fs::read_dir(folder)? {
        found.push(fs::read(entry?.path())?);
    }
    let seeds = known.seeds()?;
    found.retain(|bytes| seeds.iter().all(|(_, seed)| seed != bytes));
    found.retain(|bytes| !bytes.is_empty() && bytes.len() <= LARGEST_KEPT_BYTES);
    found.sort_by_key(|bytes| (bytes.len(), bytes.clone()));
    found.dedup();
    let kept = files.iter().filter(|(name, _)| name.starts_with(KEPT));
    let kept: Vec<&[u8]> = kept.map(|(_, bytes)| &bytes[..]).collect();
    let room = MOST_KEPT_BYTES.saturating_sub(kept.concat().len());
    let first = kept.len();
    // Every n-th, so that all sizes are kept.
    let total: usize = found.iter().map(Vec::len).sum();
    let every = total.div_ceil(room.max(1)).max(1);
    let mut left = room;
    for (i, bytes) in found.into_iter().step_by(every).enumerate() {
        let Some(rest) = left.checked_sub(bytes.len()) else {
            break;
        };
        left = rest;
        files.insert(format!("{KEPT}{:03}", first + i), bytes);
    }
    write(target, files)
}
