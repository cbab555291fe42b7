//! SVG drawings.

mod write;
mod write_page;

pub use self::write::write_layout;
pub use self::write_page::{Outline, Page, Stroke};
