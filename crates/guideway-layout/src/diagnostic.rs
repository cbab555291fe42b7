use std::collections::BTreeMap;
use std::fmt;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; nothing is wrong.
    Info,
    /// Odd, and drawn all the same.
    Warning,
    /// Wrong: something could not be drawn, or is drawn otherwise than meant.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

macro_rules! codes {
    ($($variant:ident $name:literal $severity:ident $doc:literal;)*) => {
        /// What kind of finding it is. Names are stable: scripts may depend on them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code { $(#[doc = $doc] $variant,)* }

        impl Code {
            /// Every code there is.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The stable name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// How bad a finding of this kind is.
            pub fn severity(self) -> Severity {
                match self { $(Self::$variant => Severity::$severity,)* }
            }

            /// One sentence on what it means.
            pub fn meaning(self) -> &'static str {
                match self { $(Self::$variant => $doc,)* }
            }
        }
    };
}

codes! {
    NonFinite "non-finite" Error "A coordinate is NaN or infinite.";
    OutOfRange "out-of-range" Error "A coordinate is beyond the largest that is supported.";
    MissingField "missing-field" Error "A field that is needed is absent or null.";
    WrongType "wrong-type" Warning "A field has another type than the format says.";
    UnknownValue "unknown-value" Warning "A field has a value that the format does not know.";
    TooFewPoints "too-few-points" Error "A curve has too few control points.";
    BadDegree "bad-degree" Error "A curve's degree is not a whole number that is supported.";
    BadKnots "bad-knots" Error "A knot vector has the wrong length or falls; the control polygon is drawn.";
    UnclampedKnots "unclamped-knots" Info "A knot vector is not clamped: the curve does not begin and end at its outer control points.";
    MissingKnots "missing-knots" Info "A knot vector is absent; a uniform clamped one is used.";
    KnotMultiplicity "knot-multiplicity" Warning "An inner knot is so often repeated that the curve is broken there.";
    BadWeight "bad-weight" Warning "A weight is zero, negative or not finite; 1 is used.";
    UnknownNode "unknown-node" Error "A path or station names a node that does not exist.";
    NodeGap "node-gap" Warning "A path does not begin or end at its node.";
    UnusedNode "unused-node" Info "No drawn path begins or ends at a node.";
    CrossLevel "cross-level" Info "A path leads to another level; it is not drawn across one plane.";
    Kink "kink" Warning "The direction of a path jumps.";
    Curvature "curvature" Warning "A path is bent more tightly than the radius asked for.";
    BrokenPath "broken-path" Warning "A path has a gap inside: one part does not begin where the last one ends.";
    ZeroLength "zero-length" Warning "A path has no length; it is drawn as a dot.";
    DuplicateId "duplicate-id" Warning "An identifier is used more than once.";
    DuplicatePath "duplicate-path" Warning "Two paths have the same curve in the same direction.";
    ReversePair "reverse-pair" Info "Two paths have the same curve in opposite directions: a two-way road.";
    DuplicateKey "duplicate-key" Warning "An object has the same key twice; the last one counts.";
    ApproximateShape "approximate-shape" Info "The file does not store the exact shape of a path; a plain one is drawn.";
    LegacyPosition "legacy-position" Info "Model and layout positions differ; the layout position is drawn.";
    AssumedUnit "assumed-unit" Info "The file does not say in what unit its positions are; one is assumed.";
    Version "version" Info "The version that a file states is not that of its structure.";
    Attribute "attribute" Info "An attribute could not be kept as it is.";
    NotDrawn "not-drawn" Info "An element is switched off in the file, or of a kind that is no path.";
    Clearance "clearance" Warning "Vehicles on two paths come nearer to each other than the clearance asked for.";
    WallClearance "wall-clearance" Warning "A vehicle comes nearer to the floor plan than the clearance asked for.";
    Implausible "implausible" Warning "The values are legal but look like a mistake, such as a wrong unit.";
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Where in the source a finding is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Element of the file, such as `layouts[0].edges[3].trajectory` or `path "A --- B"`.
    pub element: String,
    /// Line in a text file, from 1.
    pub line: Option<u32>,
}

impl Place {
    /// An element, its line unknown.
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
    /// What kind of finding.
    pub code: Code,
    /// Where.
    pub place: Place,
    /// What was found, with the values.
    pub message: String,
    /// What to do about it.
    pub remedy: String,
}

impl Diagnostic {
    /// How bad it is.
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}

/// All findings: kept whole up to a number for each code, counted exactly beyond it.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    kept: Vec<Diagnostic>,
    counts: BTreeMap<Code, u64>,
    keep_per_code: usize,
}

impl Default for Diagnostics {
    fn default() -> Self {
        Self::keeping(crate::Limits::default().diagnostics_per_code)
    }
}

impl Diagnostics {
    /// An empty list that keeps at most `per_code` findings of each kind whole.
    pub fn keeping(per_code: usize) -> Self {
        Self {
            kept: Vec::new(),
            counts: BTreeMap::new(),
            keep_per_code: per_code,
        }
    }

    /// Adds a finding. The text is only made when it will be kept.
    pub fn push(
        &mut self,
        code: Code,
        place: impl FnOnce() -> Place,
        message: impl FnOnce() -> String,
        remedy: impl Into<String>,
    ) {
        let count = self.counts.entry(code).or_insert(0);
        *count += 1;
        if *count <= self.keep_per_code as u64 {
            self.kept.push(Diagnostic {
                code,
                place: place(),
                message: message(),
                remedy: remedy.into(),
            });
        }
    }

    /// Adds all findings of another list.
    pub fn append(&mut self, other: Self) {
        let mut other_kept = other.kept;
        for (code, count) in other.counts {
            let own = self.counts.entry(code).or_insert(0);
            let room = (self.keep_per_code as u64).saturating_sub(*own) as usize;
            *own += count;
            self.kept
                .extend(other_kept.extract_if(.., |d| d.code == code).take(room));
        }
    }

    /// Findings kept whole, in the order found.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.kept.iter()
    }

    /// Findings kept whole, for what is only known of them later.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Diagnostic> {
        self.kept.iter_mut()
    }

    /// Exact number of findings of each kind.
    pub fn counts(&self) -> impl Iterator<Item = (Code, u64)> {
        self.counts.iter().map(|(&code, &count)| (code, count))
    }

    /// Exact number of findings of one kind.
    pub fn count(&self, code: Code) -> u64 {
        self.counts.get(&code).copied().unwrap_or(0)
    }

    /// Exact number of findings this bad or worse.
    pub fn count_at_least(&self, severity: Severity) -> u64 {
        self.counts()
            .filter(|(c, _)| c.severity() >= severity)
            .map(|(_, n)| n)
            .sum()
    }

    /// Whether there is none at all.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }
}
