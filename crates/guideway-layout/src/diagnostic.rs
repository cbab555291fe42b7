//! [`Diagnostic`]: a finding about a layout, and [`Diagnostics`], a bounded list of them.

use std::collections::BTreeMap;
use std::fmt;

use crate::{Code, Limits, Severity};

/// Position of a finding in its source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Element of the file, such as `layouts[0].edges[3].trajectory` or `path "A --- B"`.
    pub element: String,
    /// Line in a text file, counted from 1.
    pub line: Option<u32>,
}

impl Place {
    /// An element without a line.
    pub fn element(element: impl Into<String>) -> Self {
        Self {
            element: element.into(),
            line: None,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.element)?;
        match self.line {
            Some(line) => write!(f, " (line {line})"),
            None => Ok(()),
        }
    }
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Kind of the finding.
    pub code: Code,
    /// Position in the source.
    pub place: Place,
    /// Description of the finding, with the values.
    pub message: String,
    /// Action that resolves it.
    pub remedy: String,
}

impl Diagnostic {
    /// Severity, which follows from the code.
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}

/// Findings: stored up to a limit per code, and counted exactly beyond it.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    stored: Vec<Diagnostic>,
    counts: BTreeMap<Code, u64>,
    limit_per_code: usize,
}

impl Default for Diagnostics {
    fn default() -> Self {
        Self::with_limit(Limits::default().diagnostics_per_code)
    }
}

impl Diagnostics {
    /// An empty list that stores at most `per_code` findings of each kind.
    pub fn with_limit(per_code: usize) -> Self {
        Self {
            stored: Vec::new(),
            counts: BTreeMap::new(),
            limit_per_code: per_code,
        }
    }

    /// Adds a finding. Calls `place` and `message` only if the list stores it.
    pub fn push(
        &mut self,
        code: Code,
        place: impl FnOnce() -> Place,
        message: impl FnOnce() -> String,
        remedy: impl Into<String>,
    ) {
        let count = self.counts.entry(code).or_insert(0);
        *count += 1;
        if *count <= self.limit_per_code as u64 {
            self.stored.push(Diagnostic {
                code,
                place: place(),
                message: message(),
                remedy: remedy.into(),
            });
        }
    }

    /// Adds all findings of another list.
    pub fn append(&mut self, other: Self) {
        let mut other_stored = other.stored;
        for (code, count) in other.counts {
            let own = self.counts.entry(code).or_insert(0);
            let capacity = (self.limit_per_code as u64).saturating_sub(*own) as usize;
            *own += count;
            let of_code = other_stored.extract_if(.., |d| d.code == code);
            self.stored.extend(of_code.take(capacity));
        }
    }

    /// Stored findings, in the order of their detection.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.stored.iter()
    }

    /// Stored findings, mutable: a reader may learn their place after their detection.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Diagnostic> {
        self.stored.iter_mut()
    }

    /// Exact number of findings of each kind.
    pub fn counts(&self) -> impl Iterator<Item = (Code, u64)> {
        self.counts.iter().map(|(&code, &count)| (code, count))
    }

    /// Exact number of findings of one kind.
    pub fn count(&self, code: Code) -> u64 {
        self.counts.get(&code).copied().unwrap_or(0)
    }

    /// Exact number of findings of this severity or a higher one.
    pub fn count_at_least(&self, severity: Severity) -> u64 {
        self.counts()
            .filter(|(c, _)| c.severity() >= severity)
            .map(|(_, n)| n)
            .sum()
    }

    /// Whether there are no findings.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }
}
