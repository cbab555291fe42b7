//! [`Code`]: the kinds of findings with their stable names, and [`Severity`].

use std::fmt;

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Information: nothing is wrong.
    Info,
    /// Suspicious, but drawn.
    Warning,
    /// Wrong: an element could not be drawn, or is drawn differently from what the file means.
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
        /// Kind of a finding. Names are stable: scripts may depend on them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code { $(#[doc = $doc] $variant,)* }

        impl Code {
            /// All codes, in the order of docs/diagnostics.md.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The stable name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Severity of findings of this kind, where the case does not decide it.
            pub fn severity(self) -> Severity {
                match self { $(Self::$variant => Severity::$severity,)* }
            }

            /// The code of a name.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|code| code.name() == name)
            }

            /// Meaning, in one sentence.
            pub fn meaning(self) -> &'static str {
                match self { $(Self::$variant => $doc,)* }
            }
        }
    };
}

codes! {
    NonFinite "non-finite" Error "A coordinate is NaN or infinite.";
    OutOfRange "out-of-range" Error "A coordinate exceeds the supported range.";
    MissingField "missing-field" Error "A required field is absent or null.";
    WrongType "wrong-type" Warning "A field does not have the type that the format specifies.";
    UnknownValue "unknown-value" Warning "A field has a value that the format does not define.";
    TooFewPoints "too-few-points" Error "A curve has too few control points.";
    BadDegree "bad-degree" Error "The degree of a curve is not a supported whole number.";
    BadKnots "bad-knots" Error
        "A knot vector has the wrong length or decreases.";
    UnclampedKnots "unclamped-knots" Info
        "A knot vector is not clamped: the curve does not reach its outer control points.";
    MissingKnots "missing-knots" Info "A knot vector is absent; a uniform clamped one is used.";
    KnotMultiplicity "knot-multiplicity" Warning
        "An inner knot repeats more often than the degree, so the curve may break there.";
    BadWeight "bad-weight" Warning "A weight is negative, not finite or without effect; 1 is used.";
    UnknownNode "unknown-node" Error "A path or station names a node that does not exist.";
    NodeGap "node-gap" Warning "A path does not begin or end at its node.";
    UnusedNode "unused-node" Info "No drawn path begins or ends at a node.";
    CrossLevel "cross-level" Info
        "A path leads to another level; it is not drawn across one plane.";
    Kink "kink" Warning "The direction of a path jumps.";
    Curvature "curvature" Warning "A path bends more tightly than the requested radius.";
    BrokenPath "broken-path" Warning
        "A path has a gap: one part does not begin where the previous one ends.";
    ZeroLength "zero-length" Warning "A path has no length; it is drawn as a dot.";
    DuplicateId "duplicate-id" Warning "An identifier is used more than once.";
    DuplicatePath "duplicate-path" Warning
        "Two paths have the same curve in the same direction and agree in all properties.";
    SameCurve "same-curve" Info
        "Two paths have the same curve in the same direction, but differ in their properties.";
    ReversePair "reverse-pair" Info
        "Two paths have the same curve in opposite directions: a two-way road.";
    DuplicateKey "duplicate-key" Warning
        "An object has the same key twice; the last one counts.";
    ApproximateShape "approximate-shape" Info
        "The file does not store the exact shape of a path; a simple one is drawn.";
    LegacyPosition "legacy-position" Info
        "Model and layout positions differ; the layout position is drawn.";
    AssumedUnit "assumed-unit" Info
        "The file does not state the unit of its positions; one is assumed.";
    Version "version" Info "The version that a file states does not match its structure.";
    Attribute "attribute" Info "An attribute could not be preserved exactly.";
    NotDrawn "not-drawn" Info
        "An element is switched off in the file, or is not a path.";
    Clearance "clearance" Warning
        "Vehicles on two paths come nearer to each other than the requested clearance.";
    WallClearance "wall-clearance" Warning
        "A vehicle comes nearer to the floor plan than the requested clearance.";
    NotConnected "not-connected" Warning
        "No path connects a part of the network with the largest part of its level.";
    OneWayPart "one-way-part" Warning
        "Vehicles can enter a part of the network and not leave it, or leave it and not enter it.";
    DeadEnd "dead-end" Warning "Vehicles can enter a node, and cannot go on.";
    HeadOn "head-on" Warning "One-way paths lead to each other, and none leads away.";
    StationWithoutNode "station-without-node" Warning "A station has no node.";
    UnreachableStation "unreachable-station" Warning
        "Vehicles cannot reach a station, or cannot leave it.";
    HeadingJump "heading-jump" Warning
        "The heading jumps from path to path at a node where rotation is forbidden.";
    ReverseDriving "reverse-driving" Warning
        "Vehicles must drive back where no rotation is permitted and no orientation is stated.";
    LateralAcceleration "lateral-acceleration" Warning
        "The speed of a path is too high for its tightest bend.";
    NoNodes "no-nodes" Info "The paths of a drawing have no nodes, so they are no network.";
    NotAnalyzed "not-analyzed" Info
        "The network is analyzed for some of its vehicle types only.";
    Unreadable "unreadable" Error "A file cannot be read.";
    Implausible "implausible" Warning
        "The values are legal but look like a mistake, such as a wrong unit.";
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
