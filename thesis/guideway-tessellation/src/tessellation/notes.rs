//! Notes of the report: the differences between the picture and the requested style.

use guideway_scene::{Style, View};

use super::plan::Plan;

/// Lists the differences. `has_gaps` states that the device loses parts of antialiased lines.
pub(super) fn notes(plan: &Plan, view: &View, style: &Style, has_gaps: bool) -> Vec<String> {
    let mut notes = Vec::new();
    let px_per_m = view.px_per_m();
    if !plan.widths.are_one_pixel(&style.line_rule, px_per_m) {
        notes.push("All lines are one pixel wide; the method ignores widths.".to_owned());
    }
    // derived: the control points of a straight segment span three times its length.
    if plan.smallest_m * px_per_m < 3.0 {
        notes.push("Paths shorter than a pixel may be missing.".to_owned());
    }
    if has_gaps {
        notes.push(
            "Antialiased lines have small gaps, because the device is a software rasterizer."
                .to_owned(),
        );
    }
    notes
}
