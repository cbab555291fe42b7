//! Search by name, and the query that selects paths.

use guideway_document::{Document, Element, search};

use crate::background::{BackgroundTask, RepaintHandle};

/// Longest list of results.
const MAX_RESULTS: usize = 30;

/// The search fields and their results.
#[derive(Default)]
pub(crate) struct Find {
    pub(crate) name: String,
    pub(crate) query: String,
    /// Why the query selects nothing.
    pub(crate) query_error: Option<String>,
    /// True if the name field takes the keyboard focus in the next frame.
    pub(crate) wants_focus: bool,
    /// True if to zoom to the first result.
    pub(crate) zooms_to_first: bool,
    results: Vec<Element>,
    search: Option<BackgroundTask<Vec<Element>>>,
}

impl Find {
    /// Searches for the name in the background: a layout may have a million names.
    pub(crate) fn search(&mut self, document: Option<&Document>, repaint: &RepaintHandle) {
        let layout = document.map(|document| document.scene().shared_layout());
        self.search = layout.map(|layout| {
            let name = self.name.clone();
            BackgroundTask::start(repaint, move || search(&layout, &name, MAX_RESULTS))
        });
    }

    /// The results that exist in the document, which may have changed since the search.
    pub(crate) fn results<'a>(&'a self, of: &'a Document) -> impl Iterator<Item = Element> + 'a {
        let results = self.results.iter().copied();
        results.filter(|element| of.contains(*element))
    }

    /// Takes a finished search. Returns the element to zoom to.
    pub(crate) fn poll(&mut self, document: Option<&Document>) -> Option<Element> {
        if let Some(results) = self.search.as_ref().and_then(BackgroundTask::result) {
            self.search = None;
            self.results = results.unwrap_or_default();
        }
        if self.search.is_some() || !std::mem::take(&mut self.zooms_to_first) {
            return None;
        }
        let first = self.results.first().copied()?;
        document.and_then(|d| d.contains(first).then_some(first))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;
    use std::time::Duration;

    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn finds_by_name_and_drops_results_of_a_longer_layout() {
        let document = Document::new(lanes(40).into(), &Default::default()).unwrap();
        let repaint: RepaintHandle = Arc::new(|| {});
        let mut find = Find {
            name: "LANE 37".into(),
            zooms_to_first: true,
            ..Find::default()
        };
        find.search(Some(&document), &repaint);
        let found = (0..5_000).find_map(|_| {
            thread::sleep(Duration::from_millis(1));
            find.poll(Some(&document))
        });
        assert_eq!(found, Some(Element::Path(37)));
        assert_eq!(find.results(&document).next(), Some(Element::Path(37)));
        let shorter = Document::new(lanes(3).into(), &Default::default()).unwrap();
        assert_eq!(find.results(&shorter).count(), 0);
    }
}
