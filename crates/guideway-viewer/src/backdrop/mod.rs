//! The pictures below the layouts: floor plan and swept areas, each rendered in the background.

mod floor_plan_layer;
mod swept_areas_layer;

pub(crate) use floor_plan_layer::FloorPlanLayer;
pub(crate) use swept_areas_layer::{ActiveDocument, SweptAreasLayer};
