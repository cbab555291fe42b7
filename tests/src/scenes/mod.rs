//! Scenes of the suite, named `topic/case`: one file per topic, each scene for one behavior.
//!
//! | module | scenes |
//! |---|---|
//! | `lines`, `shapes`, `widths` | straight lines, curves with caps and joins, stroke widths |
//! | `tiles`, `places`, `frames` | tile borders, distant origins and zoom, picture sizes |
//! | `order`, `translucency` | draw order and blending |
//! | `crowds` | many paths, and density |
//! | `suite`, `scene_case` | the list of all scenes, and the type of one |

mod crowds;
mod frames;
mod lines;
mod order;
mod places;
mod scene_case;
mod shapes;
mod suite;
mod tiles;
mod translucency;
mod widths;

pub use crowds::{long_curves, short_paths, site};
pub use scene_case::SceneCase;
pub use suite::all;
