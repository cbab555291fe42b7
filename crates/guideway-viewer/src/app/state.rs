//! The parts of the application, and how they start.

use std::sync::Arc;
use std::time::Duration;

use guideway_document::{Document, Group};

use super::open_project::{OpenProject, ProjectReader};
use super::waiting::WaitingInput;
use crate::action::TypeRename;
use crate::backdrop::{FloorPlanLayer, PlanEditor, SweptAreasLayer};
use crate::background::RepaintHandle;
use crate::canvas::Canvas;
use crate::command::ContextPlace;
use crate::display_settings::DisplaySettings;
use crate::editing::{EDIT_WAIT, EditOutcome};
use crate::export::Clipboard;
use crate::files::{FileWriter, LayerContext, OpenFiles};
use crate::language::{Language, set_language};
use crate::panels::dialogs::{Dialogs, Question};
use crate::panels::{
    BottomPanel, FindingsPanel, NewEdgesPanel, PropertiesPanel, SideTabs, StillBars, Welcome,
};
use crate::preferences::{PreferencesFile, WindowPlace};
use crate::render_queue::MethodSelection;
use crate::selection::{CopiedElements, ExactEdit, Find};
use crate::services::AppServices;
use crate::tools::{OtherHit, Tools};

/// Longest time that the first frames wait for a picture. On a software renderer every frame
/// occupies both cores of an office laptop, which the first picture needs; until then the window
/// stays empty.
pub(crate) const FIRST_PICTURE_WAIT: Duration = Duration::from_millis(700);
/// Longest part of it before the window is on the screen.
pub(super) const FIRST_FRAME_WAIT: Duration = Duration::from_millis(300);

/// The parts of the application.
pub(crate) struct App {
    pub(crate) context: LayerContext,
    pub(crate) files: OpenFiles,
    pub(crate) canvas: Canvas,
    pub(crate) tools: Tools,
    pub(crate) settings: DisplaySettings,
    pub(crate) methods: MethodSelection,
    pub(crate) floor_plan: FloorPlanLayer,
    pub(crate) plan_editor: PlanEditor,
    pub(crate) swept_areas: SweptAreasLayer,
    pub(crate) find: Find,
    pub(crate) exact_edit: ExactEdit,
    pub(crate) findings: FindingsPanel,
    pub(crate) properties: PropertiesPanel,
    pub(crate) new_edges: NewEdgesPanel,
    /// Elements to paste.
    pub(crate) copied: Option<CopiedElements>,
    pub(crate) side: SideTabs,
    pub(crate) bars: StillBars,
    pub(crate) bottom: BottomPanel,
    /// The path under the pointer in another than the active file.
    pub(crate) other_hit: Option<OtherHit>,
    /// The level or vehicle type under the pointer in a list, with the index of its file.
    pub(super) hovered_group: Option<(usize, Group)>,
    pub(crate) dialogs: Dialogs,
    pub(crate) welcome: Welcome,
    pub(super) project: OpenProject,
    pub(super) project_reader: ProjectReader,
    /// The element under the open context menu.
    pub(super) context_place: ContextPlace,
    /// The graphics adapter that shows the window; empty without a window.
    pub(crate) adapter: String,
    pub(crate) writer: FileWriter,
    /// The question of the write in progress, asked if its file is there.
    pub(super) question_of_write: Option<Question>,
    /// Renames of vehicle types in progress.
    pub(super) renames: Vec<(EditOutcome, TypeRename)>,
    pub(super) waiting: WaitingInput,
    /// True if parts of the window may show the input of the frame in later frames only.
    pub(crate) changes_late: bool,
    /// True if a text field had the focus at the end of the last frame.
    pub(super) had_field: bool,
    /// True until the walk over the events of a frame reaches the Escape that left a field.
    pub(super) has_field_until_escape: bool,
    pub(crate) clipboard: Clipboard,
    pub(super) preferences_file: PreferencesFile,
    pub(crate) window_place: WindowPlace,
    /// Width of the side panel, in points.
    pub(super) panel_width: f32,
    /// The language of the desktop.
    pub(super) language: Language,
    /// The title that the window shows.
    pub(crate) title: String,
    /// Longest time that a frame waits for an edit.
    pub(crate) edit_wait: Duration,
    /// Time that the first frames still wait for a picture.
    pub(crate) first_picture_wait: Duration,
    /// True if a crowd of paths is shown as density until the user decides.
    pub(crate) shows_crowds: bool,
}

impl App {
    /// An application without files. Background threads call `repaint`.
    pub(crate) fn new(
        repaint: RepaintHandle,
        services: Arc<dyn AppServices>,
        method: Option<String>,
    ) -> Self {
        let context = LayerContext::new(services, repaint);
        let (preferences_file, notice) = PreferencesFile::load(context.services.state_folder());
        let preferences = preferences_file.saved().clone();
        let locale = context.services.locale().unwrap_or_default();
        let language = Language::of_locale(&locale);
        set_language(preferences.look.language.unwrap_or(language));
        let mut app = Self {
            files: OpenFiles::new(context.clone()),
            context,
            canvas: Canvas::default(),
            tools: Tools::default(),
            settings: preferences.look,
            methods: MethodSelection::new(method),
            floor_plan: FloorPlanLayer::default(),
            plan_editor: PlanEditor::default(),
            swept_areas: SweptAreasLayer::default(),
            find: Find::default(),
            exact_edit: ExactEdit::default(),
            findings: FindingsPanel::default(),
            properties: PropertiesPanel::default(),
            new_edges: NewEdgesPanel::default(),
            copied: None,
            side: SideTabs::new(preferences.side_panel),
            bars: StillBars::default(),
            bottom: BottomPanel::default(),
            other_hit: None,
            hovered_group: None,
            dialogs: Dialogs::default(),
            welcome: Welcome::default(),
            project: OpenProject::default(),
            project_reader: ProjectReader::default(),
            context_place: ContextPlace::default(),
            adapter: String::new(),
            writer: FileWriter::default(),
            question_of_write: None,
            renames: Vec::new(),
            waiting: WaitingInput::default(),
            changes_late: false,
            had_field: false,
            has_field_until_escape: false,
            clipboard: Clipboard::default(),
            preferences_file,
            window_place: preferences.window,
            panel_width: preferences.panel_width,
            language,
            title: String::new(),
            edit_wait: EDIT_WAIT,
            first_picture_wait: Duration::ZERO,
            shows_crowds: true,
        };
        if let Some(notice) = notice {
            app.dialogs.notices.add(notice);
        }
        app
    }

    /// Returns `true` if everything shows the last state.
    pub(crate) fn is_settled(&self) -> bool {
        self.files.is_settled() && !self.project_reader.is_busy()
    }

    /// The document that is edited, unless it is not loaded or an edit has it.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.files.document()
    }
}
