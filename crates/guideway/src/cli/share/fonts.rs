//! Tells which fonts the pictures of a layout need beside the one that every page has.

use guideway::compose::PageFont;
use guideway::document::Column;
use guideway::layout::{Layout, Value};
use guideway::scene::Table;

/// The fonts that a name or a value of a layout, or the title, needs.
///
/// Cost: O(all texts of the layout).
pub(super) fn needed(layout: &Layout, title: &str) -> Vec<PageFont> {
    let is_needed = |font: &PageFont| {
        let mut levels = layout.levels.iter();
        font.is_needed(title)
            || levels.any(|level| font.is_needed(level.name_or_id()))
            || Table::ALL
                .into_iter()
                .any(|of| is_needed_in(*font, layout, of))
    };
    PageFont::ALL.into_iter().filter(is_needed).collect()
}

fn is_needed_in(font: PageFont, layout: &Layout, of: Table) -> bool {
    let columns = Column::all(layout, of);
    columns.iter().any(|column| {
        let has_own = |row| {
            let found = column.with_value(layout, of, row, |value| match value {
                Value::Text(text) | Value::Json(text) => font.is_needed(text),
                Value::Bool(_) | Value::Int(_) | Value::Float(_) => false,
            });
            found == Some(true)
        };
        // The others hold numbers, or names of elements and levels, which count there.
        let has_texts = matches!(
            column,
            Column::Id | Column::VehicleType | Column::Attribute(_)
        );
        let mut rows = 0..of.row_count(layout) as u32;
        font.is_needed(column.name()) || has_texts && rows.any(has_own)
    })
}
