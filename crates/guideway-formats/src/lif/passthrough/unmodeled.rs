//! Index of a LIF file for the passthrough: raw objects by level and identifier, and the members of
//! root, meta information, origins and levels that the model does not hold.

use std::collections::{HashMap, HashSet};

use guideway_layout::Layout;
use serde_json::Value;
use serde_json::value::RawValue;

use super::raw::{Object, RawObject, parse, parse_members, take};
use crate::lif::model::EDGE_PROPERTIES;
use crate::lif::version::Version;

/// Arrays of a layout, with the key of the identifier of their objects.
const ARRAYS: [(&str, &str); 3] = [
    ("nodes", "nodeId"),
    ("edges", "edgeId"),
    ("stations", "stationId"),
];

/// Members of a file that the model does not hold. Objects of layouts stay raw until they are
/// requested.
#[derive(Default)]
pub(in crate::lif) struct Unmodeled<'a> {
    /// Members of the root, except layouts, origins and meta information.
    pub(in crate::lif) root: Object,
    pub(in crate::lif) meta: Object,
    /// LIF 2.0: members of each origin, and the identifiers of its layouts.
    pub(in crate::lif) origins: Vec<(Object, Vec<String>)>,
    pub(super) levels: HashMap<String, Level<'a>>,
    /// Key of the edge properties in this version.
    pub(super) edge_key: &'static str,
    /// Key of the edge properties in the other version.
    pub(super) other_edge_key: &'static str,
}

/// Members of a layout of the file.
#[derive(Default)]
pub(super) struct Level<'a> {
    /// Members except the arrays.
    pub(super) members: Object,
    /// Objects by key and value of their identifier; `None` for an identifier that several share.
    pub(super) objects: HashMap<&'static str, HashMap<String, Option<&'a RawValue>>>,
    /// Edges that the reader refused.
    refused: Vec<&'a RawValue>,
}

impl<'a> Level<'a> {
    fn object(&self, id_key: &str, id: &str) -> Option<&'a RawValue> {
        *self.objects.get(id_key)?.get(id)?
    }
}

impl<'a> Unmodeled<'a> {
    /// Indexes the file that a layout was read from; `None` for another version or format.
    pub(in crate::lif) fn of_layout(layout: &'a Layout, version: Version) -> Option<Self> {
        let text = layout.provenance.text.as_deref();
        let text = text.filter(|_| Version::of_layout(layout) == Some(version));
        let mut unmodeled = Self::parse(text?, version)?;
        if !layout.refused.is_empty() {
            unmodeled.find_refused(layout);
        }
        Some(unmodeled)
    }

    fn find_refused(&mut self, layout: &Layout) {
        // A repeated identifier is ambiguous.
        let mut used: HashSet<&str> = layout.paths.iter().map(|path| path.id()).collect();
        for path in layout.refused.iter().filter(|path| used.insert(path.id)) {
            for level in self.levels.values_mut() {
                level.refused.extend(level.object("edgeId", path.id));
            }
        }
    }

    /// Indexes a text; `None` if it has not the structure of this version.
    pub(super) fn parse(text: &'a str, version: Version) -> Option<Self> {
        let mut root: RawObject<'a> = serde_json::from_str(text).ok()?;
        let mut unmodeled = Self {
            edge_key: version.select(EDGE_PROPERTIES),
            other_edge_key: version.pick(EDGE_PROPERTIES[1], EDGE_PROPERTIES[0]),
            meta: take(&mut root, "metaInformation").unwrap_or_default(),
            ..Self::default()
        };
        match version {
            Version::V1 => {
                unmodeled.add_levels(root.remove("layouts")?)?;
            }
            Version::V2 => {
                let origins: Vec<RawObject<'a>> = parse(root.remove("origins")?)?;
                for mut origin in origins {
                    let levels = unmodeled.add_levels(origin.remove("layouts")?)?;
                    unmodeled.origins.push((parse_members(origin), levels));
                }
            }
        }
        // The reader accepts the arrays of both versions; the writer writes those of this one.
        root.retain(|name, _| !matches!(name.as_ref(), "layouts" | "origins"));
        unmodeled.root = parse_members(root);
        Some(unmodeled)
    }

    /// Adds the layouts of an array; returns their identifiers.
    fn add_levels(&mut self, array: &'a RawValue) -> Option<Vec<String>> {
        let levels: Vec<RawObject<'a>> = parse(array)?;
        let mut ids = Vec::new();
        for mut members in levels {
            let id: String = take(&mut members, "layoutId")?;
            ids.push(id.clone());
            let mut level = Level::default();
            for (key, id_key) in ARRAYS {
                let Some(array) = members.remove(key) else {
                    continue;
                };
                let objects = level.objects.entry(id_key).or_default();
                for object in parse::<Vec<&'a RawValue>>(array)? {
                    let Some(id) = id_of(object, id_key) else {
                        continue;
                    };
                    let known = objects.entry(id);
                    // A repeated identifier is ambiguous.
                    known
                        .and_modify(|known| *known = None)
                        .or_insert(Some(object));
                }
            }
            level.members = parse_members(members);
            let is_repeated = self.levels.contains_key(&id);
            self.levels
                .insert(id, if is_repeated { Level::default() } else { level });
        }
        Some(ids)
    }

    /// Returns the members of a level except its arrays.
    pub(in crate::lif) fn level_members(&self, id: &str) -> Object {
        let level = self.levels.get(id);
        level.map(|level| level.members.clone()).unwrap_or_default()
    }

    /// Iterates over the refused edges of a level, unchanged.
    pub(in crate::lif) fn refused_edges(&self, level: &str) -> impl Iterator<Item = Value> {
        let level = self.levels.get(level);
        let edges = level.map_or(&[][..], |level| &level.refused);
        edges.iter().copied().filter_map(parse)
    }

    /// Returns the number of refused paths that have no edge to pass through.
    pub(in crate::lif) fn count_lost(&self, layout: &Layout) -> usize {
        let levels = layout.levels.iter();
        let levels = levels.filter_map(|level| self.levels.get(&level.id));
        let passed: usize = levels.map(|level| level.refused.len()).sum();
        layout.refused.len().saturating_sub(passed)
    }

    /// Returns an object of the file.
    pub(super) fn object(&self, level: &str, id_key: &str, id: &str) -> Option<Object> {
        let level = self.levels.get(level)?;
        // The reader splits an edge with several curves into paths `edge [types]`.
        let edge_id = id.rsplit_once(" [").map(|(edge, _)| edge);
        let object = level.object(id_key, id);
        parse(object.or_else(|| level.object(id_key, edge_id?))?)
    }
}

fn id_of(object: &RawValue, key: &str) -> Option<String> {
    let mut members: RawObject<'_> = parse(object)?;
    take(&mut members, key)
}
