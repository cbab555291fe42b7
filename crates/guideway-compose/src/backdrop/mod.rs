//! Backdrop: everything below the paths of the topmost scene.
//!
//! | module | input | output |
//! |---|---|---|
//! | `floor_plan` | a layout or an image | its pixels in a strip, its SVG elements |
//! | `image` | a PNG file and its placement | resampled pixels |
//! | `swept` | paths and a vehicle | translucent areas |
//! | `layers` | all of the above, a grid, other scenes | one opaque frame per strip |

mod floor_plan;
mod image;
mod layers;
mod mip_levels;
mod swept;

pub use floor_plan::{FloorPlan, PreparedFloorPlan};
pub use image::{Image, ImagePlacement};
pub use layers::Backdrop;
pub(crate) use layers::VisibleBackdrop;
pub use swept::{SweptAreas, SweptReport, draw_swept_areas};
