//! The areas that a vehicle sweeps along the selected paths, rendered in the background.

use std::sync::Arc;

use eframe::egui::{Context, TextureHandle};
use guideway_document::Document;
use guideway_envelope::{EnvelopeSource, SourceError};
use guideway_scene::View;

use crate::background::RepaintHandle;
use crate::language::say;
use crate::render_queue::BackgroundPicture;
use crate::services::{AppServices, SweptAreas};

/// Without a selection, areas of at most this many paths are shown: the areas of a large site
/// take far longer than its paths.
const MAX_UNSELECTED_PATHS: usize = 20_000;

/// Vehicle and visibility of swept areas, and their last picture.
pub(crate) struct SweptAreasLayer {
    pub(crate) is_visible: bool,
    /// Text of the vehicle: see [`EnvelopeSource`].
    pub(crate) vehicle_text: String,
    picture: BackgroundPicture<Content>,
}

/// The content of a picture.
#[derive(Clone, PartialEq)]
struct Content {
    vehicle: EnvelopeSource,
    file_index: usize,
    revision: u64,
}

/// The document whose areas are shown.
pub(crate) struct ActiveDocument<'a> {
    pub(crate) file_index: usize,
    pub(crate) document: &'a Document,
}

impl Default for SweptAreasLayer {
    fn default() -> Self {
        Self {
            is_visible: false,
            vehicle_text: "2x1.2".to_owned(),
            picture: BackgroundPicture::default(),
        }
    }
}

impl SweptAreasLayer {
    /// The vehicle of the text.
    pub(crate) fn vehicle(&self) -> Result<EnvelopeSource, SourceError> {
        self.vehicle_text.trim().parse()
    }

    /// The visible areas, for an export.
    pub(crate) fn areas(&self, document: &Document) -> Option<SweptAreas> {
        if !self.is_visible {
            return None;
        }
        Some(SweptAreas {
            vehicle: self.vehicle().ok()?,
            rows: swept_paths(document)?,
        })
    }

    /// Why there is no picture.
    pub(crate) fn error(&self) -> Option<&str> {
        self.picture.error()
    }

    /// The last picture and its view.
    pub(crate) fn shown(&self) -> Option<(&TextureHandle, &View)> {
        self.picture.shown()
    }

    /// Drops the picture, which may show a replaced document.
    pub(crate) fn clear(&mut self) {
        self.picture.clear();
    }

    /// Takes a finished picture.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        self.picture.poll(ctx, "swept areas");
    }

    /// Requests the picture of a view, unless it is there or in progress.
    pub(crate) fn request(
        &mut self,
        active: Option<ActiveDocument<'_>>,
        view: &View,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) {
        if !self.is_visible {
            self.picture.clear();
            return;
        }
        let Some(active) = active else {
            return;
        };
        let vehicle = match self.vehicle() {
            Ok(vehicle) => vehicle,
            Err(error) => {
                let error = say!(
                    "`{text}` is not a vehicle: {error}",
                    text = self.vehicle_text,
                    error
                );
                return self.picture.fail(None, *view, error);
            }
        };
        let content = Content {
            vehicle,
            file_index: active.file_index,
            revision: active.document.revision(),
        };
        if !self.picture.needs(&content, view) {
            return;
        }
        let Some(rows) = swept_paths(active.document) else {
            let error = say!(
                "more than {most} paths: select the paths whose areas to show",
                most = MAX_UNSELECTED_PATHS
            );
            return self.picture.fail(Some(content), *view, error);
        };
        let services = Arc::clone(services);
        let (layout, view) = (active.document.scene().shared_layout(), *view);
        let render = move || services.render_swept_areas(&layout, &rows, vehicle, &view);
        self.picture.start(content, view, repaint, render);
    }
}

/// The selected paths, or all shown paths if these are not too many.
fn swept_paths(document: &Document) -> Option<Vec<u32>> {
    if !document.selection().is_empty() {
        return Some(document.selection().iter().collect());
    }
    let all = document.scene().draw_order();
    (all.len() <= MAX_UNSELECTED_PATHS).then(|| all.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn areas_are_those_of_the_selection_or_of_all_paths() {
        let mut document = Document::new(lanes(3).into(), &Default::default()).unwrap();
        let mut layer = SweptAreasLayer::default();
        assert_eq!(layer.areas(&document), None);
        layer.is_visible = true;
        assert_eq!(layer.areas(&document).unwrap().rows, [0, 1, 2]);
        document.select([1].into_iter().collect(), Default::default());
        assert_eq!(layer.areas(&document).unwrap().rows, [1]);
        layer.vehicle_text = "a truck".into();
        assert_eq!(layer.areas(&document), None);
    }
}
