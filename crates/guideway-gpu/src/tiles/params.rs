//! What shaders and this side agree on. A test compares it with the shaders themselves.

use bytemuck::{Pod, Zeroable};

/// Most strokes of a cluster: a workgroup flattens one, a thread a stroke.
pub(super) const CLUSTER_STROKES: u32 = 64;
/// Most segments of a stroke: a bit each in one word.
pub(super) const STROKE_SEGMENTS: usize = 32;
/// Set in [`Stroke::extent`] of a stroke that is a whole path.
pub(super) const WHOLE_PATH: u32 = 1 << 31;
/// Where the number of segments begins in [`Stroke::extent`].
pub(super) const SEGMENTS_BIT: u32 = 16;
/// So many workgroups are enough for all clusters that are seen; where these are fewer, several workgroups share each.
pub(super) const ENOUGH_GROUPS: u32 = 256;
/// So few clusters that several workgroups share each.
pub(super) const FEW_CLUSTERS: u32 = ENOUGH_GROUPS / 2;
/// Words of a line: `LINE_WORDS` of the shaders.
pub(super) const LINE_WORDS: usize = 3;
/// Threads of a workgroup that goes over clusters or lines.
pub(super) const WORKGROUP: u32 = 64;
/// Threads of a workgroup that counts kept lines, or enters lines into lists.
pub(super) const LINE_THREADS: u32 = 256;
/// Lines that each of them counts, and tallies with those of the others.
pub(super) const COUNTED_EACH: u32 = 4;
/// So many threads are enough for all lines; where these are fewer, several share each.
pub(super) const ENOUGH_THREADS: u32 = 1 << 18;
/// Most threads that share one.
pub(super) const MOST_THREADS_A_LINE: u32 = 32;
/// Threads of a workgroup that reserves places for lists.
pub(super) const STARTS_THREADS: u32 = 256;
/// A list that is longer than this part of all keeps a device waiting: from there on lists are shared out.
pub(super) const WAITED_FOR: u32 = 96;
/// So many workgroups keep it busy: lists that are longer than this part of all are then shared out.
pub(super) const ENOUGH_LISTS: u32 = 512;
/// Lists that are not longer than this are not.
pub(super) const LEAST_ALONE: u32 = 2048;
/// Times that a thread goes round its loops for each line of one opaque color, at most.
pub(super) const ROUNDS_A_LINE: u32 = 11;
/// Threads that cover a tile on a processor, where as many run in step: `LANES` of the shaders.
pub(super) const PROCESSOR_LANES: u32 = 8;
/// Most tiles that several workgroups cover: `SHARED_TILES` of the shaders.
pub(super) const SHARED_TILES: u32 = 256;
/// Most parts of their lists: `SHARED_PARTS` of the shaders.
pub(super) const SHARED_PARTS: u32 = 1024;
/// Side of a tile in pixels.
pub(super) const TILE_PX: u32 = 16;
/// Rows of samples of a pixel.
pub(super) const SAMPLE_ROWS: u32 = 16;
/// For each row of samples, two bits: which of the first four columns of the lattice it begins at. Each four
/// rows have all four, so that a border in any direction meets the columns evenly.
pub(super) const COLUMNS: u32 = columns([0, 2, 1, 3, 2, 0, 3, 1, 1, 3, 0, 2, 3, 1, 2, 0]);
/// Threads of a tile with layers: one for each row of samples.
pub(super) const TILE_THREADS: u32 = TILE_PX * SAMPLE_ROWS;

const fn columns(first: [u32; SAMPLE_ROWS as usize]) -> u32 {
    let (mut packed, mut row) = (0, 0);
    while row < first.len() {
        packed |= first[row] << (2 * row);
        row += 1;
    }
    packed
}

