//! [`Field`]: a column of a layout that features carry, found once and not per path.

use guideway_layout::{Layout, PathRef, Value, Values};

/// A field of features.
pub(crate) struct Field<'a> {
    name: &'a str,
    source: Source<'a>,
}

enum Source<'a> {
    Id,
    Level(&'a Layout),
    /// A column with a value per path.
    Own(&'a Values),
    /// A column whose values may be those of vehicle types.
    Named,
}

impl<'a> Field<'a> {
    /// The field of a name that the layout has.
    pub(super) fn new(layout: &'a Layout, name: &'a str) -> Self {
        let types = &layout.paths.vehicle_types().attributes;
        let own = layout.paths.attributes.get(name);
        let source = match (name, own) {
            ("id", _) => Source::Id,
            ("level", _) => Source::Level(layout),
            (_, Some(own)) if types.get(name).is_none() => Source::Own(&own.values),
            _ => Source::Named,
        };
        Self { name, source }
    }

    pub(super) fn name(&self) -> &'a str {
        self.name
    }

    /// Returns `true` if paths hardly share a value.
    pub(super) fn is_unique(&self) -> bool {
        matches!(self.source, Source::Id)
    }

    /// The value of a path.
    pub(super) fn value<'v>(&'v self, path: PathRef<'v>) -> Option<Value<'v>> {
        match self.source {
            Source::Id => Some(Value::Text(path.id())),
            Source::Level(layout) => {
                let level = path.level()?;
                Some(Value::Text(layout.levels[level as usize].id.as_str()))
            }
            Source::Own(values) => values.get(path.row()),
            Source::Named => path.attribute(self.name),
        }
    }
}
