//! Pictures of the canvas for files and for the clipboard.

mod clipboard;
mod picture;

pub(crate) use clipboard::Clipboard;
pub(crate) use picture::{PictureContent, png_picture};