/// `Frame` of `frame.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct FrameParams {
    pub(super) center_high_m: [f32; 2],
    pub(super) center_low_m: [f32; 2],
    pub(super) reach_px: [f32; 2],
    pub(super) made_low_px: [f32; 2],
    pub(super) made_high_px: [f32; 2],
    pub(super) drawn_low_px: [f32; 2],
    pub(super) drawn_high_px: [f32; 2],
    pub(super) line_origin_px: [f32; 2],
    pub(super) level_px_per_m: f32,
    pub(super) level_px_a_px: f32,
    pub(super) px_a_level_px: f32,
    pub(super) px_per_m: f32,
    pub(super) radius_px: f32,
    pub(super) least_radius_px: f32,
    pub(super) most_radius_px: f32,
    pub(super) tolerance_px: f32,
    pub(super) clusters: u32,
    pub(super) styles: u32,
    pub(super) width_px: u32,
    pub(super) height_px: u32,
    pub(super) first_column: u32,
    pub(super) columns: u32,
    pub(super) first_row: u32,
    pub(super) rows: u32,
    pub(super) pixels_row: u32,
    pub(super) line_room: u32,
    pub(super) reference_room: u32,
    pub(super) color: u32,
    pub(super) background: u32,
    pub(super) most_step_m: f32,
    pub(super) has_ranks: u32,
    pub(super) first_line: u32,
    pub(super) keeps_lines: u32,
    pub(super) touched: u32,
    pub(super) kept_lines: u32,
    pub(super) threads_a_line: u32,
    pub(super) list_room: u32,
    pub(super) steps_a_px: f32,
    pub(super) px_a_step: f32,
    pub(super) padding: u32,
}

/// `Chunk` of `flatten.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct ChunkParams {
    pub(super) first_cluster: u32,
    pub(super) end_cluster: u32,
    pub(super) round: u32,
    pub(super) is_near: u32,
}

/// `Shift` of `shift.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct ShiftParams {
    pub(super) width_px: u32,
    pub(super) height_px: u32,
    pub(super) right_px: i32,
    pub(super) down_px: i32,
}

/// `Cluster` of `cluster.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Cluster {
    pub(super) origin_high_m: [f32; 2],
    pub(super) origin_low_m: [f32; 2],
    pub(super) low_m: [f32; 2],
    pub(super) high_m: [f32; 2],
    pub(super) widest_m: f32,
    pub(super) step_m: f32,
    pub(super) first_point: u32,
    pub(super) points: u32,
    pub(super) first_stroke: u32,
    pub(super) strokes: u32,
}

/// How control points are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Points {
    /// In steps of their cluster, two numbers of 16 bits in a word.
    Rounded = 0,
    /// Two floats.
    Exact = 1,
}

impl Points {
    /// Of one point.
    pub(super) fn words(self) -> usize {
        match self {
            Self::Rounded => 1,
            Self::Exact => 2,
        }
    }
}

/// `Stroke` of `stroke.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Stroke {
    pub(super) extent: u32,
    pub(super) rank: u32,
}

impl Stroke {
    pub(super) fn first_point(self) -> u32 {
        self.extent & 0xffff
    }

    pub(super) fn is_drawn(self) -> bool {
        (self.extent & !WHOLE_PATH) >> SEGMENTS_BIT > 0
    }

    /// Whether it is all of a path that is drawn.
    pub(super) fn is_whole_path(self) -> bool {
        self.extent & WHOLE_PATH != 0
    }

    /// Control points of a stroke that is drawn.
    pub(super) fn points(self) -> u32 {
        ((self.extent & !WHOLE_PATH) >> SEGMENTS_BIT) + 3
    }
}

/// `Style` of `style.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct PathStyle {
    pub(super) color: u32,
    pub(super) width_m: f32,
}

/// `Counters` of `frame.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Found {
    pub(super) rounded: u32,
    pub(super) exact: u32,
    pub(super) lines: u32,
    pub(super) references: u32,
    pub(super) drawn: u32,
    pub(super) longest: u32,
    pub(super) full_tiles: u32,
    pub(super) rounds: u32,
    pub(super) missing: u32,
    pub(super) shared_tiles: u32,
    pub(super) parts: u32,
    pub(super) longest_alone: u32,
    /// Of shaders that count: tests, atomics, words read and written, the low half of each first.
    pub(super) work: [u32; 8],
}

/// `Place` of `found.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Place {
    pub(super) seen: u32,
    pub(super) block: u32,
}

/// How many samples a pixel has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Samples {
    /// 64: strokes of half a pixel and more are within a few levels of the exact picture.
    Coarse = 0,
    /// 256, those of the exact picture: thinner strokes pass between fewer.
    Fine = 1,
}

impl Samples {
    /// Of one pixel in one row: `SAMPLES_A_ROW` of the shaders.
    pub(super) const fn a_row(self) -> u32 {
        match self {
            Self::Coarse => 4,
            Self::Fine => 16,
        }
    }

    /// Threads of a tile of one opaque color. So many workgroups run at a time as have room for the samples that they
    /// share: the more samples, the more threads for them.
    pub(super) fn cover_threads(self) -> u32 {
        match self {
            Self::Coarse => 128,
            Self::Fine => 256,
        }
    }
}

#[cfg(test)]
mod tests;
