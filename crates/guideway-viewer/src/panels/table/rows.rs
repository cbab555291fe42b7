//! The rows of the table: filtered and sorted in the background.

use std::time::Duration;

use guideway_document::{Column, Document, Query};
use guideway_scene::Table;

use crate::background::{BackgroundTask, RepaintHandle};

/// Longest time that a frame waits for rows: a small table never shows old ones.
const ROWS_WAIT: Duration = Duration::from_millis(8);

/// The choice of the shown rows and of their order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RowsKey {
    /// Index of the file, and state of its document.
    pub(super) file: usize,
    pub(super) state: u64,
    pub(super) of: Table,
    /// A query; empty for all rows.
    pub(super) filter: String,
    /// Column, and `true` for the largest value first.
    pub(super) sort: Option<(Column, bool)>,
}

/// The shown rows.
#[derive(Default)]
pub(super) struct TableRows {
    key: Option<RowsKey>,
    rows: Vec<u32>,
    task: Option<(RowsKey, BackgroundTask<Vec<u32>>)>,
    /// Why the filter is not applied.
    error: Option<String>,
}

impl TableRows {
    /// The last complete rows; empty if they are those of another table or file.
    pub(super) fn of(&self, wanted: &RowsKey) -> &[u32] {
        let key = self.key.as_ref();
        match key.is_some_and(|key| (key.file, key.of) == (wanted.file, wanted.of)) {
            true => &self.rows,
            false => &[],
        }
    }

    /// Why the filter is not applied.
    pub(super) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    pub(super) fn is_busy(&self) -> bool {
        self.task.is_some()
    }

    /// Brings the rows up to date, or starts to.
    pub(super) fn update(&mut self, document: &Document, key: &RowsKey, repaint: &RepaintHandle) {
        self.take(Duration::ZERO);
        let is_present = self.key.as_ref() == Some(key);
        if is_present || self.task.as_ref().is_some_and(|(wanted, _)| wanted == key) {
            return;
        }
        let layout = document.scene().shared_layout();
        let query = match key.filter.trim() {
            "" => None,
            filter => match Query::parse_for(filter, &layout, key.of) {
                Ok(query) => Some(query),
                Err(error) => {
                    self.error = Some(error.to_string());
                    return;
                }
            },
        };
        self.error = None;
        let mut rows: Vec<u32> = document.existing(key.of).collect();
        if query.is_none() && key.sort.is_none() {
            (self.key, self.rows, self.task) = (Some(key.clone()), rows, None);
            return;
        }
        let (of, sort) = (key.of, key.sort.clone());
        let task = BackgroundTask::start(repaint, move || {
            if let Some(query) = query {
                let matches = query.rows(&layout);
                rows.retain(|&row| matches.contains(row));
            }
            if let Some((column, descending)) = sort {
                column.sort(&layout, of, &mut rows, descending);
            }
            rows
        });
        self.task = Some((key.clone(), task));
        self.take(ROWS_WAIT);
    }

    /// Takes the rows of a finished task.
    fn take(&mut self, wait: Duration) {
        let result = self.task.as_ref();
        let Some(result) = result.and_then(|(_, task)| task.result_within(wait)) else {
            return;
        };
        let key = self.task.take().map(|(key, _)| key);
        match result {
            Ok(rows) => (self.key, self.rows) = (key, rows),
            Err(error) => self.error = Some(error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn rows_are_filtered_and_sorted_and_keep_those_of_a_wrong_filter() {
        let document = Document::new(lanes(6).into(), &Default::default()).unwrap();
        let repaint: RepaintHandle = Arc::new(|| {});
        let mut rows = TableRows::default();
        let mut key = RowsKey {
            file: 0,
            state: document.state(),
            of: Table::Paths,
            filter: String::new(),
            sort: None,
        };
        rows.update(&document, &key, &repaint);
        assert_eq!(rows.of(&key), [0, 1, 2, 3, 4, 5]);
        key.filter = "speed > 1".into();
        key.sort = Some((Column::Id, true));
        for _ in 0..5_000 {
            rows.update(&document, &key, &repaint);
            if !rows.is_busy() {
                break;
            }
        }
        assert_eq!(rows.of(&key), [5, 4, 3]);
        key.filter = "spede > 1".into();
        rows.update(&document, &key, &repaint);
        assert!(rows.error().is_some_and(|error| error.contains("spede")));
        assert_eq!(rows.of(&key), [5, 4, 3]);
        key.of = Table::Nodes;
        assert!(rows.of(&key).is_empty());
    }
}
