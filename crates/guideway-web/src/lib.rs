//! The engine of the page: a layout that is open in a browser, with the calls of the page.
//!
//! A [`Session`] holds one layout. Its calls take and return JSON, bytes and pixels, and work in
//! any program; `bindings` names them for JavaScript, in a build for `wasm32` alone. Errors are
//! those of the command, word for word.
//!
//! | module | content |
//! |---|---|
//! | `session` | opens a layout; pictures, findings, routes |
//! | `look` | what a picture shows, as the page asks for it |
//! | `edits`, `history` | edits by scripts, and undo, with the feature `files` |
//! | `files` | layouts in files of all formats, with the feature `files`; differences of two |
//! | `floor_plan` | the drawing or the image below the paths |
//! | `elements` | properties, outlines, hit test, search |
//! | `answers` | findings and pictures as JSON |
//! | `bindings` | the names of the calls in JavaScript |
//! | `file` | bytes of the file that is being opened, which stay outside |
//! | `work` | calls in one thread, or with `threads` in a pool of workers |

mod answers;
#[cfg(target_arch = "wasm32")]
mod bindings;
#[cfg(feature = "files")]
mod edits;
mod elements;
#[cfg(target_arch = "wasm32")]
mod file;
#[cfg(feature = "files")]
mod files;
mod floor_plan;
#[cfg(feature = "files")]
mod history;
mod look;
mod session;
#[cfg(all(target_arch = "wasm32", not(feature = "threads")))]
#[path = "work/one.rs"]
mod work;
#[cfg(all(target_arch = "wasm32", feature = "threads"))]
#[path = "work/pool.rs"]
mod work;

#[cfg(feature = "files")]
pub use files::Saved;
pub use session::{Drawn, Session};
