//! Images of a floor: reads PNG and PGM files into RGBA pixels, and places them on the floor.
//!
//! | module | input | output |
//! |---|---|---|
//! | `image` | | [`Raster`], [`ImagePlacement`] |
//! | `pgm` | bytes of a PGM file (P2, P5; 8 and 16 bits) | a raster |
//! | `png` | bytes of a PNG file | a raster |
//! | `read` | a file | the raster of its format |

mod image;
mod pgm;
mod png;
mod read;

pub use image::{ImagePlacement, MAX_PIXELS, Raster};
pub use read::{is_raster, read_file};
