//! The interface to the shaders: constants, uniforms and sources. Tests compare it with the WGSL.

use bytemuck::{Pod, Zeroable};

use guideway_gpu::device::Source;

/// Threads per workgroup of the shaders that process one item per thread.
pub(super) const WORKGROUP: u32 = 64;
/// Threads per workgroup of the scan; each thread has two cells of a block.
pub const SCAN_THREADS: u32 = 256;
/// Side of a tile, the pixels of one workgroup.
pub const TILE_PX: u32 = 8;
/// Half the width of a smoothed edge, in pixels.
pub const HALF_EDGE_PX: f32 = 0.75;

/// The open end of a range: all parts of an item's work, or all lines of a cell.
pub(super) const ALL: u32 = u32::MAX;

/// Bytes of a line on the device: start and end.
pub(super) const LINE_BYTES: u64 = size_of::<[f32; 4]>() as u64;

/// `Items` of `items.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Items {
    pub(super) first: u32,
    pub(super) end: u32,
    pub(super) first_part: u32,
    pub(super) end_part: u32,
}

/// `Grid` of `cells.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct GridParams {
    pub(super) origin_m: [f32; 2],
    pub(super) cells_per_m: [f32; 2],
    pub(super) reach_m: f32,
    pub(super) padding: u32,
}

/// `View` of `view.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct ViewParams {
    pub(super) center_m: [f32; 2],
    pub(super) half_size_px: [f32; 2],
    pub(super) box_low_m: [f32; 2],
    pub(super) box_high_m: [f32; 2],
    pub(super) excess_m: f32,
    pub(super) m_per_px: f32,
    pub(super) px_per_m: f32,
    pub(super) radius_m: f32,
    pub(super) color: u32,
    pub(super) background: u32,
    pub(super) width_px: u32,
    pub(super) first_row: u32,
    pub(super) rows: u32,
    pub(super) first_tile: u32,
    pub(super) end_tile: u32,
    pub(super) first_cell_row: u32,
    pub(super) end_cell_row: u32,
    pub(super) first_line: u32,
    pub(super) end_line: u32,
    pub(super) is_first_pass: u32,
    pub(super) is_last_pass: u32,
    pub(super) padding: u32,
}

macro_rules! wgsl {
    ($($file:literal),+) => {
        std::borrow::Cow::Borrowed(concat!(
            $(include_str!(concat!("shaders/", $file, ".wgsl"))),+
        ))
    };
}

pub(super) const SAMPLE: Source = Source {
    name: "sample",
    wgsl: wgsl!("items", "curve", "sample"),
    bindings: &["items", "points_m", "first_points", "line_count", "lines_m"],
};

pub(super) const COUNT: Source = Source {
    name: "count",
    wgsl: wgsl!("items", "cells", "cells_of_line", "count"),
    bindings: &["items", "grid", "lines_m", "counts"],
};

pub(super) const PREFIX_NAIVE: Source = Source {
    name: "naive prefix sum",
    wgsl: wgsl!("items", "prefix_naive"),
    bindings: &["items", "counts", "starts"],
};

/// Scans every block of counts on its own.
pub const SCAN_BLOCKS: Source = Source {
    name: "scan of blocks",
    wgsl: wgsl!("scan", "scan_blocks"),
    bindings: &["counts", "starts", "block_sums"],
};

/// Scans the sums of the blocks.
pub const SCAN_SUMS: Source = Source {
    name: "scan of sums",
    wgsl: wgsl!("scan", "scan_sums"),
    bindings: &["block_sums"],
};

/// Adds to every block the sum of those before.
pub const ADD_SUMS: Source = Source {
    name: "add sums",
    wgsl: wgsl!("add_sums"),
    bindings: &["starts", "block_sums"],
};

pub(super) const BIN: Source = Source {
    name: "bin",
    wgsl: wgsl!("items", "cells", "cells_of_line", "bin"),
    bindings: &["items", "grid", "lines_m", "starts", "filled", "lists_m"],
};

/// Coverage from the distance to the nearest line.
pub(super) const PIXELS_NEAREST: Source = Source {
    name: "pixels",
    wgsl: wgsl!("view", "cells", "line", "nearest", "blend", "pixels"),
    bindings: &[
        "view", "grid", "starts", "counts", "lists_m", "pixels", "work",
    ],
};

/// Coverage from 32 samples per pixel.
pub(super) const PIXELS_SAMPLES: Source = Source {
    wgsl: wgsl!("view", "cells", "line", "samples", "blend", "pixels"),
    ..PIXELS_NEAREST
};

#[cfg(test)]
mod tests;
