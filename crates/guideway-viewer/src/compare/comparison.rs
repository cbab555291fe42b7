//! The comparison in progress and its result.

use std::path::PathBuf;

use guideway_document::Document;

use super::changed::Changed;
use crate::background::{LatestTask, RepaintHandle};
use crate::files::{Layer, OpenFiles};

/// The subject of a result: the two files, and the states of their documents.
#[derive(Clone, Debug, PartialEq)]
struct CompareKey {
    files: [PathBuf; 2],
    states: [u64; 2],
}

/// The other file, and the changes from it to the active one.
#[derive(Default)]
pub(crate) struct Comparison {
    /// The file that the active one is compared with.
    pub(crate) with: Option<PathBuf>,
    latest: LatestTask<CompareKey, Result<Changed, String>>,
}

impl Comparison {
    /// The other file of the comparison, with its index: the chosen one, else the only other one.
    pub(crate) fn other<'f>(&self, files: &'f OpenFiles) -> Option<(usize, &'f Layer)> {
        let all = files.layers().iter().enumerate();
        let mut others = all.filter(|(index, _)| *index != files.active_index());
        match &self.with {
            Some(path) => others.find(|(_, layer)| layer.is_at(path)),
            None => others.next().filter(|_| files.layers().len() == 2),
        }
    }

    pub(crate) fn is_busy(&self) -> bool {
        self.latest.is_busy()
    }

    /// The changes of the two files; those before the last edit while they are compared again.
    pub(crate) fn changed(&self, files: &OpenFiles) -> Option<Result<&Changed, &str>> {
        let (key, changed) = self.latest.result()?;
        let (_, other) = self.other(files)?;
        let is_present = other.is_at(&key.files[0]) && files.active()?.is_at(&key.files[1]);
        is_present.then(|| changed.as_ref().map_err(String::as_str))
    }

    /// Compares again after a change; takes a finished result.
    pub(crate) fn update(&mut self, files: &OpenFiles, repaint: &RepaintHandle) {
        self.latest.take_finished(|error| Err(error.to_string()));
        let (Some((_, other)), Some(active)) = (self.other(files), files.active()) else {
            return;
        };
        let (Some(old), Some(new)) = (other.document(), active.document()) else {
            return;
        };
        let key = CompareKey {
            files: [other.path().to_owned(), active.path().to_owned()],
            states: [old, new].map(Document::state),
        };
        if !self.latest.is_due(&key) {
            return;
        }
        let (old, new) = (old.snapshot(), new.snapshot());
        let compare = move || Ok(Changed::of(&old, &new));
        self.latest.start(key, repaint, compare);
    }
}
