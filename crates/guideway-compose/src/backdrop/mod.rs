//! Backdrop: everything below the paths of the topmost scene.
//!
//! | module | input | output |
//! |---|---|---|
//! | `kind` | a file | whether it is a layout, an image or a map |
//! | `floor_plan` | a layout, an image or a map | its pixels in a strip, its SVG elements |
//! | `image` | an image and its placement | resampled pixels |
//! | `map_colors` | the cells of a map | the pixels of an image |
//! | `swept` | paths and a vehicle | translucent areas |
//! | `layers` | all of the above, a grid, other scenes | one opaque frame per strip |

mod floor_plan;
mod image;
mod kind;
mod layers;
mod map_colors;
mod mip_levels;
mod swept;

pub use floor_plan::{FloorPlan, PreparedFloorPlan};
pub use image::Image;
pub use kind::FloorPlanKind;
pub use layers::Backdrop;
pub(crate) use layers::VisibleBackdrop;
pub use swept::{SweptAreas, SweptReport, draw_swept_areas};
