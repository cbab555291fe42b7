//! Random operations on levels and vehicle types, for the laws of random networks.

use guideway_document::{Document, LevelContent, LevelFacts, TypeUse};
use guideway_layout::Value;
use proptest::prelude::*;

const TYPES: [&str; 4] = ["tug", "fork", "crane", "stacker"];

/// An operation on levels or vehicle types, by rows and names of which most exist.
#[derive(Clone, Debug)]
pub(crate) enum GroupAction {
    CreateLevel(u8, Option<i8>),
    ChangeLevel(u32, u8, Option<i8>),
    SetLevelProperty(u32, Option<i8>),
    DeleteLevel(u32, LevelContent),
    CreateType(usize),
    RenameType(usize, usize),
    SetTypeProperty(usize, Option<i8>),
    DeleteType(usize, Option<Option<usize>>),
}

pub(crate) fn group_action() -> impl Strategy<Value = GroupAction> {
    let row = || 0..5u32;
    let name = || 0..TYPES.len();
    let content = prop_oneof![
        Just(LevelContent::Keep),
        Just(LevelContent::Delete),
        prop::option::of(0..5u32).prop_map(LevelContent::MoveTo),
    ];
    prop_oneof![
        (any::<u8>(), any::<Option<i8>>()).prop_map(|(id, h)| GroupAction::CreateLevel(id, h)),
        (row(), any::<u8>(), any::<Option<i8>>())
            .prop_map(|(row, id, h)| GroupAction::ChangeLevel(row, id, h)),
        (row(), any::<Option<i8>>()).prop_map(|(row, v)| GroupAction::SetLevelProperty(row, v)),
        (row(), content).prop_map(|(row, content)| GroupAction::DeleteLevel(row, content)),
        name().prop_map(GroupAction::CreateType),
        (name(), name()).prop_map(|(old, new)| GroupAction::RenameType(old, new)),
        (name(), any::<Option<i8>>()).prop_map(|(of, v)| GroupAction::SetTypeProperty(of, v)),
        (name(), prop::option::of(prop::option::of(name())))
            .prop_map(|(of, with)| GroupAction::DeleteType(of, with)),
    ]
}

impl GroupAction {
    /// Tries the operation; a rejected one must change nothing.
    pub(crate) fn perform(&self, document: &mut Document) {
        let height_m = |height: Option<i8>| height.map(|height| f64::from(height) / 4.0);
        let value = |value: Option<i8>| value.map(|value| Value::Float(f64::from(value)));
        match *self {
            Self::CreateLevel(id, height) => {
                let id = format!("level {id}");
                drop(document.create_level(&facts(Some(&id), height_m(height))));
            }
            Self::ChangeLevel(row, id, height) => {
                let (id, height_m) = (format!("level {id}"), height_m(height));
                let facts = LevelFacts {
                    name: Some(&id),
                    ..facts(Some(&id), height_m)
                };
                drop(document.change_level(row, &facts));
            }
            Self::SetLevelProperty(row, v) => {
                let facts = LevelFacts {
                    properties: &[("load", value(v))],
                    ..LevelFacts::default()
                };
                drop(document.change_level(row, &facts));
            }
            Self::DeleteLevel(row, content) => drop(document.delete_level(row, content)),
            Self::CreateType(name) => drop(document.create_vehicle_type(TYPES[name], &[])),
            Self::RenameType(old, new) => {
                drop(document.change_vehicle_type(TYPES[old], TYPES[new], &[]));
            }
            Self::SetTypeProperty(of, v) => {
                let speed = [("maxSpeed", value(v))];
                drop(document.change_vehicle_type(TYPES[of], TYPES[of], &speed));
            }
            Self::DeleteType(name, with) => {
                let uses = match with {
                    None => TypeUse::Keep,
                    Some(None) => TypeUse::Remove,
                    Some(Some(other)) => TypeUse::Replace(TYPES[other]),
                };
                drop(document.delete_vehicle_type(TYPES[name], uses));
            }
        }
    }
}

/// Facts without a name for people.
pub(crate) fn facts(id: Option<&str>, elevation_m: Option<f64>) -> LevelFacts<'_> {
    LevelFacts {
        id,
        elevation_m,
        ..LevelFacts::default()
    }
}
