//! WGSL sources of all kernels, assembled from the files of this folder.
//!
//! | folder | stage |
//! |---|---|
//! | `flatten` | culls clusters; turns the curves of visible clusters into lines |
//! | `bin` | lists the lines of each tile; sorts or splits lists |
//! | `cover` | draws tiles of one opaque color |
//! | `composite` | draws tiles of many colors, of translucent paths, or density |
//! | `cache` | bins cached lines, invalidates edited lines, scrolls pictures |
//! | `shared` | structures and functions of several stages |
//!
//! `present` writes the finished picture to a texture.
//!
//! Each entry point has a file of its own, named in [`ENTRIES`]. `import` resolves its imports.

mod files;
mod import;

#[cfg(test)]
pub(crate) use files::FILES;

use crate::device::Source;
use crate::tiles::constants::Samples;
use crate::tiles::layouts::PointFormat;
use import::resolve;

/// An entry point: its name for messages, its file, and its bindings in order.
pub(crate) struct Entry {
    name: &'static str,
    file: &'static str,
    bindings: &'static [&'static str],
}

impl Entry {
    /// The source of an entry point without variants.
    pub(crate) fn source(&self) -> Source {
        self.variant(&[], &[])
    }

    /// Resolves the imports. `variants` replace `{name}` in imports, `constants` precede the text.
    fn variant(&self, variants: &[(&str, &str)], constants: &[(&str, &str, &str)]) -> Source {
        Source {
            name: self.name,
            wgsl: resolve(self.file, variants, constants).into(),
            bindings: self.bindings,
        }
    }
}

pub(crate) const CULL: Entry = Entry {
    name: "cull",
    file: "flatten/cull.wgsl",
    bindings: &["frame", "clusters", "counters"],
};

const FLATTEN: Entry = Entry {
    name: "flatten",
    file: "flatten/flatten.wgsl",
    bindings: &[
        "frame",
        "dispatch",
        "points",
        "strokes",
        "clusters",
        "styles",
        "counters",
        "lines",
        "line_ranks",
        "tile_counts",
    ],
};

pub(crate) const INVALIDATE_LINES: Entry = Entry {
    name: "invalidate_lines",
    file: "cache/invalidate_lines.wgsl",
    bindings: &["frame", "clusters", "counters", "lines", "dirty_clusters"],
};

pub(crate) const COUNT_CACHED: Entry = Entry {
    name: "count_cached",
    file: "cache/count_cached.wgsl",
    bindings: &[
        "frame",
        "counters",
        "lines",
        "line_ranks",
        "styles",
        "tile_counts",
    ],
};

pub(crate) const BIN_CACHED: Entry = Entry {
    name: "bin_cached",
    file: "cache/bin_cached.wgsl",
    bindings: &[
        "frame",
        "counters",
        "lines",
        "line_ranks",
        "styles",
        "tile_counts",
        "references",
    ],
};

pub(crate) const SCROLL: Entry = Entry {
    name: "scroll",
    file: "cache/scroll.wgsl",
    bindings: &["scroll", "old_pixels", "pixels"],
};

pub(crate) const PRESENT: Entry = Entry {
    name: "present",
    file: "present.wgsl",
    bindings: &["part", "pixels", "picture"],
};

pub(crate) const TILE_OFFSETS: Entry = Entry {
    name: "tile_offsets",
    file: "bin/tile_offsets.wgsl",
    bindings: &[
        "frame",
        "tile_counts",
        "tile_lists",
        "list_cursors",
        "counters",
    ],
};

pub(crate) const SPLIT_TILES: Entry = Entry {
    name: "split_tiles",
    file: "bin/split_tiles.wgsl",
    bindings: &["frame", "tile_lists", "counters", "split_lists"],
};

pub(crate) const BIN_LINES: Entry = Entry {
    name: "bin_lines",
    file: "bin/bin_lines.wgsl",
    bindings: &[
        "frame",
        "counters",
        "lines",
        "line_ranks",
        "styles",
        "list_cursors",
        "references",
    ],
};

const SORT_LISTS: Entry = Entry {
    name: "sort_lists",
    file: "bin/sort_lists.wgsl",
    bindings: &[
        "frame",
        "tile_lists",
        "references",
        "line_ranks",
        "counters",
    ],
};

