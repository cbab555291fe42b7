//! Reads the members of a step as texts, numbers, points and references.

use std::path::{Path, PathBuf};

use guideway_document::Document;
use guideway_formats::ReadOptions;
use guideway_spline::Point;
use serde_json::{Map, Value};

use super::error::StepError;

/// The members of a step, without `do`.
pub(super) struct Members<'a> {
    pub(super) members: &'a Map<String, Value>,
    pub(super) folder: &'a Folder<'a>,
}

/// The folder from which a script names files, and how they are read.
pub(super) struct Folder<'a> {
    pub(super) path: &'a Path,
    pub(super) options: &'a ReadOptions<'a>,
}

impl<'a> Members<'a> {
    /// A member; `None` if it is absent.
    pub(super) fn get(&self, name: &str) -> Option<&'a Value> {
        self.members.get(name)
    }

    pub(super) fn text(&self, name: &'static str) -> Result<&'a str, StepError> {
        self.optional_text(name)?
            .ok_or_else(|| missing(name, "a text"))
    }

    pub(super) fn optional_text(&self, name: &'static str) -> Result<Option<&'a str>, StepError> {
        match self.get(name) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(wrong(name, "a text", other)),
        }
    }

    pub(super) fn texts(&self, name: &'static str) -> Result<Vec<&'a str>, StepError> {
        let texts = match self.get(name) {
            None => return Ok(Vec::new()),
            Some(Value::Array(texts)) => texts,
            Some(other) => return Err(wrong(name, "a list of texts", other)),
        };
        let text = |value: &'a Value| {
            value
                .as_str()
                .ok_or_else(|| wrong(name, "a list of texts", value))
        };
        texts.iter().map(text).collect()
    }

    pub(super) fn flag(&self, name: &'static str) -> Result<bool, StepError> {
        match self.get(name) {
            None => Ok(false),
            Some(Value::Bool(flag)) => Ok(*flag),
            Some(other) => Err(wrong(name, "true or false", other)),
        }
    }

    pub(super) fn number(&self, name: &'static str) -> Result<f64, StepError> {
        match self.get(name) {
            None => Err(missing(name, "a number")),
            Some(value) => value.as_f64().ok_or_else(|| wrong(name, "a number", value)),
        }
    }

    pub(super) fn optional_number(&self, name: &'static str) -> Result<Option<f64>, StepError> {
        self.get(name).map(|_| self.number(name)).transpose()
    }

    /// Positions in meters.
    pub(super) fn points(&self, name: &'static str) -> Result<Vec<Point<f64>>, StepError> {
        let points: &[Value] = match self.get(name) {
            None => &[],
            Some(Value::Array(points)) => points,
            Some(other) => return Err(wrong(name, "a list of points", other)),
        };
        let point = |value: &Value| {
            point_of(value).ok_or_else(|| wrong(name, "a list of points [x, y] in m", value))
        };
        points.iter().map(point).collect()
    }

    /// A whole number from 1 to `most`.
    pub(super) fn count(&self, name: &'static str, most: u32) -> Result<u32, StepError> {
        let Some(value) = self.get(name) else {
            return Ok(1);
        };
        let count = value.as_u64().and_then(|n| u32::try_from(n).ok());
        let count = count.filter(|n| (1..=most).contains(n));
        count.ok_or_else(|| wrong(name, &format!("a whole number from 1 to {most}"), value))
    }

    /// A position or a vector in meters.
    pub(super) fn point(&self, name: &'static str) -> Result<Point<f64>, StepError> {
        self.optional_point(name)?
            .ok_or_else(|| missing(name, "two numbers in meters"))
    }

    pub(super) fn optional_point(
        &self,
        name: &'static str,
    ) -> Result<Option<Point<f64>>, StepError> {
        let Some(value) = self.get(name) else {
            return Ok(None);
        };
        let point = point_of(value).map(Some);
        point.ok_or_else(|| wrong(name, "two numbers in meters, such as [12.5, -3]", value))
    }

    /// The index of the level that a member names; `None` if it is absent.
    pub(super) fn level(
        &self,
        name: &'static str,
        document: &Document,
    ) -> Result<Option<u32>, StepError> {
        let Some(level) = self.optional_text(name)? else {
            return Ok(None);
        };
        let layout = document.layout();
        layout.level_named(level).map(Some).ok_or_else(|| {
            let known: Vec<&str> = layout
                .levels
                .iter()
                .map(|level| level.id.as_str())
                .collect();
            let remedy = match known.is_empty() {
                true => "Leave it out: the layout has no levels".to_owned(),
                false => format!("Choose one of {}", known.join(", ")),
            };
            StepError::of_member(name, format!("no level is called `{level}`"), remedy)
        })
    }

    /// A file, from the folder of the script.
    pub(super) fn file(&self, name: &'static str) -> Result<PathBuf, StepError> {
        Ok(self.folder.path.join(self.text(name)?))
    }
}

fn point_of(value: &Value) -> Option<Point<f64>> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
    match numbers?.as_slice() {
        &[x, y] => Some(Point::new(x, y)),
        _ => None,
    }
}

fn missing(name: &'static str, form: &str) -> StepError {
    StepError::of_member(name, "is missing", format!("Add it, as {form}"))
}

pub(super) fn wrong(name: &'static str, form: &str, value: &Value) -> StepError {
    let mut value = value.to_string();
    if value.chars().count() > 60 {
        value = value.chars().take(60).collect::<String>() + "...";
    }
    StepError::of_member(
        name,
        format!("{value} is not {form}"),
        format!("Write {form}"),
    )
}
