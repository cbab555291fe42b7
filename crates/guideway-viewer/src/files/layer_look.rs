//! The look of one open file: which of its elements are shown, and how.

use guideway_document::Document;
use guideway_document::decorations::{MarkOptions, MarkedKinds};
use guideway_scene::{Rgba, SceneOptions};

/// The look of one open file, beside the display settings of all.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LayerLook {
    /// Opacity of paths and marks, from 0 to 1.
    pub(crate) opacity: f32,
    /// Color of paths without a color of their own; `None` takes that of the display settings.
    pub(crate) color: Option<Rgba>,
    pub(crate) has_paths: bool,
    pub(crate) has_nodes: bool,
    pub(crate) has_stations: bool,
    pub(crate) has_names: bool,
    pub(crate) has_arrows: bool,
}

impl Default for LayerLook {
    fn default() -> Self {
        Self {
            opacity: 1.0,
            color: None,
            has_paths: true,
            has_nodes: true,
            has_stations: true,
            has_names: true,
            has_arrows: true,
        }
    }
}

impl LayerLook {
    /// The marks of this file among those that the display settings show.
    pub(crate) fn mark_options(
        &self,
        all: MarkOptions,
        document: Option<&Document>,
    ) -> MarkOptions {
        let has_arrows =
            self.has_arrows && !document.is_some_and(|document| document.layout().is_drawing());
        MarkOptions {
            arrows: all.arrows && has_arrows,
            labels: all.labels.filter(|_| self.has_names),
            of: self.kinds(),
            ..all
        }
    }

    /// The kinds of elements that are shown.
    pub(crate) fn kinds(&self) -> MarkedKinds {
        MarkedKinds {
            paths: self.has_paths,
            nodes: self.has_nodes,
            stations: self.has_stations,
        }
    }

    /// The scene options of this file among those of the display settings.
    pub(crate) fn scene_options(&self, all: &SceneOptions) -> SceneOptions {
        SceneOptions {
            color: self.color.or(all.color),
            ..all.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::LineRule;

    use super::*;
    use crate::display_settings::DisplaySettings;
    use crate::tests::services::lanes;

    #[test]
    fn arrows_are_left_out_where_lines_have_no_direction() {
        let has_arrows = |format: &str, has_nodes: bool| {
            let mut layout = lanes(1);
            layout.provenance.format = format.to_owned();
            if !has_nodes {
                layout.retain_nodes_and_stations(&[], &[]);
            }
            let document = Document::new(layout.into(), &Default::default()).unwrap();
            let all = DisplaySettings::default().mark_options(LineRule::default(), 1.0);
            let look = LayerLook::default();
            look.mark_options(all, Some(&document)).arrows
        };
        assert!(has_arrows("LIF", true) && has_arrows("LIF", false));
        assert!(has_arrows("DXF", true) && !has_arrows("DXF", false));
    }
}
