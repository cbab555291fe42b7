//! Columns of a query: built-in properties and attributes of paths.

use guideway_layout::{Direction, Layout, Value};

/// The left side of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Id,
    Level,
    Direction,
    VehicleType,
    Length,
    /// An attribute of the file, by name.
    Attribute(String),
}

/// Columns that every layout has. An attribute of the same name takes precedence.
const BUILT_IN: [(&str, Column); 5] = [
    ("id", Column::Id),
    ("level", Column::Level),
    ("direction", Column::Direction),
    ("vehicle_type", Column::VehicleType),
    ("length_m", Column::Length),
];

impl Column {
    /// The column of this name, if the layout has it.
    pub(super) fn named(name: &str, layout: &Layout) -> Option<Self> {
        if layout.paths.has_column(name) {
            return Some(Self::Attribute(name.to_owned()));
        }
        let built_in = BUILT_IN.into_iter().find(|(known, _)| *known == name);
        built_in.map(|(_, column)| column)
    }

    /// Names of all columns of a layout, for error texts.
    pub(super) fn names(layout: &Layout) -> Vec<String> {
        let built_in = BUILT_IN.iter().map(|(name, _)| (*name).to_owned());
        let own = layout.paths.column_names().map(str::to_owned);
        built_in.chain(own).collect()
    }

    /// Passes the value of a path to `read`; `None` if it has none.
    pub(super) fn with_value<R>(
        &self,
        layout: &Layout,
        path: u32,
        read: impl FnOnce(Value<'_>) -> R,
    ) -> Option<R> {
        let row = path as usize;
        let path = layout.paths.get(row);
        match self {
            Self::Id => Some(read(Value::Text(path.id()))),
            Self::Level => {
                let level = &layout.levels[path.level()? as usize];
                Some(read(Value::Text(level.name.as_ref().unwrap_or(&level.id))))
            }
            Self::Direction => Some(read(Value::Text(direction_name(path.direction())))),
            Self::VehicleType => {
                let types: Vec<_> = layout.paths.vehicle_types().of(row).collect();
                (!types.is_empty()).then(|| read(Value::Text(&types.join(", "))))
            }
            Self::Length => Some(read(Value::Float(path.length_m()))),
            Self::Attribute(name) => {
                let value = layout.paths.value(row, name)?;
                Some(read(value))
            }
        }
    }
}

/// A direction as text, the same as in legends.
fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Forward => "one way",
        Direction::Both => "both ways",
    }
}
