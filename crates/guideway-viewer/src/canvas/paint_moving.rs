//! Paints the outline of a selection that is being moved: its triangles are made once per view, and
//! drawn where the selection is and where it goes. To make them anew would take most of a frame.

use std::sync::Arc;

use eframe::egui::epaint::Tessellator;
use eframe::egui::{Mesh, Painter, Shape, Stroke, Vec2};

use super::paint_gesture::outline_shapes;
use super::screen::Screen;
use crate::editing::{MovingOutline, OverlayContent};

/// Paints the outline of the overlay of the present view, and moved by `by`, in these strokes.
/// Returns `false` if its triangles are those of another place of the canvas.
pub(super) fn paint_moving(
    painter: &Painter,
    screen: Screen,
    overlay: &OverlayContent,
    [selected, moved]: [Stroke; 2],
    by: Vec2,
) -> bool {
    let outline = overlay.moving.get_or_init(|| MovingOutline {
        corner: screen.rect.min,
        selected: Arc::new(triangles(painter, screen, overlay, selected)),
        moved: triangles(painter, screen, overlay, moved),
    });
    if outline.corner != screen.rect.min {
        return false;
    }
    painter.add(Shape::Mesh(Arc::clone(&outline.selected)));
    let mut moved = outline.moved.clone();
    moved.translate(by);
    painter.add(moved);
    true
}

fn triangles(painter: &Painter, screen: Screen, overlay: &OverlayContent, stroke: Stroke) -> Mesh {
    let options = painter
        .ctx()
        .options(|options| options.tessellation_options);
    // Lines need neither letters nor discs of the texture.
    let mut tessellator = Tessellator::new(screen.px_per_point, options, [1, 1], Vec::new());
    let mut mesh = Mesh::default();
    for shape in outline_shapes(&overlay.selection, stroke, |pixel| screen.point(pixel)) {
        tessellator.tessellate_shape(shape, &mut mesh);
    }
    mesh
}
