//! [`Level`]: a floor of the layout.

use crate::Attributes;

/// A floor of a building, or one layout of a file that has several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Level {
    /// Identifier in the file.
    pub id: String,
    /// Human-readable name.
    pub name: Option<String>,
    /// Height above the ground in meters, if the file states it.
    pub elevation_m: Option<f64>,
    /// Further properties, in one row.
    pub attributes: Attributes,
    /// Number of its object in the file from 0 on, for formats whose writer copies what did not
    /// change.
    pub source: Option<u32>,
}

impl Level {
    /// Its name, or its identifier where it has none.
    pub fn name_or_id(&self) -> &str {
        self.name.as_deref().unwrap_or(&self.id)
    }
}
