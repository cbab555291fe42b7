//! The application: owns all parts of the window and routes commands and events between them.
//!
//! | step | input | output | file |
//! |---|---|---|---|
//! | start | launch options | [`App`] with all parts, files that load | `state`, `opening` |
//! | pictures | views, files that load | requests, the first frame with a picture | `pictures` |
//! | frame | results of threads, input of egui | shown parts, actions | `frame` |
//! | remember | settings and window | a file in the state folder | `remember` |
//! | input | keys, texts and pointer events, in order | commands, events of the tools | `input` |
//! | pick | pointer events | the file that was clicked | `picking` |
//! | route | action, command, pointer event | calls of the owning part | `routing` |
//! | context menu | a right click | a selection, commands | `context_menu` |
//! | file names | questions for file names | actions | `file_dialogs` |
//! | file commands | paths | loads, exports | `file_commands` |
//! | floor plan | a file, clicks, drags | a plan at its place | `floor_plan` |
//! | project | files, plan, view, look | a project file, and back | `project` |
//! | drawing | commands | new layouts, pasted and arranged elements | `drawing` |
//! | save | the active file | a written file, or a question | `saving` |

mod basics;
mod context_menu;
mod drawing;
mod file_commands;
mod file_dialogs;
mod floor_plan;
mod frame;
mod input;
mod open_project;
mod opening;
mod picking;
mod pictures;
mod postponed;
mod project;
mod remember;
mod routing;
mod saving;
mod state;
mod waiting;

pub(crate) use state::{App, FIRST_PICTURE_WAIT};
