//! The pictures below the layouts: floor plan and swept areas, each rendered in the background.

mod floor_plan_layer;
mod plan_editor;
mod plan_placement;
mod swept_areas_layer;

pub(crate) use floor_plan_layer::FloorPlanLayer;
pub(crate) use plan_editor::{PlanEditor, PlanTask};
pub(crate) use plan_placement::{DRAWING_UNITS, PlanPlacement, PlanSize};
pub(crate) use swept_areas_layer::{ActiveDocument, SweptAreasLayer};
