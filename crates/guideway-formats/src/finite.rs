//! Refuses to write numbers that are not finite: most formats have no text for them.

use std::io;

use guideway_layout::Layout;

/// Checks that all positions, widths and heights of a layout are finite.
///
/// # Errors
/// When one is not; the error names its element.
pub(crate) fn check_finite(layout: &Layout) -> io::Result<()> {
    match layout.first_beyond(f64::MAX) {
        None => Ok(()),
        Some(element) => Err(io::Error::new(
            io::ErrorKind::InvalidData,
            format!("{element} has a coordinate that is not a finite number"),
        )),
    }
}
