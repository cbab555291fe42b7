//! The shortest call for a picture: one file with default options.

use std::path::Path;
use std::sync::Arc;

use guideway_compose::{ComposeError, NoProgress, Picture, Rendered, VectorFormat};
use guideway_layout::Layout;
use guideway_scene::{FrameSize, Scene, SceneOptions};

/// Draws a layout on 1920 x 1080 pixels and saves the picture, as SVG or PDF if the extension
/// says so, else as PNG. [`Picture`] has the options.
///
/// # Errors
/// When the file cannot be written.
pub fn render(layout: Layout, path: impl AsRef<Path>) -> Result<Rendered, ComposeError> {
    let path = path.as_ref();
    // A scene without options takes every layout.
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default()).expect("no options");
    let picture = Picture::new(Arc::new(scene), FrameSize::new(1920, 1080)?);
    let is_named = |name| {
        path.extension()
            .is_some_and(|own| own.eq_ignore_ascii_case(name))
    };
    match is_named("pdf") {
        true => picture.save_vector(VectorFormat::Pdf, path),
        false if is_named("svg") => picture.save_vector(VectorFormat::Svg, path),
        false => picture.save_png(&guideway_cpu::Cpu, path, &NoProgress),
    }
}
