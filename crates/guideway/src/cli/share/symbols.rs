//! Tells whether pictures of a layout show symbols, which have a font of their own in a page.

use guideway::compose::needs_symbols;
use guideway::document::Column;
use guideway::layout::{Layout, Value};
use guideway::scene::Table;

/// Returns `true` if a name or a value of a layout, or the title, has a symbol.
///
/// Cost: O(all texts of the layout).
pub(super) fn are_needed(layout: &Layout, title: &str) -> bool {
    let mut levels = layout.levels.iter();
    needs_symbols(title)
        || levels.any(|level| needs_symbols(level.name_or_id()))
        || Table::ALL.into_iter().any(|of| are_in(layout, of))
}

fn are_in(layout: &Layout, of: Table) -> bool {
    let columns = Column::all(layout, of);
    columns.iter().any(|column| {
        let has_symbol = |row| {
            let found = column.with_value(layout, of, row, |value| match value {
                Value::Text(text) | Value::Json(text) => needs_symbols(text),
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
        needs_symbols(column.name()) || has_texts && rows.any(has_symbol)
    })
}
