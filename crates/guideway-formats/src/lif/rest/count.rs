//! What of a file is lost where it is not kept.

use guideway_layout::Layout;
use serde_json::value::RawValue;
use serde_json::{Map, Value};

use super::super::model::{EDGE_PROPERTIES, NODE_PROPERTIES};
use super::super::write_columns::Version;
use super::{Level, Object, Rest, raw};

/// Of what a file of LIF lists, what has members that a layout has not; all of it where the text is not kept.
pub(crate) fn count_beside(layout: &Layout) -> usize {
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
    let rest = [Version::V1, Version::V2].map(|version| Rest::parse(text, version));
    let levels = rest.iter().flatten().flat_map(|rest| rest.levels.values());
    levels.map(of_level).sum()
}

fn of_level(level: &Level<'_>) -> usize {
    let has_more = |id_key: &str, object: Option<&RawValue>| {
        let Some(object) = object else {
            return true;
        };
        let members = raw::<Object>(object).into_iter().flatten();
        let mut members = members.map(|(name, value)| is_held(id_key, &name, &value));
        members.any(|is_held| !is_held)
    };
    let lists = level.objects.iter().map(|(id_key, objects)| {
        let more = objects.values().filter(|object| has_more(id_key, **object));
        more.count()
    });
    let has_members = level.members.keys().any(|name| name != "layoutName");
    lists.sum::<usize>() + usize::from(has_members)
}

/// Whether a layout has a member of an object.
fn is_held(id_key: &str, name: &str, value: &Value) -> bool {
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
