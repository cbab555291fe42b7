//! The parts of the application, and how they start.

use std::sync::Arc;
use std::time::Duration;

use guideway_document::Document;

use crate::LaunchOptions;
use crate::backdrop::{FloorPlanLayer, SweptAreasLayer};
use crate::background::RepaintHandle;
use crate::canvas::Canvas;
use crate::display_settings::DisplaySettings;
use crate::editing::EDIT_WAIT;
use crate::export::Clipboard;
use crate::files::{FileWriter, LayerContext, OpenFiles};
use crate::panels::dialogs::Dialogs;
use crate::panels::{BottomPanel, FindingsPanel, PropertiesPanel, SideTabs};
use crate::render_queue::MethodSelection;
use crate::selection::{ExactEdit, Find};
use crate::services::AppServices;
use crate::tools::{OtherHit, Tools};

/// Longest time that the first frames wait for a picture. On a software renderer every frame
/// occupies both cores of an office laptop, which the first picture needs; until then the window
/// stays empty.
pub(crate) const FIRST_PICTURE_WAIT: Duration = Duration::from_millis(700);

/// The parts of the application.
pub(crate) struct App {
    pub(crate) context: LayerContext,
    pub(crate) files: OpenFiles,
    pub(crate) canvas: Canvas,
    pub(crate) tools: Tools,
    pub(crate) settings: DisplaySettings,
    pub(crate) methods: MethodSelection,
    pub(crate) floor_plan: FloorPlanLayer,
    pub(crate) swept_areas: SweptAreasLayer,
    pub(crate) find: Find,
    pub(crate) exact_edit: ExactEdit,
    pub(crate) findings: FindingsPanel,
    pub(crate) properties: PropertiesPanel,
    pub(crate) side: SideTabs,
    pub(crate) bottom: BottomPanel,
    /// The path under the pointer in another than the active file.
    pub(crate) other_hit: Option<OtherHit>,
    pub(crate) dialogs: Dialogs,
    pub(crate) writer: FileWriter,
    pub(crate) clipboard: Clipboard,
    /// The title that the window shows.
    pub(crate) title: String,
    /// Longest time that a frame waits for an edit.
    pub(crate) edit_wait: Duration,
    /// Time that the first frames still wait for a picture.
    pub(crate) first_picture_wait: Duration,
}

impl App {
    /// Starts to read the files of `options`. Background threads call `repaint`.
    pub(crate) fn new(
        repaint: RepaintHandle,
        services: Arc<dyn AppServices>,
        options: LaunchOptions,
    ) -> Self {
        let context = LayerContext { services, repaint };
        let mut app = Self {
            files: OpenFiles::new(context.clone()),
            context,
            canvas: Canvas::default(),
            tools: Tools::default(),
            settings: DisplaySettings::default(),
            methods: MethodSelection::new(options.method),
            floor_plan: FloorPlanLayer::default(),
            swept_areas: SweptAreasLayer::default(),
            find: Find::default(),
            exact_edit: ExactEdit::default(),
            findings: FindingsPanel::default(),
            properties: PropertiesPanel::default(),
            side: SideTabs::default(),
            bottom: BottomPanel::default(),
            other_hit: None,
            dialogs: Dialogs::default(),
            writer: FileWriter::default(),
            clipboard: Clipboard::default(),
            title: String::new(),
            edit_wait: EDIT_WAIT,
            first_picture_wait: Duration::ZERO,
        };
        let scene_options = app.settings.scene_options();
        for file in options.files {
            app.files
                .open(file, app.methods.name(), scene_options.clone());
        }
        let LayerContext { services, repaint } = &app.context;
        app.floor_plan.set(&options.floor_plan, services, repaint);
        app
    }

    /// Returns `true` if everything shows the last state.
    pub(crate) fn is_settled(&self) -> bool {
        self.files.is_settled()
    }

    /// The document that is edited, unless it is not loaded or an edit has it.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.files.document()
    }
}
