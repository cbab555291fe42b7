use guideway_layout::{Direction, Layout, Value};

use crate::measure::length_m;

/// What a comparison looks at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Id,
    Level,
    Direction,
    VehicleType,
    Length,
    /// One of the file, by name.
    Attribute(String),
}

/// Columns that every layout has. One of the file comes before one of these of the same name.
const BUILT_IN: [(&str, Column); 5] = [
    ("id", Column::Id),
    ("level", Column::Level),
    ("direction", Column::Direction),
    ("vehicle_type", Column::VehicleType),
    ("length_m", Column::Length),
];

impl Column {
    pub(super) fn named(name: &str, layout: &Layout) -> Option<Self> {
        if layout.paths.attributes.get(name).is_some() {
            return Some(Self::Attribute(name.to_owned()));
        }
        let built_in = BUILT_IN.into_iter().find(|(known, _)| *known == name);
        built_in.map(|(_, column)| column)
    }

    /// Names of all columns of a layout.
    pub(super) fn names(layout: &Layout) -> Vec<String> {
        let built_in = BUILT_IN.iter().map(|(name, _)| (*name).to_owned());
        let own = layout.paths.attributes.iter().map(|a| a.name.clone());
        built_in.chain(own).collect()
    }

    /// Shows the value of a path to `look`, if it has one.
    pub(super) fn with_value<R>(
        &self,
        layout: &Layout,
        path: u32,
        look: impl FnOnce(Value<'_>) -> R,
    ) -> Option<R> {
        let row = path as usize;
        let it = layout.paths.get(row);
        match self {
            Self::Id => Some(look(Value::Text(it.id()))),
            Self::Level => {
                let level = &layout.levels[it.level()? as usize];
                Some(look(Value::Text(level.name.as_ref().unwrap_or(&level.id))))
            }
            Self::Direction => Some(look(Value::Text(direction_name(it.direction())))),
            Self::VehicleType => {
                let types: Vec<_> = layout.paths.vehicle_types().of(row).collect();
                (!types.is_empty()).then(|| look(Value::Text(&types.join(", "))))
            }
            Self::Length => Some(look(Value::Float(length_m(it)))),
            Self::Attribute(name) => {
                let value = layout.paths.attributes.get(name)?.values.get(row)?;
                Some(look(value))
            }
        }
    }
}

/// A direction as a person reads it, here and in a legend.
pub(crate) fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Forward => "one way",
        Direction::Both => "both ways",
    }
}
