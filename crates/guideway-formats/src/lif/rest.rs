//! What a file has beside what a layout has of it, such as actions and descriptions. It is kept when the file is
//! written again: each object is written as it was, with the place and the curve that it has now.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::Layout;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::model::{self, EDGE_PROPERTIES, NODE_PROPERTIES};
use super::write_columns::Version;
use super::write_network::ANY_TYPE;

mod count;

pub(crate) use count::count_beside;

type Object = Map<String, Value>;
type RawObject<'a> = HashMap<Cow<'a, str>, &'a RawValue>;

/// The lists of a layout, by the names of their objects' identifiers.
const LISTS: [(&str, &str); 3] = [
    ("nodes", "nodeId"),
    ("edges", "edgeId"),
    ("stations", "stationId"),
];

/// All of a file but what its layouts list, which is read when it is asked for.
#[derive(Default)]
pub(super) struct Rest<'a> {
    /// Members of the root, without those below.
    pub(super) root: Object,
    pub(super) meta: Object,
    /// Of 2.0: members of an origin, and the identifiers of its layouts.
    pub(super) origins: Vec<(Object, Vec<String>)>,
    levels: HashMap<String, Level<'a>>,
    /// What has the curves of an edge, in this version and in the other one.
    key: &'static str,
    other_key: &'static str,
}

#[derive(Default)]
struct Level<'a> {
    /// Without its lists.
    members: Object,
    /// By the name of its identifier, and that. None where several have the same.
    objects: HashMap<&'static str, HashMap<String, Option<&'a RawValue>>>,
    /// Edges that are no paths.
    refused: Vec<&'a RawValue>,
}

impl<'a> Level<'a> {
    fn object(&self, id_key: &str, id: &str) -> Option<&'a RawValue> {
        *self.objects.get(id_key)?.get(id)?
    }
}

impl<'a> Rest<'a> {
    /// What the file of a layout has; none if it is of another version or format.
    pub(super) fn of(layout: &'a Layout, version: Version) -> Option<Self> {
        let text = layout.provenance.text.as_deref();
        let text = text.filter(|_| Version::of_layout(layout) == Some(version));
        let mut rest = Self::parse(text?, version)?;
        if !layout.refused.is_empty() {
            rest.find_refused(layout);
        }
        Some(rest)
    }

    fn find_refused(&mut self, layout: &Layout) {
        // Of a name that is used again it is not certain which is meant.
        let mut used: HashSet<&str> = layout.paths.iter().map(|path| path.id()).collect();
        for path in layout.refused.iter().filter(|path| used.insert(path.id)) {
            for level in self.levels.values_mut() {
                level.refused.extend(level.object("edgeId", path.id));
            }
        }
    }

    /// None where it is not what a file of this version has.
    fn parse(text: &'a str, version: Version) -> Option<Self> {
        let mut root: RawObject<'a> = serde_json::from_str(text).ok()?;
        let mut rest = Self {
            key: version.one_of(EDGE_PROPERTIES),
            other_key: version.of(EDGE_PROPERTIES[1], EDGE_PROPERTIES[0]),
            meta: take(&mut root, "metaInformation").unwrap_or_default(),
            ..Self::default()
        };
        match version {
            Version::V1 => {
                rest.add_levels(root.remove("layouts")?)?;
            }
            Version::V2 => {
                let origins: Vec<RawObject<'a>> = raw(root.remove("origins")?)?;
                for mut origin in origins {
                    let levels = rest.add_levels(origin.remove("layouts")?)?;
                    rest.origins.push((object(origin), levels));
                }
            }
        }
        // Those of the other version are read too, and written as these.
        root.retain(|name, _| !matches!(name.as_ref(), "layouts" | "origins"));
        rest.root = object(root);
        Some(rest)
    }

