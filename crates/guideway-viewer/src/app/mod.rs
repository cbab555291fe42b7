//! The application: owns all parts of the window and routes commands and events between them.
//!
//! | step | input | output | file |
//! |---|---|---|---|
//! | start | launch options | [`App`] with all parts | `state` |
//! | frame | results of threads, input of egui | shown parts, actions | `frame` |
//! | input | keys and pointer events, in order | commands, events of the tools | `input` |
//! | pick | pointer events | the file that was clicked | `picking` |
//! | route | action, command, pointer event | calls of the owning part | `routing` |
//! | file commands | paths | loads, saves, exports | `file_commands` |

mod file_commands;
mod frame;
mod input;
mod picking;
mod routing;
mod state;

pub(crate) use state::{App, FIRST_PICTURE_WAIT};
