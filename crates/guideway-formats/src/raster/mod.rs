//! Images of a floor: reads PNG, JPEG and PGM files into RGBA pixels, and places them on the floor.
//!
//! | module | input | output |
//! |---|---|---|
//! | `image` | | [`Raster`], [`ImagePlacement`] |
//! | `jpeg` | bytes of a JPEG file | a raster |
//! | `pgm` | bytes of a PGM file (P2, P5; 8 and 16 bits) | a raster |
//! | `png` | bytes of a PNG file | a raster |
//! | `read` | a file | the raster of its format |

mod image;
mod jpeg;
mod pgm;
mod png;
mod read;

pub use image::{ImagePlacement, MAX_PIXELS, Raster};
pub use read::{is_raster, read_bytes, read_file};
