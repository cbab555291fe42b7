//! Search by name, and the query that selects paths.

use guideway_document::{Document, Element, Elements, Group, search, search_groups};
use guideway_scene::Table;

use crate::background::{BackgroundTask, RepaintHandle};
use crate::language::{counted, say};

/// Longest list of results of one kind of element.
const MAX_RESULTS: u64 = 30;

/// Elements, and levels and vehicle types.
type Found = (Vec<Element>, Vec<Group>);

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
    groups: Vec<Group>,
    /// Nodes, stations and paths beyond the list.
    more: [u64; 3],
    /// Kinds of groups, and how many are beyond the list.
    more_groups: Vec<(&'static str, u64)>,
    search: Option<BackgroundTask<Found>>,
}

impl Find {
    /// Searches for the name in the background: a layout may have a million names.
    pub(crate) fn search(&mut self, document: Option<&Document>, repaint: &RepaintHandle) {
        let layout = document.map(|document| document.scene().shared_layout());
        self.search = layout.map(|layout| {
            let name = self.name.clone();
            BackgroundTask::start(repaint, move || {
                let elements = search(&layout, &name, usize::MAX);
                (elements, search_groups(&layout, &name))
            })
        });
    }

    /// The numbers of matches beyond the listed ones: `and 1,020 more paths`.
    pub(crate) fn more(&self) -> Vec<String> {
        let kinds = [Table::Nodes, Table::Stations, Table::Paths].map(Table::element);
        let elements = kinds.into_iter().zip(self.more);
        let more = elements.chain(self.more_groups.iter().copied());
        let more = more.filter(|(_, count)| *count > 0);
        more.map(|(kind, count)| {
            let what = format!("more {kind}");
            say!("and {more}", more = counted(count, &what))
        })
        .collect()
    }

    /// The results that exist in the document, which may have changed since the search.
    pub(crate) fn results<'a>(&'a self, of: &'a Document) -> impl Iterator<Item = Element> + 'a {
        let results = self.results.iter().copied();
        results.filter(|element| of.contains(*element))
    }

    /// The levels and vehicle types among the results that exist in the document.
    pub(crate) fn groups<'a>(&'a self, of: &'a Document) -> impl Iterator<Item = &'a Group> {
        let groups = self.groups.iter();
        groups.filter(|group| of.contains_group(group))
    }

    /// Takes a finished search. Returns what to zoom to.
    pub(crate) fn poll(&mut self, document: Option<&Document>) -> Option<Elements> {
        if let Some(results) = self.search.as_ref().and_then(BackgroundTask::result) {
            self.search = None;
            let (elements, groups) = results.unwrap_or_default();
            self.take(elements, document);
            self.take_groups(groups);
        }
        if self.search.is_some() || !std::mem::take(&mut self.zooms_to_first) {
            return None;
        }
        let document = document?;
        let element = self.results(document).next().map(Elements::of);
        element.or_else(|| self.groups(document).next().map(Elements::of_group))
    }
}

impl Find {
    /// Lists the first matches of each kind, and counts the others.
    fn take(&mut self, results: Vec<Element>, document: Option<&Document>) {
        self.results.clear();
        let mut counts = [0; 3];
        let exists = |element: &Element| document.is_none_or(|d| d.contains(*element));
        for element in results.into_iter().filter(exists) {
            let kind = match element {
                Element::Node(_) => 0,
                Element::Station(_) => 1,
                Element::Path(_) => 2,
            };
            if counts[kind] < MAX_RESULTS {
                self.results.push(element);
            }
            counts[kind] += 1;
        }
        self.more = counts.map(|count| count.saturating_sub(MAX_RESULTS));
    }

    /// Lists the first levels and vehicle types, and counts the others.
    fn take_groups(&mut self, groups: Vec<Group>) {
        self.groups.clear();
        self.more_groups.clear();
        for group in groups {
            let kind = group.kind();
            let of_kind = |other: &&Group| other.kind() == kind;
            if (self.groups.iter().filter(of_kind).count() as u64) < MAX_RESULTS {
                self.groups.push(group);
                continue;
            }
            match self
                .more_groups
                .iter_mut()
                .find(|(other, _)| *other == kind)
            {
                Some((_, count)) => *count += 1,
                None => self.more_groups.push((kind, 1)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;
    use std::time::Duration;

    use guideway_layout::{Level, VehicleType};

    use super::*;
    use crate::language::{Language, set_language};
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
        assert_eq!(found, Some(Elements::of(Element::Path(37))));
        assert_eq!(find.results(&document).next(), Some(Element::Path(37)));
        assert!(find.more().is_empty());
        let all = search(document.layout(), "lane", usize::MAX);
        find.take(all, Some(&document));
        assert_eq!(find.results(&document).count(), 30);
        assert_eq!(find.more(), ["and 10 more paths"]);
        let shorter = Document::new(lanes(3).into(), &Default::default()).unwrap();
        assert_eq!(find.results(&shorter).count(), 3);
    }

    #[test]
    fn levels_and_vehicle_types_beyond_the_list_are_counted() {
        let mut layout = lanes(2);
        layout.levels = (0..32).map(level).collect();
        layout.vehicle_types = (0..31).map(vehicle_type).collect();
        let groups = search_groups(&layout, "hall");
        let document = Document::new(layout.into(), &Default::default()).unwrap();
        let mut find = Find::default();
        find.take_groups(groups);
        assert_eq!(find.groups(&document).count(), 60);
        assert_eq!(
            find.more(),
            ["and 2 more levels", "and 1 more vehicle type"]
        );
        set_language(Language::German);
        let german = find.more();
        set_language(Language::English);
        assert_eq!(
            german,
            ["und 2 weitere Ebenen", "und 1 weiterer Fahrzeugtyp"]
        );
        find.take_groups(Vec::new());
        assert!(find.more().is_empty() && find.groups(&document).next().is_none());
    }

    fn level(number: u32) -> Level {
        Level {
            id: format!("hall {number}"),
            ..Level::default()
        }
    }

    fn vehicle_type(number: u32) -> VehicleType {
        VehicleType {
            id: format!("hall truck {number}"),
            ..VehicleType::default()
        }
    }
}
