//! [`Diagnostic`]: a finding about a layout, and [`Diagnostics`], a bounded list of them.

use std::collections::BTreeMap;

use crate::{Code, Limits, Place, RefusedPath, Severity};

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Kind of the finding.
    pub code: Code,
    /// Severity in this case; mostly [`Code::severity`].
    pub severity: Severity,
    /// Position in the source.
    pub place: Place,
    /// Description of the finding, with the values.
    pub message: String,
    /// Action that resolves it.
    pub remedy: String,
}

/// Findings of one code and severity, with their exact number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FindingKind {
    /// Their code.
    pub code: Code,
    /// Their severity.
    pub severity: Severity,
    /// Their number, stored or not.
    pub count: u64,
}

impl FindingKind {
    /// The kinds in several lists, in reading order: implausible values first, because other
    /// findings may follow from them, then by falling severity, then in the order of the codes.
    pub fn of<'a>(lists: impl IntoIterator<Item = &'a Diagnostics>) -> Vec<Self> {
        let mut counts: BTreeMap<_, u64> = BTreeMap::new();
        for (&kind, count) in lists.into_iter().flat_map(|list| &list.counts) {
            *counts.entry(kind).or_insert(0) += count;
        }
        let kind = |((code, severity), count)| Self {
            code,
            severity,
            count,
        };
        let mut kinds: Vec<Self> = counts.into_iter().map(kind).collect();
        kinds.sort_by_key(|kind| {
            let is_first = kind.code == Code::Implausible;
            (!is_first, std::cmp::Reverse(kind.severity), kind.code)
        });
        kinds
    }

    /// Returns `true` if a finding is one of these.
    pub fn has(&self, finding: &Diagnostic) -> bool {
        (finding.code, finding.severity) == (self.code, self.severity)
    }
}

/// Findings: stored up to a limit per code and severity, and counted exactly beyond it.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    stored: Vec<Diagnostic>,
    counts: BTreeMap<(Code, Severity), u64>,
    limit_per_kind: usize,
}

impl Default for Diagnostics {
    fn default() -> Self {
        Self::with_limit(Limits::default().diagnostics_per_code)
    }
}

impl Diagnostics {
    /// An empty list that stores at most `per_kind` findings of each code and severity.
    pub fn with_limit(per_kind: usize) -> Self {
        Self {
            stored: Vec::new(),
            counts: BTreeMap::new(),
            limit_per_kind: per_kind,
        }
    }

    /// Changes the places of all findings.
    pub fn change_places(&mut self, change: impl FnMut(&mut Place)) {
        self.stored
            .iter_mut()
            .map(|finding| &mut finding.place)
            .for_each(change);
    }

    /// Adds a finding of the severity of its code. Calls `place` and `message` only if the list
    /// stores it.
    pub fn push(
        &mut self,
        code: Code,
        place: impl FnOnce() -> Place,
        message: impl FnOnce() -> String,
        remedy: impl Into<String>,
    ) {
        self.push_as(code.severity(), code, place, message, remedy);
    }

    /// Adds a finding whose severity depends on the case, not only on its code.
    pub fn push_as(
        &mut self,
        severity: Severity,
        code: Code,
        place: impl FnOnce() -> Place,
        message: impl FnOnce() -> String,
        remedy: impl Into<String>,
    ) {
        let count = self.counts.entry((code, severity)).or_insert(0);
        *count += 1;
        if *count <= self.limit_per_kind as u64 {
            self.stored.push(Diagnostic {
                code,
                severity,
                place: place(),
                message: message(),
                remedy: remedy.into(),
            });
        }
    }

    /// Adds the finding of a refused path, with the severity of the refusal.
    pub fn push_refused(
        &mut self,
        path: RefusedPath<'_>,
        place: impl FnOnce() -> Place,
        remedy: impl Into<String>,
    ) {
        let message = || path.detail.to_owned();
        self.push_as(path.severity(), path.code, place, message, remedy);
    }

    /// Adds all findings of another list.
    pub fn append(&mut self, other: Self) {
        let mut other_stored = other.stored;
        for (kind, count) in other.counts {
            let own = self.counts.entry(kind).or_insert(0);
            let capacity = (self.limit_per_kind as u64).saturating_sub(*own) as usize;
            *own += count;
            let of_kind = other_stored.extract_if(.., |d| (d.code, d.severity) == kind);
            self.stored.extend(of_kind.take(capacity));
        }
    }

