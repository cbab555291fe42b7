//! The areas that a vehicle sweeps along the selected paths, drawn beside the window.

use std::sync::Arc;

use eframe::egui::Context;
use guideway_document::Document;
use guideway_envelope::{EnvelopeSource, SourceError};
use guideway_scene::View;

use super::App;
use crate::work::beside::Beside;

/// Most paths whose areas are shown where none is selected.
const MOST_UNSELECTED: usize = 20_000;

/// What is shown of areas, and how.
pub(crate) struct Swept {
    pub(crate) is_shown: bool,
    /// The vehicle, as a person writes it.
    pub(crate) vehicle: String,
    pub(crate) drawn: Beside<Of>,
}

/// What areas are of.
#[derive(Clone, PartialEq)]
pub(crate) struct Of {
    vehicle: EnvelopeSource,
    layer: usize,
    revision: u64,
}

impl Default for Swept {
    fn default() -> Self {
        Self {
            is_shown: false,
            vehicle: "2x1.2".to_owned(),
            drawn: Beside::default(),
        }
    }
}

impl Swept {
    /// The vehicle of the text field.
    ///
    /// # Errors
    /// When the text is no vehicle.
    pub(crate) fn vehicle(&self) -> Result<EnvelopeSource, SourceError> {
        self.vehicle.trim().parse()
    }
}

impl App {
    /// Has the areas in a view drawn, unless they are there or others still are being drawn.
    pub(crate) fn ask_for_swept(&mut self, view: &View) {
        if !self.swept.is_shown {
            self.swept.drawn.clear();
            return;
        }
        let Some(document) = self
            .layers
            .get(self.active)
            .and_then(|l| l.document.as_deref())
        else {
            return;
        };
        let vehicle = match self.swept.vehicle() {
            Ok(vehicle) => vehicle,
            Err(error) => {
                let text = &self.swept.vehicle;
                return self
                    .swept
                    .drawn
                    .fail(format!("`{text}` is not a vehicle: {error}"));
            }
        };
        let of = Of {
            vehicle,
            layer: self.active,
            revision: document.revision(),
        };
        if !self.swept.drawn.needs(&of, view) {
            return;
        }
        let Some(rows) = swept_rows(document) else {
            let why =
                format!("select at least one of these paths: they are more than {MOST_UNSELECTED}");
            self.swept.drawn.refuse(of, *view, why);
            return;
        };
        let (services, layout) = (Arc::clone(&self.services), document.scene().shared_layout());
        let view = *view;
        let draw = move || services.render_swept_areas(&layout, &rows, vehicle, &view);
        self.swept.drawn.ask(of, view, &self.wake, draw);
    }

    /// Takes the areas that were drawn.
    pub(super) fn poll_swept(&mut self, ctx: &Context) {
        self.swept.drawn.poll(ctx, "swept areas");
    }
}

/// The paths that are meant: those that are selected, or all if they are not too many.
pub(super) fn swept_rows(document: &Document) -> Option<Vec<u32>> {
    if !document.selection().is_empty() {
        return Some(document.selection().iter().collect());
    }
    let all = document.scene().draw_order();
    (all.len() <= MOST_UNSELECTED).then(|| all.to_vec())
}
