//! Finds the level that a scene shows.

use guideway_layout::{Layout, Level};

use super::error::SceneError;

/// The index of the level of this name or id.
pub(super) fn visible_level(
    layout: &Layout,
    asked: Option<&str>,
) -> Result<Option<u32>, SceneError> {
    let Some(asked) = asked else {
        return Ok(None);
    };
    match layout.level_named(asked) {
        Some(level) => Ok(Some(level)),
        None => Err(SceneError::UnknownLevel {
            asked: asked.to_owned(),
            known: layout.levels.iter().map(level_label).collect(),
        }),
    }
}

/// A level's id and name, either of which selects it.
fn level_label(level: &Level) -> String {
    match &level.name {
        Some(name) if *name != level.id => format!("{} ({name})", level.id),
        _ => level.id.clone(),
    }
}