const COVER_TILES: Entry = Entry {
    name: "cover_tiles",
    file: "cover/cover_tiles.wgsl",
    bindings: &[
        "frame",
        "tile_lists",
        "references",
        "lines",
        "line_ranks",
        "styles",
        "pixels",
        "tile_counts",
        "counters",
    ],
};

const COVER_SPLIT_TILES: Entry = Entry {
    name: "cover_split_tiles",
    file: "cover/cover_split_tiles.wgsl",
    bindings: &[
        "frame",
        "tile_lists",
        "references",
        "lines",
        "line_ranks",
        "styles",
        "pixels",
        "tile_counts",
        "counters",
        "split_lists",
    ],
};

const OPAQUE: Entry = Entry {
    name: "opaque",
    file: "composite/opaque.wgsl",
    bindings: &[
        "frame",
        "tile_lists",
        "references",
        "lines",
        "line_ranks",
        "styles",
        "pixels",
        "counters",
    ],
};

const LAYERS: Entry = Entry {
    name: "layers",
    file: "composite/layers.wgsl",
    ..OPAQUE
};

/// Files of all entry points.
#[cfg(test)]
pub(crate) const ENTRIES: [&str; 15] = [
    CULL.file,
    FLATTEN.file,
    INVALIDATE_LINES.file,
    COUNT_CACHED.file,
    BIN_CACHED.file,
    SCROLL.file,
    PRESENT.file,
    TILE_OFFSETS.file,
    SPLIT_TILES.file,
    BIN_LINES.file,
    SORT_LISTS.file,
    COVER_TILES.file,
    COVER_SPLIT_TILES.file,
    OPAQUE.file,
    LAYERS.file,
];

/// The threads that hand values to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Team {
    /// A subgroup, through registers.
    Subgroup,
    /// A workgroup, through its memory.
    Workgroup,
}

impl Team {
    fn name(self) -> &'static str {
        match self {
            Self::Subgroup => "subgroup",
            Self::Workgroup => "workgroup",
        }
    }
}

/// Lists that a `sort_lists` kernel sorts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SortedLists {
    /// Up to 1,024 entries, all keys in workgroup memory. Less memory per workgroup lets more
    /// workgroups run at a time.
    Short,
    /// All longer ones, up to 4,096 entries with keys in workgroup memory.
    Long,
}

fn samples_per_row(samples: Samples) -> (&'static str, &'static str, &'static str) {
    let value = match samples {
        Samples::Coarse => "4u",
        Samples::Fine => "16u",
    };
    ("SAMPLES_PER_ROW", "u32", value)
}

pub(crate) fn flatten(format: PointFormat) -> Source {
    let points = match format {
        PointFormat::Rounded => "rounded",
        PointFormat::Exact => "exact",
    };
    FLATTEN.variant(&[("points", points)], &[])
}

pub(crate) fn sort_lists(lists: SortedLists) -> Source {
    let [min_count_bits, index_bits, sorts_long_lists] = match lists {
        SortedLists::Short => ["0u", "10u", "false"],
        SortedLists::Long => ["10u", "12u", "true"],
    };
    SORT_LISTS.variant(
        &[],
        &[
            ("MIN_COUNT_BITS", "u32", min_count_bits),
            ("INDEX_BITS", "u32", index_bits),
            ("SORTS_LONG_LISTS", "bool", sorts_long_lists),
        ],
    )
}

pub(crate) fn cover_tiles(samples: Samples, team: Team) -> Source {
    COVER_TILES.variant(&[("team", team.name())], &[samples_per_row(samples)])
}

pub(crate) fn cover_split_tiles(samples: Samples, team: Team) -> Source {
    COVER_SPLIT_TILES.variant(&[("team", team.name())], &[samples_per_row(samples)])
}

pub(crate) fn opaque(samples: Samples, team: Team) -> Source {
    OPAQUE.variant(&[("rows", team.name())], &[samples_per_row(samples)])
}

pub(crate) fn layers(samples: Samples) -> Source {
    LAYERS.variant(&[], &[samples_per_row(samples)])
}
