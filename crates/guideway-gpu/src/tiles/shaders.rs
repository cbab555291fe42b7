//! Shaders: which files each is put together from, and what it binds.

use crate::device::Source;

macro_rules! wgsl {
    ($($file:literal),+) => {
        concat!($(include_str!(concat!("shaders/", $file, ".wgsl"))),+)
    };
}

/// Shaders that paint tiles, with so many samples in one row of a pixel.
macro_rules! tiles {
    ($samples:literal, $name:literal, [$($file:literal),+], $bindings:expr) => {
        Source {
            name: $name,
            wgsl: concat!(
                "const SAMPLES_A_ROW: u32 = ",
                $samples,
                "u;\n",
                wgsl!(
                    "frame", "work", "view", "style", "rank", "lines", "walk", "capsule", "tile", "open", "blend", $($file),+
                )
            ),
            bindings: $bindings,
        }
    };
}

pub(super) const CULL: Source = Source {
    name: "cull",
    wgsl: wgsl!(
        "frame", "work", "found", "view", "cluster", "seen", "blocks", "cull"
    ),
    bindings: &["frame", "clusters", "found"],
};

pub(super) const STRIKE: Source = Source {
    name: "strike",
    wgsl: wgsl!(
        "frame", "work", "found", "view", "cluster", "lines", "seen", "blocks", "strike"
    ),
    bindings: &["frame", "clusters", "found", "lines", "touched"],
};

macro_rules! flatten {
    ($points:literal, $($main:literal),+) => {
        Source {
            name: "flatten",
            wgsl: wgsl!(
                "frame", "work", "found", "view", "cluster", "stroke", "style", $points, "curve",
                "plan", "clip", "lines", "walk", "hidden", "clusters", "emit", $($main),+
            ),
            bindings: &[
                "frame",
                "chunk",
                "points",
                "strokes",
                "clusters",
                "styles",
                "found",
                "lines",
                "line_ranks",
                "counts",
            ],
        }
    };
}

/// By [`Points`].
pub(super) const FLATTEN: [Source; 2] = [
    flatten!("rounded", "pieces", "flatten", "sums"),
    flatten!("exact", "pieces", "flatten", "sums"),
];

/// As [`FLATTEN`], by threads that all run in step on a processor.
pub(super) const FLATTEN_IN_STEP: [Source; 2] = [
    flatten!("rounded", "in_step", "flatten_in_step"),
    flatten!("exact", "in_step", "flatten_in_step"),
];

/// Shaders that go through lines which are there.
macro_rules! pass {
    ($name:literal, [$($file:literal),+], [$($binding:literal),+]) => {
        Source {
            name: $name,
            wgsl: wgsl!(
                "frame", "work", "found", "view", "style", "rank", "lines", "walk", "pass", $($file),+
            ),
            bindings: &["frame", "found", "lines", "line_ranks", "styles", $($binding),+],
        }
    };
}

pub(super) const RECOUNT: Source = pass!("recount", ["tally", "recount"], ["counts"]);

pub(super) const LIST_KEPT: Source = pass!("list", ["list_kept"], ["counts", "references"]);

pub(super) const SCATTER: Source = pass!("scatter", ["tally", "scatter"], ["filled", "references"]);

pub(super) const STARTS: Source = Source {
    name: "starts",
    wgsl: wgsl!("frame", "work", "found", "starts"),
    bindings: &["frame", "counts", "lists", "filled", "found"],
};

pub(super) const SHARE: Source = Source {
    name: "share",
    wgsl: wgsl!("frame", "work", "found", "shares", "share"),
    bindings: &["frame", "lists", "found", "shares"],
};

/// Sorts lists of more than two to the power of `$above_bits` entries, those of more than two to the power of `$place_bits`
/// only if it takes all. Up to there the keys are held where the workgroup shares them: the less it holds, the more
/// workgroups run at a time.
macro_rules! sort {
    ($above_bits:literal, $place_bits:literal, $takes_all:literal) => {
        Source {
            name: "sort",
            wgsl: concat!(
                "const ABOVE_BITS: u32 = ",
                $above_bits,
                "u;\nconst PLACE_BITS: u32 = ",
                $place_bits,
                "u;\nconst TAKES_ALL: bool = ",
                $takes_all,
                ";\n",
                wgsl!("frame", "work", "sort", "found")
            ),
            bindings: &["frame", "lists", "references", "line_ranks", "found"],
        }
    };
}

