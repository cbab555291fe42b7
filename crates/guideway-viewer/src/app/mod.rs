//! What the viewer knows and does, whatever window shows it.

pub(crate) mod command;
mod drawing;
mod export;
mod files;
pub(crate) mod floor;
mod gesture;
pub(crate) mod layer;
pub(crate) mod look;
mod overlay;
mod perform;
pub(crate) mod recent;
pub(crate) mod sheets;
pub(crate) mod swept;

use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use eframe::egui::{ColorImage, Context, Pos2, ViewportCommand};
use guideway_document::{Document, Element, Hit};

pub(crate) use self::drawing::Drawing;
pub(crate) use self::files::{Prompt, PromptKind};
use self::floor::Floor;
pub(crate) use self::gesture::{Gesture, MOST_HOVERED, REACH_PX, Tool};
pub(crate) use self::layer::{Layer, LayerNews, Work};
pub(crate) use self::look::Look;
pub(crate) use self::perform::leave_field;
use self::recent::Recent;
use self::swept::Swept;
use crate::LaunchOptions;
use crate::camera::Camera;
use crate::services::{AppServices, LoadStage};
use crate::work::Wake;
use crate::work::task::Task;
use crate::work::watcher::Watcher;
use guideway_layout::UserError;

/// The viewer.
pub(crate) struct App {
    pub(crate) services: Arc<dyn AppServices>,
    pub(crate) wake: Wake,
    pub(crate) layers: Vec<Layer>,
    /// The layer that is edited.
    pub(crate) active: usize,
    pub(crate) camera: Camera,
    pub(crate) look: Look,
    pub(crate) drawing: Drawing,
    pub(crate) tool: Tool,
    pub(crate) gesture: Gesture,
    /// Upper left corner of the picture in the window.
    pub(crate) canvas_min: Pos2,
    /// Pixels of the screen that make a point of the window.
    pub(crate) px_per_point: f64,
    /// Where the pointer is in the picture.
    pub(crate) pointer_px: Option<guideway_spline::Point<f64>>,
    /// What was last seen under the pointer.
    hover: Option<Hit>,
    pub(crate) prompt: Option<Prompt>,
    pub(crate) recent: Recent,
    /// Files to choose from, and whether each is there.
    pub(crate) choosing: Option<Vec<(PathBuf, bool)>>,
    pub(crate) notices: Vec<String>,
    pub(crate) find: Find,
    pub(crate) swept: Swept,
    pub(crate) floor: Floor,
    pub(crate) numbers: Numbers,
    /// Whether what is drawn and moved goes to the grid.
    pub(crate) snaps_to_grid: bool,
    pub(crate) shows_keys: bool,
    pub(crate) asks_to_quit: bool,
    /// Whether the person has decided to leave changes behind.
    pub(crate) quits_anyway: bool,
    /// What is being written, and the file if it is a layout.
    saver: Option<files::Saver>,
    /// The picture that is being made for the clipboard.
    copying: Option<Task<Result<ColorImage, UserError>>>,
    watcher: Watcher,
    has_new_files: bool,
    /// How long a frame waits for an edit.
    pub(crate) patience: Duration,
    /// Longest side of a picture, in pixels.
    pub(crate) most_side_px: u32,
    /// For how long frames may still be held back at first: see [`FIRST_PATIENCE`].
    pub(crate) first_patience: Duration,
}

/// Where a window is drawn in software, every frame keeps both cores of an office laptop busy for long. So until there is a
/// first picture, and for so long at most, nothing but an empty window is drawn.
pub(crate) const FIRST_PATIENCE: Duration = Duration::from_millis(700);

/// What is being looked for.
#[derive(Default)]
pub(crate) struct Find {
    pub(crate) text: String,
    pub(crate) found: Vec<Element>,
    /// The search under way, which brings what is found next.
    pub(crate) search: Option<Task<Vec<Element>>>,
    /// Whether to go to the first that is found.
    pub(crate) goes_there: bool,
    pub(crate) query: String,
    pub(crate) query_trouble: Option<String>,
    /// Whether the field is to have the keyboard.
    pub(crate) wants_focus: bool,
}

/// Fields for exact changes.
pub(crate) struct Numbers {
    pub(crate) by_x_m: f64,
    pub(crate) by_y_m: f64,
    pub(crate) angle_deg: f64,
    pub(crate) copies: u32,
    /// Bends tighter than this are findings; 0 if none are.
    pub(crate) least_radius_m: f64,
}

/// Notices kept; older ones are forgotten.
const MOST_NOTICES: usize = 5;

impl App {
    /// A viewer that begins to read its files at once, and calls `wake` for whatever that brings.
    pub(crate) fn new(wake: Wake, services: Arc<dyn AppServices>, desk: LaunchOptions) -> Self {
        let mut app = Self {
            drawing: Drawing::new(desk.method),
            watcher: Watcher::start(Arc::clone(&wake)),
            recent: Recent::of(services.state_folder()),
            services,
            wake,
            layers: Vec::new(),
            active: 0,
            camera: Camera::new(),
            look: Look::default(),
            tool: Tool::Select,
            gesture: Gesture::None,
            canvas_min: Pos2::ZERO,
            px_per_point: 1.0,
            pointer_px: None,
            hover: None,
            prompt: None,
            choosing: None,
            notices: Vec::new(),
            find: Find::default(),
            swept: Swept::default(),
            floor: Floor::default(),
            numbers: Numbers {
                by_x_m: 1.0,
                by_y_m: 0.0,
                angle_deg: 90.0,
                copies: 1,
                least_radius_m: 0.0,
            },
            snaps_to_grid: false,
            shows_keys: false,
            asks_to_quit: false,
            quits_anyway: false,
            saver: None,
            copying: None,
            has_new_files: false,
            patience: layer::PATIENCE,
            most_side_px: 0,
            first_patience: Duration::ZERO,
        };
        for file in desk.files {
            app.open(file);
        }
        app.lay_floor_plan(&desk.floor_plan);
        app
    }

