//! The input of the tools in a file.

use guideway_document::decorations::MarkedKinds;
use guideway_scene::View;

use super::layer::Layer;
use crate::display_settings::DisplaySettings;
use crate::tools::ToolContext;

/// The input of the tools in one file, or without one, in a view with `px_per_point` pixels per
/// point of the screen.
pub(crate) fn layer_tool_context<'a>(
    layer: Option<&'a Layer>,
    view: View,
    settings: &DisplaySettings,
    px_per_point: f64,
) -> ToolContext<'a> {
    let widths = layer.map(|layer| layer.widths).unwrap_or_default();
    let shown = layer.map_or_else(MarkedKinds::default, |layer| layer.look.kinds());
    let grid_step_m = || settings.grid_step_m(&view, px_per_point);
    ToolContext {
        view,
        document: layer.and_then(Layer::document),
        line_rule: settings.line_rule(widths, px_per_point),
        picks: MarkedKinds {
            paths: shown.paths,
            nodes: shown.nodes && settings.has_symbols,
            stations: shown.stations && settings.has_symbols,
        },
        grid_step_m: settings.has_grid.then(grid_step_m),
    }
}
