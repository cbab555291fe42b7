//! Merge of an object of the file with its new state: keeps unmodeled members, replaces
//! identifiers, positions and curves.

use serde::Serialize;
use serde_json::Value;

use super::raw::Object;
use super::unmodeled::Unmodeled;
use crate::lif::model::{self, ANY_TYPE, NODE_PROPERTIES};

/// Merges an object of a level with its new state; `None` if the file does not contain it.
pub(in crate::lif) fn merge(
    unmodeled: &Unmodeled<'_>,
    level: &str,
    id_key: &str,
    id: &str,
    new: &impl Serialize,
) -> Option<Object> {
    let old = unmodeled.object(level, id_key, id)?;
    match serde_json::to_value(new) {
        Ok(Value::Object(new)) => Some(merge_members(unmodeled, old, new)),
        _ => None,
    }
}

fn merge_members(unmodeled: &Unmodeled<'_>, mut old: Object, new: Object) -> Object {
    old.remove(unmodeled.other_edge_key);
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
            _ if name == unmodeled.edge_key => {
                let mut before = array(old.remove(&name));
                before.retain(Value::is_object);
                old.insert(name, merge_entries(&before, array(Some(new))).into());
            }
            _ if NODE_PROPERTIES.contains(&name.as_str()) => {
                let mut all = array(old.remove(&name));
                let added = array(Some(new))
                    .into_iter()
                    .filter_map(|entry| restrict_to_uncovered(entry, &all));
                let added: Vec<Value> = added.collect();
                all.extend(added);
                old.insert(name, all.into());
            }
            // The layout has the value from this member.
            _ => {
                old.entry(name).or_insert(new);
            }
        }
    }
    old
}

/// Merges the entries of an edge: the old entries, with the new curves of their vehicle types.
fn merge_entries(before: &[Value], new: Vec<Value>) -> Vec<Value> {
    let mut all = Vec::new();
    for entry in new {
        let types = types(&entry);
        let is_covered = |old: &&Value| {
            let old_types = self::types(old);
            before.len() == 1
                || !old_types.is_empty() && old_types.iter().all(|name| types.contains(name))
        };
        let mut retained: Vec<Value> = before.iter().filter(is_covered).cloned().collect();
        for old in retained.iter_mut().filter_map(Value::as_object_mut) {
            match entry.get("trajectory") {
                Some(curve) => old.insert("trajectory".into(), curve.clone()),
                None => old.remove("trajectory"),
            };
        }
        let other = match before.len() {
            1 => None,
            _ => restrict_to_uncovered(entry, &retained),
        };
        all.extend(retained);
        all.extend(other);
    }
    all
}

/// Restricts an entry to the vehicle types that no other entry covers; `None` if all are covered.
fn restrict_to_uncovered(mut entry: Value, others: &[Value]) -> Option<Value> {
    let covered: Vec<String> = others.iter().flat_map(types).collect();
    let is_uncovered = |name: &String| !covered.contains(name);
    if others.is_empty() {
        return Some(entry);
    }
    if let Some(robots) = entry
        .get_mut("mobileRobotTypes")
        .and_then(Value::as_array_mut)
    {
        robots.retain(|robot| robot_name(robot).is_none_or(|name| is_uncovered(&name)));
    }
    let types = types(&entry);
    let is_any_type = types.iter().all(|name| name == ANY_TYPE);
    (!is_any_type && types.iter().any(is_uncovered)).then_some(entry)
}

/// Returns the vehicle types of an entry, as the reader names them.
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

fn array(value: Option<Value>) -> Vec<Value> {
    match value {
        Some(Value::Array(items)) => items,
        _ => Vec::new(),
    }
}
