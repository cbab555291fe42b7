//! Backdrop: everything below the paths of the topmost scene.
//!
//! | module | input | output |
//! |---|---|---|
//! | `floor_plan` | a layout, an image or a map | its pixels in a strip, its elements of a page |
//! | `image` | an image and its placement | resampled pixels |
//! | `map_colors` | the cells of a map | the pixels of an image |
//! | `swept` | paths and a vehicle | translucent areas |
//! | `layers` | all of the above, a grid, other scenes | one opaque frame per strip |

mod floor_plan;
mod image;
mod layers;
mod map_colors;
mod mip_levels;
mod swept;

pub use floor_plan::{FloorPlan, FloorPlanKind, PreparedFloorPlan};
pub use image::Image;
pub(crate) use layers::VisibleBackdrop;
pub use layers::{Backdrop, OtherScene};
pub use swept::{SweptAreas, SweptReport, draw_swept_areas};
