//! Gives all paths other colors: sends their styles, and nothing of their curves.

use std::sync::Arc;

use guideway_scene::{Coloring, RenderError};

use super::edit::SceneBufferEdit;
use super::edit_effect::EditEffect;
use super::uploaded_scene::UploadedScene;
use crate::tiles::device_context::DeviceContext;

/// Recolors the scene and its buffers. After an error `UploadedScene::is_incomplete` is set.
pub(crate) fn recolor(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    coloring: &Coloring,
) -> Result<SceneBufferEdit, RenderError> {
    let moves_paths = uploaded.scene.is_reordered_by(coloring);
    Arc::make_mut(&mut uploaded.scene).recolor(coloring);
    if std::mem::replace(&mut uploaded.is_incomplete, true) || moves_paths {
        return Ok(SceneBufferEdit::NeedsUpload);
    }
    uploaded.facts.refresh_appearance(&uploaded.scene);
    let mut effect = EditEffect {
        changes_appearance: true,
        ..EditEffect::default()
    };
    if let Some(buffers) = &mut uploaded.buffers {
        let count = buffers.style_count;
        effect.moved_bytes = buffers.send_styles(device, &uploaded.scene)?;
        effect.replaces_buffers = buffers.style_count != count;
        uploaded.facts.styles = buffers.style_count;
    }
    uploaded.is_incomplete = false;
    Ok(SceneBufferEdit::Applied(effect))
}
