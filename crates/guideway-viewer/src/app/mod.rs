//! The application: owns all parts of the window and routes commands and events between them.
//!
//! | step | input | output | file |
//! |---|---|---|---|
//! | start | launch options | [`App`] with all parts | `state` |
//! | frame | results of threads, input of egui | shown parts, actions | `frame` |
//! | input | keys, texts and pointer events, in order | commands, events of the tools | `input` |
//! | route | action, command, pointer event | calls of the owning part | `routing` |
//! | drawing | commands | new layouts, pasted and arranged elements | `drawing` |
//! | edits | edits, effects of tools | changed documents, notices | `edits` |
//! | file commands | paths | loads, saves, exports | `file_commands` |

mod drawing;
mod edits;
mod file_commands;
mod frame;
mod input;
mod routing;
mod state;

pub(crate) use state::{App, FIRST_PICTURE_WAIT};