/// Of short lists, and of all others.
pub(super) const SORT: [Source; 2] = [sort!(0, 10, false), sort!(10, 12, true)];

pub(super) const SHIFT: Source = Source {
    name: "shift",
    wgsl: wgsl!("shift"),
    bindings: &["shift", "old_pixels", "pixels"],
};

/// What shaders that paint tiles bind, and what some of them bind beside it.
macro_rules! tile_bindings {
    ($($more:literal),*) => {
        &[
            "frame", "lists", "references", "lines", "line_ranks", "styles", "pixels",
            $($more),*
        ]
    };
}

macro_rules! cover {
    ($samples:literal, [$($lanes:literal),+], [$($main:literal),+], $bindings:expr) => {
        tiles!(
            $samples,
            "cover",
            // What is set from outside has to come before arrays of a length that is, too.
            [$($lanes),+, $($main),+, "deal", "cover", "found"],
            $bindings
        )
    };
}

/// By [`Samples`].
macro_rules! covers {
    ($lanes:tt, $main:tt, $bindings:expr) => {
        [
            cover!(4, $lanes, $main, $bindings),
            cover!(16, $lanes, $main, $bindings),
        ]
    };
}

macro_rules! all_covers {
    ($lanes:tt) => {
        Covers {
            alone: covers!($lanes, ["cover_tiles"], tile_bindings!("counts", "found")),
            shared: covers!(
                $lanes,
                ["cover_shared", "shares"],
                tile_bindings!("counts", "found", "shares")
            ),
        }
    };
}

/// One opaque color, by [`Samples`].
pub(super) struct Covers {
    /// A workgroup a tile.
    pub(super) alone: [Source; 2],
    /// And several for some.
    pub(super) shared: [Source; 2],
}

/// Where threads see each other's values.
pub(super) const COVERS: Covers = all_covers!(["shuffle", "lanes"]);

/// Where they do not.
pub(super) const COVERS_APART: Covers = all_covers!(["sums", "lanes_apart"]);

macro_rules! covers_in_step {
    ($samples:literal) => {
        tiles!(
            $samples,
            "cover",
            [
                "in_step",
                "shuffle",
                "cover_in_step",
                "show_in_step",
                "found"
            ],
            tile_bindings!("counts", "found")
        )
    };
}

/// As those alone in [`COVERS`], by threads that all run in step on a processor.
pub(super) const COVERS_IN_STEP: [Source; 2] = [covers_in_step!(4), covers_in_step!(16)];

macro_rules! opaque {
    ($samples:literal) => {
        tiles!(
            $samples,
            "opaque",
            // What is set from outside has to come before arrays of a length that is, too.
            [
                "sums",
                "row",
                "rows",
                "portion",
                "order",
                "laid",
                "opaque_rows",
                "opaque",
                "rounds",
                "found"
            ],
            tile_bindings!("found")
        )
    };
}

/// Opaque paths in many colors, by [`Samples`].
pub(super) const OPAQUE: [Source; 2] = [opaque!(4), opaque!(16)];

/// The same of few samples, where threads see each other's values.
pub(super) const OPAQUE_TEAMS: Source = tiles!(
    4,
    "opaque",
    // As above.
    [
        "row",
        "shuffle",
        "opaque_teams",
        "sums",
        "portion",
        "order",
        "laid",
        "opaque",
        "rounds",
        "found"
    ],
    tile_bindings!("found")
);

macro_rules! layers {
    ($samples:literal) => {
        tiles!(
            $samples,
            "layers",
            // As above.
            ["layers", "row", "rows", "rounds", "found"],
            tile_bindings!("found")
        )
    };
}

/// Anything else; by [`Samples`].
pub(super) const LAYERS: [Source; 2] = [layers!(4), layers!(16)];
