//! Converts a frame into an image of egui.

use eframe::egui::{Color32, ColorImage};
use guideway_scene::Frame;

/// Converts straight alpha (frame) into premultiplied alpha (egui).
pub(crate) fn color_image(frame: &Frame) -> ColorImage {
    let color = |&[r, g, b, a]: &[u8; 4]| Color32::from_rgba_unmultiplied(r, g, b, a);
    let size = [frame.size().width(), frame.size().height()];
    let pixels = frame.pixels().iter().map(color).collect();
    ColorImage::new(size.map(|side| side as usize), pixels)
}
