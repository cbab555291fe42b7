//! Layouts as files: saves the open one, and compares it with another.

use std::collections::BTreeMap;
use std::path::PathBuf;

use guideway::formats::{Target, WriteError};
use guideway::layout::{Changes, CompareOptions, ElementChange, UserError, changes};
use serde_json::{Value, json};

use crate::look::usage;
use crate::session::Session;

/// A file that was written.
#[derive(Debug)]
pub struct Saved {
    /// The content of the file.
    pub bytes: Vec<u8>,
    /// The losses: a sentence for each thing that the format cannot hold, as JSON.
    pub losses: String,
}

impl Session {
    /// The layout in a format, such as `lif`.
    ///
    /// # Errors
    /// When no format has this name, or the layout is none that it can hold.
    pub fn save(&self, format: &str) -> Result<Saved, UserError> {
        let target = Target::from_id(format)
            .ok_or_else(|| usage(format!("no format is called `{format}`")))?;
        let mut bytes = Vec::new();
        let losses = target.write(&self.layout, &mut bytes);
        let losses = losses.map_err(|problem| WriteError {
            path: PathBuf::from(&self.name),
            problem,
        })?;
        let losses: Vec<String> = losses.iter().map(ToString::to_string).collect();
        Ok(Saved {
            bytes,
            losses: json!(losses).to_string(),
        })
    }

    /// The changes from this layout to another one, as JSON.
    pub fn diff(&self, other: &Self, most: usize) -> String {
        let found = changes(&self.layout, &other.layout, &CompareOptions::default());
        differences(&found, most).to_string()
    }
}

/// Counts of the changes, and the first ones.
fn differences(found: &Changes<'_>, most: usize) -> Value {
    let mut counts: BTreeMap<(&str, &str), u64> = BTreeMap::new();
    for of in found.elements.iter() {
        *counts
            .entry((of.element.name(), of.change.name()))
            .or_default() += 1;
    }
    let counts = counts.into_iter().map(|((element, change), count)| {
        json!({ "element": element, "change": change, "count": count })
    });
    let shown = found.elements.iter().take(most);
    let groups = found.groups.iter();
    let groups = groups.map(|of| json!({ "what": of.what, "example": of.example }));
    json!({
        "counts": counts.collect::<Vec<_>>(),
        "changes": shown.map(|of| change(found, &of)).collect::<Vec<_>>(),
        "groups": groups.collect::<Vec<_>>(),
    })
}

fn change(found: &Changes<'_>, of: &ElementChange) -> Value {
    let values = found.values(of);
    json!({
        "element": of.element.name(),
        "id": found.id(of),
        "newId": found.new_id(of),
        "change": of.change.name(),
        "newRow": of.new_row(),
        "column": values.as_ref().map(|values| values.property.to_owned()),
        "before": values.as_ref().and_then(|values| Some(values.before.as_ref()?.to_string())),
        "after": values.as_ref().and_then(|values| Some(values.after.as_ref()?.to_string())),
    })
}
