//! Decorations of the picture, for the window and for exports.

use guideway_document::decorations::{DecorationStyle, MarkOptions, grid, marks, scale_bar};
use guideway_scene::{DrawList, View};

use super::App;

impl App {
    /// Colors and sizes of decorations on this screen.
    pub(crate) fn decoration_style(&self) -> DecorationStyle {
        self.look.decoration_style(self.px_per_point)
    }

    /// Selection of marks.
    pub(crate) fn mark_options(&self) -> MarkOptions {
        let look = &self.look;
        let label_size = self.decoration_style().label_size();
        MarkOptions {
            px_per_point: self.px_per_point,
            arrows: look.has_arrows.then(|| look.line_rule()),
            symbols: look.has_symbols,
            labels: look.has_labels.then_some(label_size),
        }
    }

    /// The grid of a view, to draw below the paths; empty if it is switched off.
    pub(crate) fn grid_list(&self, view: &View) -> DrawList {
        if self.look.has_grid {
            grid(view, &self.decoration_style())
        } else {
            DrawList::default()
        }
    }

    /// Marks of the active layer and the scale bar, to draw over the paths.
    pub(super) fn marks_list(&self, view: &View) -> DrawList {
        let mut list = DrawList::default();
        let style = self.decoration_style();
        let layer = self.layers.get(self.active).filter(|l| l.is_visible);
        if let Some(document) = layer.and_then(|layer| layer.document.as_ref()) {
            let marks = marks(document, view, &self.mark_options());
            list = marks.draw(&style, |at_px| at_px);
        }
        list.append(scale_bar(view, &style));
        list
    }
}