    /// Takes in what the threads and the window have brought.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        self.poll_layers(ctx);
        self.await_first_picture(ctx);
        self.poll_methods();
        self.poll_search();
        self.poll_swept(ctx);
        self.poll_floor(ctx);
        self.poll_files(ctx);
    }

    fn poll_layers(&mut self, ctx: &Context) {
        for index in 0..self.layers.len() {
            for news in self.layers[index].poll(ctx, &self.services, &self.wake) {
                match news {
                    LayerNews::Appeared(bounds) => {
                        // The first file says where to look; another one joins it.
                        if let (0, Some(bounds)) = (index, bounds) {
                            self.camera.fit(bounds);
                        }
                    }
                    LayerNews::Reached(stage) => {
                        if stage == LoadStage::Editable {
                            self.recolor_if_stale(index);
                            // They may be of the layout before.
                            self.swept.drawn.clear();
                        }
                        self.services.on_stage(stage, &self.layers[index].path);
                        if stage == LoadStage::Read {
                            self.remember(index);
                        }
                    }
                    LayerNews::FellBack(why) => self.fall_back(why),
                    LayerNews::Notice(text) => self.notify(text),
                }
            }
        }
    }

    /// Holds back all frames but the first, as long as there is no picture and patience for one.
    fn await_first_picture(&mut self, ctx: &Context) {
        const STEP: Duration = Duration::from_millis(2);
        let has_none = |app: &Self| !app.layers.iter().any(Layer::has_settled);
        while let Some(view) = self.camera.view()
            && !self.layers.is_empty()
            && has_none(self)
            && !self.first_patience.is_zero()
        {
            self.ask_for_pictures(&view);
            thread::sleep(STEP);
            self.first_patience = self.first_patience.saturating_sub(STEP);
            self.poll_layers(ctx);
        }
    }

    /// Whether everything shows what was last done.
    pub(crate) fn is_settled(&self) -> bool {
        self.layers.iter().all(Layer::is_settled)
    }

    /// The document that is edited, once it is there.
    pub(crate) fn document(&self) -> Option<&Document> {
        self.layers.get(self.active)?.document.as_deref()
    }

    #[cfg(test)]
    pub(crate) fn document_mut(&mut self) -> Option<&mut Document> {
        self.layers.get_mut(self.active)?.document_mut()
    }

    /// The layers that are seen, from the lowest: the one that is edited is on top.
    pub(crate) fn seen_layers(&self) -> impl Iterator<Item = &Layer> {
        let others = self.layers.iter().enumerate();
        let others = others.filter(|(index, _)| *index != self.active);
        let all = others
            .map(|(_, layer)| layer)
            .chain(self.layers.get(self.active));
        all.filter(|layer| layer.is_visible)
    }

    /// Tells the person something.
    pub(crate) fn notify(&mut self, text: impl Into<String>) {
        let text = text.into();
        if self.notices.last() == Some(&text) {
            return;
        }
        if self.notices.len() == MOST_NOTICES {
            self.notices.remove(0);
        }
        self.notices.push(text);
    }

    /// Does an edit, or says why it cannot be done. One that takes longer than a frame goes on beside the window.
    pub(crate) fn edit<E: ToString>(
        &mut self,
        edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
    ) {
        self.work(Work::edit(edit));
    }

    /// Changes what is selected or shown; as [`Self::edit`].
    pub(crate) fn change(&mut self, change: impl FnOnce(&mut Document) + Send + 'static) {
        self.work(Work::new(change));
    }

    fn work(&mut self, work: Work) {
        let layer = self.layers.get_mut(self.active);
        let news = layer.and_then(|layer| layer.work(work, self.patience, &self.wake));
        if let Some(LayerNews::Notice(text)) = news {
            self.notify(text);
        }
    }

    /// After the look has changed in what a scene is made with.
    pub(crate) fn recolor(&mut self) {
        (0..self.layers.len()).for_each(|index| self.recolor_if_stale(index));
    }

    fn recolor_if_stale(&mut self, index: usize) {
        let options = self.look.scene_options();
        self.layers[index].recolor(options, &self.wake);
    }

    pub(crate) fn apply_theme(&self, ctx: &Context) {
        ctx.set_theme(if self.look.is_dark {
            eframe::egui::Theme::Dark
        } else {
            eframe::egui::Theme::Light
        });
    }

    /// Looks at something of the document.
    pub(crate) fn fly_to(&mut self, what: Element) {
        let Some(document) = self.document() else {
            return;
        };
        if let Some(bounds) = document.bounds_of(what) {
            self.camera.fly_to(bounds);
        }
        if let Element::Path(path) = what {
            self.change(move |document| {
                document.select([path].into_iter().collect(), Default::default());
            });
        }
    }

    /// Remembers an open file for later runs.
    pub(crate) fn remember(&mut self, index: usize) {
        if let Err(problem) = self.recent.add(&self.layers[index].path) {
            self.notify(format!(
                "the list of recent files cannot be written: {problem}"
            ));
        }
    }

    /// Ends the program, or asks first where something is not saved.
    pub(crate) fn quit(&mut self, ctx: &Context) {
        if self.is_unsaved() {
            self.asks_to_quit = true;
        } else {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
    }

    pub(crate) fn is_unsaved(&self) -> bool {
        self.layers.iter().any(Layer::is_changed)
    }
}
