//! Lists the scenes of all topics.

use super::scene_case::SceneCase;
use super::{crowds, frames, lines, order, places, shapes, tiles, translucency, widths};

/// Every scene of the suite.
pub fn all() -> Vec<SceneCase> {
    [
        lines::cases(),
        shapes::cases(),
        widths::cases(),
        tiles::cases(),
        order::cases(),
        translucency::cases(),
        places::cases(),
        frames::cases(),
        crowds::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
