//! A chunk: the lines of some paths, sorted by grid cell, in buffers that fit one binding.

use guideway_gpu::device::{DeviceBuffer, Reservation};

use crate::count_table::CountTable;

/// Buffers of the lines of some paths, sorted into the cells of the grid.
pub(super) struct Chunk {
    /// Index of the first line of each cell in `lists_m`.
    pub(super) starts: DeviceBuffer,
    /// Lines per cell.
    pub(super) counts: DeviceBuffer,
    /// Lines, cell by cell.
    pub(super) lists_m: DeviceBuffer,
    /// The counts on the host, from which the host estimates the work of a picture.
    pub(super) table: CountTable,
    /// Counts the memory of `table` against the budget.
    pub(super) _table_reservation: Reservation,
}
