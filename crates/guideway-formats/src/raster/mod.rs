//! Images of a floor: reads PNG, JPEG and Netpbm files into RGBA pixels, and places them on the
//! floor.
//!
//! | module | input | output |
//! |---|---|---|
//! | `image` | | [`Raster`], [`ImagePlacement`] |
//! | `jpeg` | bytes of a JPEG file | a raster |
//! | `netpbm` | bytes of a PBM, PGM or PPM file (P1 to P6, up to 16 bits) | a raster |
//! | `png` | bytes of a PNG file | a raster |
//! | `read` | a file | the raster of its format |

mod image;
mod jpeg;
mod netpbm;
mod png;
mod read;

pub use image::{ImagePlacement, MAX_PIXELS, Raster};
pub use read::{is_raster, read_bytes, read_file};