    /// Returns their identifiers.
    fn add_levels(&mut self, list: &'a RawValue) -> Option<Vec<String>> {
        let levels: Vec<RawObject<'a>> = raw(list)?;
        let mut ids = Vec::new();
        for mut members in levels {
            let id: String = take(&mut members, "layoutId")?;
            ids.push(id.clone());
            let mut level = Level::default();
            for (list, id_key) in LISTS {
                let Some(list) = members.remove(list) else {
                    continue;
                };
                let objects = level.objects.entry(id_key).or_default();
                for object in raw::<Vec<&'a RawValue>>(list)? {
                    let Some(id) = id_of(object, id_key) else {
                        continue;
                    };
                    let known = objects.entry(id);
                    // Of a name that is used again it is not certain which is meant.
                    known
                        .and_modify(|known| *known = None)
                        .or_insert(Some(object));
                }
            }
            level.members = object(members);
            let is_used_again = self.levels.contains_key(&id);
            self.levels.insert(
                id,
                if is_used_again {
                    Level::default()
                } else {
                    level
                },
            );
        }
        Some(ids)
    }

    /// Members of a level beside its lists.
    pub(super) fn level(&self, id: &str) -> Object {
        let level = self.levels.get(id);
        level.map(|level| level.members.clone()).unwrap_or_default()
    }

    /// Edges of a level that are no paths, as they were.
    pub(super) fn refused(&self, level: &str) -> impl Iterator<Item = Value> {
        let level = self.levels.get(level);
        let edges = level.map_or(&[][..], |level| &level.refused);
        edges.iter().copied().filter_map(raw)
    }

    /// How many of the paths that are refused are no edges that are kept.
    pub(super) fn lost(&self, layout: &Layout) -> usize {
        let levels = layout.levels.iter();
        let levels = levels.filter_map(|level| self.levels.get(&level.id));
        let kept: usize = levels.map(|level| level.refused.len()).sum();
        layout.refused.len().saturating_sub(kept)
    }

    /// An object of a level as it was, with what is new; none if it was not there.
    pub(super) fn kept(
        &self,
        level: &str,
        id_key: &str,
        id: &str,
        new: &impl Serialize,
    ) -> Option<Object> {
        let old = self.before(level, id_key, id)?;
        match serde_json::to_value(new) {
            Ok(Value::Object(new)) => Some(self.renewed(old, new)),
            _ => None,
        }
    }

    /// What an object was in the file.
    fn before(&self, level: &str, id_key: &str, id: &str) -> Option<Object> {
        let level = self.levels.get(level)?;
        // An edge whose vehicle types have curves of their own was read as a path for each.
        let of_edge = id.rsplit_once(" [").map(|(edge, _)| edge);
        let own = level.object(id_key, id);
        raw(own.or_else(|| level.object(id_key, of_edge?))?)
    }

    fn renewed(&self, mut old: Object, new: Object) -> Object {
        old.remove(self.other_key);
        for (name, new) in new {
            match name.as_str() {
                "nodeId" | "edgeId" | "stationId" | "startNodeId" | "endNodeId"
                | "interactionNodeIds" => {
                    old.insert(name, new);
                }
                "nodePosition" | "stationPosition" => match (old.get_mut(&name), new) {
                    (Some(Value::Object(old)), Value::Object(new)) => old.extend(new),
                    (_, new) => drop(old.insert(name, new)),
                },
                _ if name == self.key => {
                    let mut before = list(old.remove(&name));
                    before.retain(Value::is_object);
                    old.insert(name, curves(&before, list(Some(new))).into());
                }
                _ if NODE_PROPERTIES.contains(&name.as_str()) => {
                    let mut all = list(old.remove(&name));
                    let more = list(Some(new))
                        .into_iter()
                        .filter_map(|entry| without(entry, &all));
                    let more: Vec<Value> = more.collect();
                    all.extend(more);
                    old.insert(name, all.into());
                }
                // The layout has it from there.
                _ => {
                    old.entry(name).or_insert(new);
                }
            }
        }
        old
    }
}

/// What an edge is for its vehicle types: as before, along the curves that it has now.
fn curves(before: &[Value], new: Vec<Value>) -> Vec<Value> {
    let mut all = Vec::new();
    for entry in new {
        let types = types(&entry);
        let is_for_these = |old: &&Value| {
            let own = self::types(old);
            before.len() == 1 || !own.is_empty() && own.iter().all(|name| types.contains(name))
        };
        let mut kept: Vec<Value> = before.iter().filter(is_for_these).cloned().collect();
        for old in kept.iter_mut().filter_map(Value::as_object_mut) {
            match entry.get("trajectory") {
                Some(curve) => old.insert("trajectory".into(), curve.clone()),
                None => old.remove("trajectory"),
            };
        }
        let other = match before.len() {
            1 => None,
            _ => without(entry, &kept),
        };
        all.extend(kept);
        all.extend(other);
    }
    all
}

/// An entry for those of its vehicle types that none of the others is for; none if there are none.
fn without(mut entry: Value, others: &[Value]) -> Option<Value> {
    let known: Vec<String> = others.iter().flat_map(types).collect();
    let is_new = |name: &String| !known.contains(name);
    if others.is_empty() {
        return Some(entry);
    }
    if let Some(robots) = entry
        .get_mut("mobileRobotTypes")
        .and_then(Value::as_array_mut)
    {
        robots.retain(|robot| robot_name(robot).is_none_or(|name| is_new(&name)));
    }
    let types = types(&entry);
    let stands_for_all = types.iter().all(|name| name == ANY_TYPE);
    (!stands_for_all && types.iter().any(is_new)).then_some(entry)
}

/// The vehicle types that an entry is for, as the reader names them.
fn types(entry: &Value) -> Vec<String> {
    let one = entry.get("vehicleTypeId").and_then(Value::as_str);
    let robots = entry.get("mobileRobotTypes").and_then(Value::as_array);
    let robots = robots.into_iter().flatten().filter_map(robot_name);
    one.map(str::to_owned).into_iter().chain(robots).collect()
}

fn robot_name(robot: &Value) -> Option<String> {
    let part = |key| robot.get(key).and_then(Value::as_str);
    model::robot_name(part("manufacturer"), part("seriesName"))
}

fn list(value: Option<Value>) -> Vec<Value> {
    match value {
        Some(Value::Array(list)) => list,
        _ => Vec::new(),
    }
}

fn id_of(object: &RawValue, key: &str) -> Option<String> {
    let mut members: RawObject<'_> = raw(object)?;
    take(&mut members, key)
}

fn take<T: DeserializeOwned>(members: &mut RawObject<'_>, key: &str) -> Option<T> {
    raw(members.remove(key)?)
}

fn raw<'a, T: serde::Deserialize<'a>>(value: &'a RawValue) -> Option<T> {
    serde_json::from_str(value.get()).ok()
}

fn object(members: RawObject<'_>) -> Object {
    let members = members.into_iter();
    let parsed = members.filter_map(|(name, value)| Some((name.into_owned(), raw(value)?)));
    parsed.collect()
}
