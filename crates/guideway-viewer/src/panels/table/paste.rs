//! Cells from a spreadsheet: lines of texts that tabs separate, laid over the rows of the table.

use guideway_document::{Column, PathSet};
use guideway_scene::Table;

use super::cell::{TypedCell, is_editable};
use crate::language::say;

/// Most cells of one paste.
const MAX_CELLS: usize = 100_000;

/// The table below a paste.
pub(super) struct Target<'a> {
    pub(super) of: Table,
    pub(super) columns: &'a [Column],
    /// The shown rows in their order.
    pub(super) rows: &'a [u32],
    pub(super) selected: &'a PathSet,
    /// Row and index of the column of the cell that was clicked last.
    pub(super) cursor: (u32, usize),
}

impl Target<'_> {
    /// The cells that a text fills. One cell fills all selected rows; as many lines as there are
    /// selected rows fill these; else the lines fill the rows from the clicked one down.
    ///
    /// # Errors
    /// When the text has more lines or columns than the table has from there on, or a column takes
    /// no text.
    pub(super) fn cells(&self, text: &str) -> Result<Vec<TypedCell>, String> {
        let lines: Vec<Vec<&str>> = text
            .trim_end_matches(['\r', '\n'])
            .lines()
            .map(|line| line.split('\t').collect())
            .collect();
        let width = lines.iter().map(Vec::len).max().unwrap_or(0);
        let (row, first) = self.cursor;
        let columns = self.columns.get(first..first + width).ok_or_else(|| {
            let left = self.columns.len().saturating_sub(first);
            say!(
                "{width} columns are pasted; the table has {left} from the clicked one on",
                width,
                left
            )
        })?;
        if let Some(column) = columns.iter().find(|column| !is_editable(self.of, column)) {
            return Err(say!("{name} takes no pasted cells", name = column.name()));
        }
        let selected: Vec<u32> = self
            .rows
            .iter()
            .copied()
            .filter(|row| self.selected.contains(*row))
            .collect();
        let is_selected = selected.contains(&row);
        let fills = lines.len() == 1 && is_selected;
        let rows: Vec<u32> = if fills || (is_selected && lines.len() == selected.len()) {
            selected
        } else {
            let from = self.rows.iter().position(|&shown| shown == row);
            let below = &self.rows[from.unwrap_or(self.rows.len())..];
            let rows = below.get(..lines.len()).ok_or_else(|| {
                let (count, left) = (lines.len(), below.len());
                say!(
                    "{count} lines are pasted; the table has {left} rows from the clicked one on",
                    count,
                    left
                )
            })?;
            rows.to_vec()
        };
        if rows.len().saturating_mul(width) > MAX_CELLS {
            return Err(say!(
                "more than {most} cells; paste fewer at once",
                most = MAX_CELLS
            ));
        }
        let line_of = |number: usize| &lines[if fills { 0 } else { number }];
        let mut cells = Vec::new();
        for (number, &row) in rows.iter().enumerate() {
            for (column, text) in columns.iter().zip(line_of(number)) {
                cells.push(TypedCell {
                    column: column.clone(),
                    row,
                    text: (*text).to_owned(),
                });
            }
        }
        Ok(cells)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paste(
        text: &str,
        selected: &[u32],
        cursor: (u32, usize),
    ) -> Result<Vec<(u32, String)>, String> {
        let target = Target {
            of: Table::Paths,
            columns: &[
                Column::Id,
                Column::Length,
                Column::Attribute("a".into()),
                Column::Attribute("b".into()),
            ],
            rows: &[4, 2, 7, 1],
            selected: &selected.iter().copied().collect(),
            cursor,
        };
        let cells = target.cells(text)?;
        Ok(cells
            .into_iter()
            .map(|cell| (cell.row, format!("{}={}", cell.column.name(), cell.text)))
            .collect())
    }

    #[test]
    fn lines_fill_the_rows_from_the_clicked_one_down() {
        let cells = paste("1\t2\r\n3\t4\r\n", &[], (2, 2)).unwrap();
        let texts: Vec<_> = cells.iter().map(|(row, text)| (*row, &**text)).collect();
        assert_eq!(texts, [(2, "a=1"), (2, "b=2"), (7, "a=3"), (7, "b=4")]);
    }

    #[test]
    fn one_cell_fills_the_selected_rows_and_lines_fill_as_many() {
        let rows = |cells: Vec<(u32, String)>| -> Vec<u32> {
            cells.into_iter().map(|(row, _)| row).collect()
        };
        assert_eq!(rows(paste("9", &[1, 4, 7], (4, 2)).unwrap()), [4, 7, 1]);
        assert_eq!(rows(paste("8\n9", &[1, 4], (1, 2)).unwrap()), [4, 1]);
        assert_eq!(
            rows(paste("9", &[1, 4], (2, 2)).unwrap()),
            [2],
            "not selected"
        );
    }

    #[test]
    fn what_does_not_fit_is_refused_whole() {
        for (text, cursor, why) in [
            ("1\n2\n3", (7, 2), "2 rows"),
            ("1\t2\t3", (4, 2), "2 from"),
            ("1\t2", (4, 0), "length_m takes no"),
            ("1", (99, 2), "0 rows"),
        ] {
            let error = paste(text, &[], cursor).unwrap_err();
            assert!(error.contains(why), "{error}");
        }
    }
}
