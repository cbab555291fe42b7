//! Words of the private language that the glossary replaced.

/// A word that must not come back, and the term to use. A capital first letter stands for a type or
/// an enum variant: it is matched as written. Other words are matched in comments and Markdown.
pub(super) const FORBIDDEN: &[(&str, &str)] = &[
    ("Away", "BackgroundEdit"),
    ("Deed", "EditTask"),
    ("Drawers", "RadixBuckets"),
    ("Dress", "StylePreset"),
    ("Ear", "EditObserver"),
    ("Easel", "FrameTarget or TargetState"),
    ("Grain", "FlattenQuality"),
    ("Laid", "PreparedOverlay"),
    ("Manner", "dispatch plan"),
    ("Sheet", "DrawList"),
    ("Shot", "FrameContext or RenderRequest"),
    ("Sight", "VisibleCluster"),
    ("Twins", "ReversePairs or exact points"),
    ("Willing", "IgnoreBrokenPipe"),
    ("Wishes", "RenderOptions"),
    ("colour", "color"),
    ("centre", "center"),
    ("grey", "gray"),
    ("metre", "meter"),
    ("neighbour", "neighbor"),
    ("none if", "`None` when"),
    ("so many", "a number, or \"many\""),
    ("strikes out", "invalidates"),
    ("chequered", "checkered"),
];
