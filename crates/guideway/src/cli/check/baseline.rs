//! Baselines: the findings that a file of a repository is known to have. Only new ones count.

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::{Path, PathBuf};

use guideway::layout::{Diagnostics, UserError, shown_path};
use serde::{Deserialize, Serialize};

use super::fingerprint::fingerprint;
use crate::cli::error::unreadable;
use crate::cli::input::{relative, resolved};
use crate::cli::output::{REPORT_VERSION, save_report};

/// Name of the report in a baseline.
const REPORT: &str = "baseline";

/// Findings of one kind that are kept to compare them; further ones only count.
pub(super) const FINDINGS_PER_KIND: usize = 100_000;

/// The findings of a baseline.
pub(super) struct Baseline {
    folder: PathBuf,
    /// Entries per file.
    files: HashMap<String, Vec<Entry>>,
}

/// Findings with the same fingerprint in one file.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Entry {
    file: String,
    pub(super) code: String,
    pub(super) place: String,
    fingerprint: String,
    pub(super) count: u64,
}

#[derive(Deserialize, Serialize)]
struct Body {
    findings: Vec<Entry>,
}

#[derive(Deserialize)]
struct Whole {
    guideway: Header,
    #[serde(flatten)]
    body: Body,
}

#[derive(Deserialize)]
struct Header {
    report: String,
    version: u32,
}

impl Baseline {
    /// Reads a file of [`write`].
    ///
    /// # Errors
    /// When the file cannot be read, or is no baseline.
    pub(super) fn read(path: &Path) -> Result<Self, UserError> {
        let fail = |detail: String| {
            let message = format!("{}: {detail}", shown_path(path));
            let remedy = "Name a file that `guideway check --write-baseline` wrote";
            UserError::new("baseline", message, remedy)
        };
        let bytes = fs::read(path).map_err(|error| fail(unreadable(&error)))?;
        let whole: Whole = serde_json::from_slice(&bytes)
            .map_err(|error| fail(format!("this is no baseline: {error}")))?;
        let Header { report, version } = whole.guideway;
        if report != REPORT || version != REPORT_VERSION {
            let found = format!("this is the report `{report}` of version {version}");
            return Err(fail(format!("{found}, not a baseline of {REPORT_VERSION}")));
        }
        let mut files: HashMap<String, Vec<Entry>> = HashMap::new();
        for entry in whole.body.findings {
            files.entry(entry.file.clone()).or_default().push(entry);
        }
        Ok(Self {
            folder: folder_of(path),
            files,
        })
    }

    /// Removes the known findings of a file. Returns their number, and what is gone.
    pub(super) fn remove_known(&self, file: &Path, found: &mut Diagnostics) -> (u64, Vec<Entry>) {
        let entries = self.files.get(&relative(&resolved(file), &self.folder));
        let entries = entries.map_or(&[][..], Vec::as_slice);
        let mut left: HashMap<&str, u64> = HashMap::new();
        for entry in entries {
            *left.entry(entry.fingerprint.as_str()).or_default() += entry.count;
        }
        let mut known = 0;
        found.retain(
            |_, _| true,
            |finding| match left.get_mut(fingerprint(finding).as_str()) {
                Some(count) if *count > 0 => {
                    *count -= 1;
                    known += 1;
                    false
                }
                _ => true,
            },
        );
        let gone = entries.iter().filter_map(|entry| {
            let count = left
                .remove(entry.fingerprint.as_str())
                .filter(|count| *count > 0)?;
            Some(Entry {
                count,
                ..entry.clone()
            })
        });
        (known, gone.collect())
    }
}

/// The findings of a file, for a baseline at a path.
///
/// # Errors
/// When there are more of a kind than are kept.
pub(super) fn entries(
    path: &Path,
    file: &Path,
    found: &Diagnostics,
) -> Result<Vec<Entry>, UserError> {
    let listed = found.iter().count() as u64;
    let all: u64 = found.counts().map(|(_, count)| count).sum();
    if all > listed {
        return Err(UserError::new(
            "baseline",
            format!(
                "{}: more than {FINDINGS_PER_KIND} findings of one kind",
                shown_path(file)
            ),
            "Mend them first, or leave the kind out by --ignore",
        ));
    }
    let name = relative(&resolved(file), &folder_of(path));
    let mut entries: BTreeMap<(String, String), Entry> = BTreeMap::new();
    for finding in found.iter() {
        let fingerprint = fingerprint(finding);
        let code = finding.code.name().to_owned();
        let entry = entries.entry((code.clone(), fingerprint.clone()));
        let entry = entry.or_insert_with(|| Entry {
            file: name.clone(),
            code,
            place: finding.place.element.clone(),
            fingerprint,
            count: 0,
        });
        entry.count += 1;
    }
    Ok(entries.into_values().collect())
}

/// Writes a baseline, in an order that does not depend on that of the files.
pub(super) fn write(path: &Path, mut findings: Vec<Entry>) -> Result<(), UserError> {
    findings.sort_by(|a, b| {
        let key = |entry: &Entry| {
            let Entry {
                file, code, place, ..
            } = entry.clone();
            (file, code, place, entry.fingerprint.clone())
        };
        key(a).cmp(&key(b))
    });
    save_report(path, REPORT, REPORT_VERSION, &Body { findings })
}

fn folder_of(path: &Path) -> PathBuf {
    let whole = resolved(path);
    whole.parent().unwrap_or(Path::new("/")).to_owned()
}