    /// Stored findings, in the order of their detection.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Diagnostic> {
        self.stored.iter()
    }

    /// Stored findings, mutable: a reader may learn their place after their detection.
    pub fn iter_mut(&mut self) -> impl ExactSizeIterator<Item = &mut Diagnostic> {
        self.stored.iter_mut()
    }

    /// Removes the stored findings that `keeps` rejects, and all findings of the kinds that
    /// `keeps_kind` rejects, stored or not.
    pub fn retain(
        &mut self,
        mut keeps_kind: impl FnMut(Code, Severity) -> bool,
        mut keeps: impl FnMut(&Diagnostic) -> bool,
    ) {
        self.counts
            .retain(|&(code, severity), _| keeps_kind(code, severity));
        let counts = &mut self.counts;
        self.stored.retain(|finding| {
            let kind = (finding.code, finding.severity);
            let Some(count) = counts.get_mut(&kind) else {
                return false;
            };
            let stays = keeps(finding);
            *count -= u64::from(!stays);
            stays
        });
        self.counts.retain(|_, count| *count > 0);
    }

    /// Exact number of findings of each code, whatever their severity.
    pub fn counts(&self) -> impl Iterator<Item = (Code, u64)> {
        let mut counts = BTreeMap::new();
        for (&(code, _), count) in &self.counts {
            *counts.entry(code).or_insert(0) += count;
        }
        counts.into_iter()
    }

    /// Exact number of findings of one code, whatever their severity.
    pub fn count(&self, code: Code) -> u64 {
        let of_code = self.counts.iter().filter(|((c, _), _)| *c == code);
        of_code.map(|(_, count)| count).sum()
    }

    /// Exact number of findings of this severity or a higher one.
    pub fn count_at_least(&self, severity: Severity) -> u64 {
        let severe = self.counts.iter().filter(|((_, s), _)| *s >= severity);
        severe.map(|(_, count)| count).sum()
    }

    /// Returns `true` if there are no findings.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn push(found: &mut Diagnostics, severity: Severity, times: usize) {
        for _ in 0..times {
            let (place, message) = (|| Place::element("path"), || "odd".to_owned());
            found.push_as(severity, Code::ZeroLength, place, message, "Correct it");
        }
    }

    #[test]
    fn counts_by_severity_are_exact_beyond_the_limit() {
        let mut found = Diagnostics::with_limit(2);
        push(&mut found, Severity::Info, 5);
        push(&mut found, Severity::Error, 3);
        let mut other = Diagnostics::with_limit(2);
        push(&mut other, Severity::Error, 4);
        push(&mut other, Severity::Warning, 1);
        found.append(other);
        let at_least =
            [Severity::Info, Severity::Warning, Severity::Error].map(|s| found.count_at_least(s));
        assert_eq!(at_least, [13, 8, 7]);
        assert_eq!(found.count(Code::ZeroLength), 13);
        assert!(found.counts().eq([(Code::ZeroLength, 13)]));
        // Frequent findings of one severity leave space for those of another.
        let stored = |severity| found.iter().filter(|d| d.severity == severity).count();
        let stored = [Severity::Info, Severity::Warning, Severity::Error].map(stored);
        assert_eq!(stored, [2, 1, 2]);
    }

    #[test]
    fn kinds_begin_with_implausible_values() {
        let mut found = Diagnostics::default();
        push(&mut found, Severity::Info, 1);
        push(&mut found, Severity::Error, 1);
        let message = || "far".to_owned();
        found.push(Code::Implausible, Place::default, message, "Check the unit");
        let kinds = FindingKind::of([&found, &found]);
        let kinds: Vec<_> = kinds
            .iter()
            .map(|k| (k.code, k.severity, k.count))
            .collect();
        let expected = [
            (Code::Implausible, Severity::Warning, 2),
            (Code::ZeroLength, Severity::Error, 2),
            (Code::ZeroLength, Severity::Info, 2),
        ];
        assert_eq!(kinds, expected);
    }

    #[test]
    fn removed_findings_are_not_counted() {
        let mut found = Diagnostics::with_limit(2);
        push(&mut found, Severity::Info, 5);
        push(&mut found, Severity::Error, 3);
        push(&mut found, Severity::Warning, 1);
        let mut seen = 0;
        found.retain(
            |_, severity| severity != Severity::Error,
            |finding| {
                seen += 1;
                finding.severity == Severity::Info && seen > 1
            },
        );
        // One of two stored notes is gone, the three that were counted only stay.
        let kinds = FindingKind::of([&found]);
        assert_eq!(kinds.len(), 1);
        assert_eq!((kinds[0].severity, kinds[0].count), (Severity::Info, 4));
        assert_eq!(found.iter().count(), 1);
    }

    #[test]
    fn refusals_are_errors_unless_the_file_is_right() {
        let refused = |code| RefusedPath {
            id: "e1",
            code,
            detail: "no",
        };
        let mut found = Diagnostics::default();
        for code in [
            Code::UnusedNode,
            Code::ZeroLength,
            Code::NotDrawn,
            Code::CrossLevel,
        ] {
            found.push_refused(refused(code), Place::default, "");
        }
        assert_eq!(found.count_at_least(Severity::Error), 2);
        assert_eq!(found.count_at_least(Severity::Info), 4);
    }
}
