//! The window in which layouts are viewed and edited.
//!
//! The window holds no algorithms: a [`Document`](guideway_document::Document) edits, a
//! [`Method`](guideway_scene::Method) renders, and [`AppServices`] reads and writes files. Loading,
//! rendering, long edits and saving run on other threads; until a new picture is complete the
//! window shows the last one at its place in the new view.
//!
//! | part | owns | folder |
//! |---|---|---|
//! | services | the interface to files and methods | `services` |
//! | partial redraw | the last frame, where a processor draws the window | `partial_redraw` |
//! | background | one task on another thread | `background` |
//! | render queue | render threads, pictures, method | `render_queue` |
//! | editing | document, queued edits, journal, overlay | `editing` |
//! | files | open files, loading, saving, watching | `files` |
//! | backdrop | floor plan, swept areas | `backdrop` |
//! | tools | pointer tools and gestures | `tools` |
//! | selection | search, exact edits, selection commands, copied elements | `selection` |
//! | language | English texts, and German ones beside them | `language` |
//! | units | the units in which speeds and lengths are shown and typed | `units` |
//! | typed breaks | the class breaks of the colors as they are typed | `typed_breaks` |
//! | canvas | camera, input, painting, decorations | `canvas` |
//! | export | pictures for files and clipboard | `export` |
//! | preferences | what outlives a run | `preferences` |
//! | project | files and look in one file | `project` |
//! | route, compare | the route between two places; changes between two files | `route`, `compare` |
//! | network draft | the network that a drawing would become | `network_draft` |
//! | panels | menu bar, drawing bar, side panel, table, dialogs | `panels` |
//! | app | all parts, and the routes between them | `app` |

mod action;
mod app;
mod backdrop;
mod background;
mod canvas;
mod command;
mod compare;
mod display_settings;
mod editing;
mod export;
mod file_purpose;
mod files;
mod language;
mod launch_options;
mod measure;
mod network_draft;
mod panels;
mod partial_redraw;
mod preferences;
mod project;
mod render_queue;
mod route;
mod selection;
mod services;
#[cfg(test)]
mod tests;
mod tools;
mod typed_breaks;
mod units;
mod window;
mod window_icon;

pub use eframe::wgpu;
pub use launch_options::LaunchOptions;
pub use measure::{Movement, measure};
pub use services::{
    AppServices, FileAnswer, FileFormat, FileQuestion, FileStamp, Job, LoadStage, LostPart,
    MAX_PROJECT_BYTES, MethodChoice, PendingFileAnswer, PictureRequest, Saved, SweptAreas,
};
pub use window::run;
