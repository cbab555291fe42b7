//! Resolves the elements that a step selects: `"all"`, a list of names, or a query.

use std::collections::HashMap;

use guideway_document::{Document, Elements, PathSet, Query};
use guideway_scene::Table;
use serde_json::Value;

use super::error::StepError;
use super::members::{Members, wrong};
use super::step::{Member, optional};

/// Form of a selection of paths.
const PATHS_FORM: &str = "\"all\", [\"NAME\", ...] or {\"query\": \"...\"}";
/// Form of a selection of nodes or stations.
const FORM: &str = "\"all\" or [\"NAME\", ...]";

/// The member that selects paths.
pub(super) const PATHS: Member = optional("paths", PATHS_FORM, "The paths.");
/// The member that selects nodes.
pub(super) const NODES: Member = optional("nodes", FORM, "The nodes.");
/// The member that selects stations.
pub(super) const STATIONS: Member = optional("stations", FORM, "The stations.");

impl Members<'_> {
    /// The selected elements; at least one table must be named.
    pub(super) fn elements(&self, document: &Document) -> Result<Elements, StepError> {
        let names = ["paths", "nodes", "stations"];
        if names.iter().all(|name| self.get(name).is_none()) {
            return Err(StepError::of_member(
                "paths",
                "the step selects nothing",
                "Add `paths`, `nodes` or `stations`",
            ));
        }
        Ok(Elements {
            paths: self.rows("paths", Table::Paths, document)?,
            nodes: self.rows("nodes", Table::Nodes, document)?,
            stations: self.rows("stations", Table::Stations, document)?,
            ..Elements::default()
        })
    }

    /// The row of the element that a member names.
    pub(super) fn element(
        &self,
        name: &'static str,
        of: Table,
        document: &Document,
    ) -> Result<u32, StepError> {
        row_named(name, of, self.text(name)?, document)
    }

    /// As [`Self::element`]; `None` if the member is absent.
    pub(super) fn optional_element(
        &self,
        name: &'static str,
        of: Table,
        document: &Document,
    ) -> Result<Option<u32>, StepError> {
        let named = self.get(name).map(|_| self.element(name, of, document));
        named.transpose()
    }

    /// The selected paths.
    pub(super) fn paths(&self, document: &Document) -> Result<PathSet, StepError> {
        Ok(self.elements(document)?.paths)
    }

    fn rows(
        &self,
        member: &'static str,
        of: Table,
        document: &Document,
    ) -> Result<PathSet, StepError> {
        let form = match of {
            Table::Paths => PATHS_FORM,
            Table::Nodes | Table::Stations => FORM,
        };
        match self.get(member) {
            None => Ok(PathSet::new()),
            Some(Value::String(all)) if all == "all" => Ok(document.existing(of).collect()),
            Some(Value::Array(_)) => named(member, of, &self.texts(member)?, document),
            Some(Value::Object(query)) if of == Table::Paths => match query.get("query") {
                Some(Value::String(text)) if query.len() == 1 => queried(member, text, document),
                _ => Err(wrong(member, form, &Value::Object(query.clone()))),
            },
            Some(other) => Err(wrong(member, form, other)),
        }
    }
}

/// The rows of all elements with these names; each name must exist.
fn named(
    member: &'static str,
    of: Table,
    names: &[&str],
    document: &Document,
) -> Result<PathSet, StepError> {
    let layout = document.layout();
    let mut rows: HashMap<&str, Vec<u32>> = names.iter().map(|name| (*name, Vec::new())).collect();
    for row in document.existing(of) {
        if let Some(rows) = rows.get_mut(of.id(layout, row)) {
            rows.push(row);
        }
    }
    match names.iter().find(|name| rows[**name].is_empty()) {
        Some(unknown) => Err(unknown_name(member, of, unknown)),
        None => Ok(rows.into_values().flatten().collect()),
    }
}

fn queried(member: &'static str, text: &str, document: &Document) -> Result<PathSet, StepError> {
    let query = Query::parse(text, document.layout()).map_err(|error| {
        let remedy = "Write a query such as maxSpeed > 1.5 and level = \"hall\"";
        StepError::of_member(member, format!("query, {error}"), remedy)
    })?;
    let found = query.rows(document.layout());
    let exists = |&row: &u32| document.scene().exists(Table::Paths, row);
    Ok(found.iter().filter(exists).collect())
}

/// The row of the only element with this name.
pub(super) fn row_named(
    member: &'static str,
    of: Table,
    name: &str,
    document: &Document,
) -> Result<u32, StepError> {
    let rows = named(member, of, &[name], document)?;
    match (rows.len(), rows.min()) {
        (1, Some(row)) => Ok(row),
        (count, _) => Err(StepError::of_member(
            member,
            format!("{count} {}s are called `{name}`", of.element()),
            "Give each a name of its own first",
        )),
    }
}

fn unknown_name(member: &'static str, of: Table, name: &str) -> StepError {
    let what = of.element();
    StepError::of_member(
        member,
        format!("no {what} is called `{name}`"),
        format!("Name a {what} that exists; `guideway info` and the window list them"),
    )
}
