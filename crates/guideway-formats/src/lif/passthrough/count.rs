//! Count of the objects with unmodeled members: the losses of a write to another format.

use guideway_layout::Layout;
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::raw::{Object, parse};
use super::unmodeled::{Level, Unmodeled};
use crate::lif::model::{EDGE_PROPERTIES, NODE_PROPERTIES};
use crate::lif::version::Version;

/// Counts the levels, nodes, edges and stations of a LIF file with members that the model does not
/// hold; all of them if the layout does not keep the text.
pub(crate) fn count_unmodeled(layout: &Layout) -> usize {
    let provenance = &layout.provenance;
    if !provenance
        .format
        .split(" + ")
        .any(|format| format == crate::Format::Lif.name())
    {
        return 0;
    }
    let Some(text) = provenance.text.as_deref() else {
        return layout.nodes.len() + layout.paths.len() + layout.stations.len();
    };
    let files = [Version::V1, Version::V2].map(|version| Unmodeled::parse(text, version));
    let levels = files.iter().flatten().flat_map(|file| file.levels.values());
    levels.map(count_in_level).sum()
}

fn count_in_level(level: &Level<'_>) -> usize {
    let has_unmodeled = |id_key: &str, object: Option<&RawValue>| {
        let Some(object) = object else {
            return true;
        };
        let mut members = parse::<Object>(object).into_iter().flatten();
        members.any(|(name, value)| !is_modeled(id_key, &name, &value))
    };
    let counts = level.objects.iter().map(|(id_key, objects)| {
        let objects = objects
            .values()
            .filter(|object| has_unmodeled(id_key, **object));
        objects.count()
    });
    let has_members = level.members.keys().any(|name| name != "layoutName");
    counts.sum::<usize>() + usize::from(has_members)
}

/// Returns whether the model holds a member of an object.
fn is_modeled(id_key: &str, name: &str, value: &Value) -> bool {
    match (id_key, name) {
        _ if name == id_key => true,
        ("nodeId", "nodeName" | "mapId") => true,
        ("nodeId" | "stationId", "nodePosition" | "stationPosition") => {
            let members = value.as_object().into_iter().flatten();
            members
                .into_iter()
                .all(|(name, _)| matches!(name.as_str(), "x" | "y"))
        }
        ("stationId", "interactionNodeIds" | "stationName" | "stationType" | "stationHeight") => {
            true
        }
        ("edgeId", "startNodeId" | "endNodeId") => true,
        (_, name) if NODE_PROPERTIES.contains(&name) => {
            let entries = value.as_array().into_iter().flatten();
            let mut names = entries.filter_map(Value::as_object).flat_map(Map::keys);
            names.all(|name| matches!(name.as_str(), "vehicleTypeId" | "mobileRobotTypes"))
        }
        (_, name) if EDGE_PROPERTIES.contains(&name) => {
            let entries = value.as_array().into_iter().flatten();
            let mut members = entries.filter_map(Value::as_object).flatten();
            members
                .all(|(name, value)| !name.contains("ctions") || value == &Value::Array(Vec::new()))
        }
        _ => false,
    }
}
