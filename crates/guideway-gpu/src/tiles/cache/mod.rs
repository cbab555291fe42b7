//! Caches between frames: lines of a level of detail, and finished pictures.
//!
//! | file | content |
//! |---|---|
//! | `line_cache` | lines that later frames may draw, and the dirty clusters |
//! | `picture_cache` | the view in the pixel buffer; tiles missing for the next view |
//! | `scroll` | moves the pixels of a cached picture |

pub(crate) mod line_cache;
pub(crate) mod picture_cache;
pub(crate) mod scroll;
