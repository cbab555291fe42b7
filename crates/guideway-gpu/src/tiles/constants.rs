//! Constants that the host and the shaders share. `layout_tests` compares them with the shaders.

/// Most strokes per cluster: one workgroup flattens a cluster, one thread a stroke.
pub(crate) const CLUSTER_STROKES: u32 = 64;
/// Most segments per stroke: one bit each in a word.
pub(crate) const STROKE_SEGMENTS: usize = 32;
/// Flag in `Stroke::extent`: the stroke is a whole path.
pub(crate) const WHOLE_PATH: u32 = 1 << 31;
/// Flag in `Stroke::extent`: an open path begins with the stroke.
pub(crate) const PATH_START: u32 = 1 << 30;
/// Flag in `Stroke::extent`: an open path ends with the stroke.
pub(crate) const PATH_END: u32 = 1 << 29;
/// Flag in `Stroke::extent`, on the device only: the path is hidden. The host keeps it in
/// `HiddenStrokes`.
pub(crate) const HIDDEN_STROKE: u32 = 1 << 28;
/// Lowest bit of the segment count in `Stroke::extent`, and its largest value.
pub(crate) const SEGMENTS_BIT: u32 = 16;
pub(crate) const MAX_SEGMENTS: u32 = (1 << 12) - 1;
/// Number of workgroups that keep a device busy while flattening. Measured on an H200: D1 magnified
/// 20 times flattens in 0.032 ms instead of 0.060 ms when they share clusters.
pub(crate) const TARGET_WORKGROUPS: u32 = 256;
/// Most visible clusters that several workgroups share. Derived: two workgroups per cluster.
pub(crate) const FEW_CLUSTERS: u32 = TARGET_WORKGROUPS / 2;
/// Most workgroups per shared cluster (log2).
pub(crate) const MAX_PARTS_LOG2: u32 = 3;
/// Words per line.
pub(crate) const LINE_WORDS: usize = 3;
/// Threads per workgroup of kernels over clusters or pixels.
pub(crate) const CLUSTER_THREADS: u32 = 64;
/// Threads per workgroup of kernels over lines.
pub(crate) const LINE_THREADS: u32 = 256;
/// Cached lines per thread and batch while counting.
pub(crate) const COUNTED_LINES_EACH: u32 = 4;
/// Number of threads that keep a device busy while binning cached lines; fewer lines get several
/// threads each. Measured on an H200, D1 magnified 20 times: binning in one dispatch with up to 32
/// threads per line takes 0.010 ms, counting first with one thread per line 0.025 ms.
pub(crate) const TARGET_LINE_THREADS: u32 = 1 << 18;
/// Most threads per cached line.
pub(crate) const MAX_THREADS_PER_LINE: u32 = 32;
/// Threads per workgroup of kernels over tile lists.
pub(crate) const LIST_THREADS: u32 = 256;
/// A device waits for a list longer than this part of all references: lists are split from there
/// on. Measured on an H200, D1 at a fifth of its size: 0.229 ms, as without splitting; splitting
/// always takes 0.286 ms.
pub(crate) const LONG_LIST_PART: u32 = 96;
/// Number of lists that keep a device busy: lists longer than this part of all references are
/// split. Measured on an H200, D1 with default widths at a tenth of its size: 0.41 ms with 512,
/// 0.53 ms with 256, 0.83 ms without splitting.
pub(crate) const TARGET_LISTS: u32 = 512;
/// Shorter lists are never split.
pub(crate) const MIN_UNSPLIT_LIST: u32 = 2048;
/// Most loop iterations of a thread per line of one opaque color. Derived: counted in
/// `distribute_rows.wgsl`.
pub(crate) const LOOPS_PER_LINE: u32 = 11;
/// Most tiles with split lists per window.
pub(crate) const MAX_SPLIT_TILES: u32 = 256;
/// Most list parts per window.
pub(crate) const MAX_SPLIT_PARTS: u32 = 1024;
/// Side of a tile in pixels.
pub(crate) const TILE_PX: u32 = 16;
/// Sample rows per pixel.
pub(crate) const SAMPLE_ROWS: u32 = 16;
/// First sample column of each sample row, two bits each. Each group of four rows has all four
/// columns, so that borders of any direction meet the columns evenly.
pub(crate) const FIRST_COLUMNS: u32 =
    pack_columns([0, 2, 1, 3, 2, 0, 3, 1, 1, 3, 0, 2, 3, 1, 2, 0]);
/// Threads per composited tile: one per sample row.
pub(crate) const TILE_THREADS: u32 = TILE_PX * SAMPLE_ROWS;

const fn pack_columns(first: [u32; SAMPLE_ROWS as usize]) -> u32 {
    let (mut packed, mut row) = (0, 0);
    while row < first.len() {
        packed |= first[row] << (2 * row);
        row += 1;
    }
    packed
}

/// Number of samples per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Samples {
    /// 64: strokes of half a pixel and wider differ from the exact picture by a few levels.
    Coarse = 0,
    /// 256, as in the exact picture: thinner strokes would pass between fewer samples.
    Fine = 1,
}

impl Samples {
    /// Samples per sample row of a pixel.
    pub(crate) const fn per_row(self) -> u32 {
        match self {
            Self::Coarse => 4,
            Self::Fine => 16,
        }
    }

    /// Threads per covered tile. The samples in workgroup memory bound the number of workgroups:
    /// more samples need more threads per workgroup.
    pub(crate) fn cover_threads(self) -> u32 {
        match self {
            Self::Coarse => 128,
            Self::Fine => 256,
        }
    }
}
