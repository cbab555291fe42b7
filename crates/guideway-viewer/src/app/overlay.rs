use std::time::Instant;

use guideway_document::Document;
use guideway_document::marks::{MarkOptions, Marks, Outline, marks, outline};
use guideway_render::{View, elapsed_ms};

/// Longer than this, marks are not made anew for every frame of a movement.
const SWIFT_MS: f64 = 6.0;

/// What is drawn over the picture of one document, kept from frame to frame.
#[derive(Default)]
pub(crate) struct Overlay {
    made: Option<Made>,
}

/// Marks and outlines, and what they were made of.
pub(crate) struct Made {
    pub(crate) view: View,
    pub(crate) marks: Marks,
    pub(crate) selection: Outline,
    options: MarkOptions,
    revision: u64,
    made_ms: f64,
}

impl Overlay {
    /// The overlay of a view. While the view moves it may be that of a view before, if it takes long to make.
    pub(crate) fn of(
        &mut self,
        document: &Document,
        view: &View,
        options: &MarkOptions,
        is_moving: bool,
    ) -> &Made {
        let is_usable = |made: &Made| {
            let is_alike = made.revision == document.revision() && made.options == *options;
            is_alike && (made.view == *view || (is_moving && made.made_ms > SWIFT_MS))
        };
        let made = match self.made.take() {
            Some(made) if is_usable(&made) => made,
            _ => Made::new(document, view, options),
        };
        self.made.insert(made)
    }

    /// The last one.
    pub(crate) fn last(&self) -> Option<&Made> {
        self.made.as_ref()
    }
}

impl Made {
    fn new(document: &Document, view: &View, options: &MarkOptions) -> Self {
        let started = Instant::now();
        let marks = marks(document, view, options);
        let selection = outline(document, document.selection(), view);
        Self {
            view: *view,
            marks,
            selection,
            options: *options,
            revision: document.revision(),
            made_ms: elapsed_ms(started),
        }
    }
}
