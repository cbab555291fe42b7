//! Bin stage: finds the visible clusters and lists them per tile. Clusters that span many tiles are
//! listed by their lines instead.

pub(super) mod cull;
pub(super) mod line_lists;
#[cfg(test)]
mod tests;
pub(super) mod tile_lists;
