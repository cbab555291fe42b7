//! Cells: the values of attributes in the kinds of their columns.

use std::borrow::Cow;

use guideway_layout::{Code, Property, PropertyKind, Value};

use super::attributes::{AttributeField, Scalar};
use super::check::field_place;
use super::scan::push_compact;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn};

/// Kind of the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CellKind {
    Flag,
    Integer,
    Number,
    Text,
    /// One of some texts.
    Choice(&'static [&'static str]),
    /// An array.
    List,
    /// An array or an object.
    Json,
}

impl CellKind {
    /// Returns the kind of a known property.
    pub(crate) fn of(property: &Property) -> Self {
        match property.kind {
            PropertyKind::Number(_) => Self::Number,
            PropertyKind::Integer => Self::Integer,
            PropertyKind::Flag => Self::Flag,
            PropertyKind::Text => Self::Text,
            PropertyKind::Choice(choices) => Self::Choice(choices),
            PropertyKind::List => Self::List,
            PropertyKind::Json => Self::Json,
        }
    }

    fn expected(self) -> &'static str {
        match self {
            Self::Flag => "a boolean",
            Self::Integer => "an integer",
            Self::Number => "a number",
            Self::Text | Self::Choice(_) => "a string",
            Self::List => "an array",
            Self::Json => "an array or an object",
        }
    }
}

/// Value of a cell.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell<'a> {
    Bool(bool),
    Integer(i64),
    Number(f64),
    Text(Cow<'a, str>),
    /// A JSON text without white space between its tokens.
    Json(String),
}

impl Cell<'_> {
    /// The value for a column.
    pub(crate) fn value(&self) -> Value<'_> {
        match self {
            Self::Bool(value) => Value::Bool(*value),
            Self::Integer(value) => Value::Int(*value),
            Self::Number(value) => Value::Float(*value),
            Self::Text(text) => Value::Text(text),
            Self::Json(text) => Value::Json(text),
        }
    }
}

/// A cell of a column, or the reason why there is none.
pub(crate) enum CellResult<'a> {
    Cell(Cell<'a>),
    /// The value is null.
    Absent,
    /// The value has another type, which was reported.
    Unfit,
}

impl Builder<'_> {
    /// Converts the value of an attribute to the kind of its column; reports one of another type,
    /// and a text that is no choice.
    pub(crate) fn cell<'a>(
        &mut self,
        field: &AttributeField<'a>,
        kind: CellKind,
        at: PlaceFn<'_>,
    ) -> Result<CellResult<'a>, ReadError> {
        self.check_text(field.text)?;
        let at: PlaceFn<'_> = &|| field_place(at, field.name);
        let (cell, is_converted) = match (kind, &field.value) {
            (_, Scalar::Null) => return Ok(CellResult::Absent),
            (CellKind::Flag, Scalar::Bool(value)) => (Cell::Bool(*value), false),
            (CellKind::Flag, Scalar::Text(text)) if text.parse::<bool>().is_ok() => {
                (Cell::Bool(text == "true"), true)
            }
            (CellKind::Integer, Scalar::Integer(value)) => (Cell::Integer(*value), false),
            (CellKind::Number, Scalar::Integer(value)) => (Cell::Number(*value as f64), false),
            (CellKind::Number, Scalar::Number(value)) => (Cell::Number(*value), false),
            (CellKind::Number, Scalar::Text(text)) => match finite(text) {
                Some(value) => (Cell::Number(value), true),
                None => return Ok(self.unfit(field, kind, at)),
            },
            (CellKind::Text | CellKind::Choice(_), Scalar::Text(text)) => {
                (Cell::Text(text.clone()), false)
            }
            (CellKind::Text, Scalar::Integer(_) | Scalar::Number(_)) => {
                (Cell::Text(field.text.into()), true)
            }
            (CellKind::Json, Scalar::Json(text)) => (Cell::Json(compact(text)), false),
            (CellKind::List, Scalar::Json(text)) if text.starts_with('[') => {
                (Cell::Json(compact(text)), false)
            }
            _ => return Ok(self.unfit(field, kind, at)),
        };
        if is_converted {
            let remedy = "The value is converted; correct the application that wrote the file";
            self.report_type(field, kind, at, remedy);
        }
        if let (CellKind::Choice(choices), Cell::Text(text)) = (kind, &cell)
            && !choices.contains(&text.as_ref())
        {
            let message = || format!("`{text}` is none of {}", choices.join(", "));
            let remedy = "The value is kept as it is; correct the application that wrote the file";
            self.report(Code::UnknownValue, at, message, remedy);
        }
        Ok(CellResult::Cell(cell))
    }

    fn unfit<'a>(
        &mut self,
        field: &AttributeField<'_>,
        kind: CellKind,
        at: PlaceFn<'_>,
    ) -> CellResult<'a> {
        let remedy = "The value is not used; correct the application that wrote the file";
        self.report_type(field, kind, at, remedy);
        CellResult::Unfit
    }

    fn report_type(
        &mut self,
        field: &AttributeField<'_>,
        kind: CellKind,
        at: PlaceFn<'_>,
        remedy: &str,
    ) {
        let message = || {
            let found = field.value.json_type();
            format!("expected {}, found {found}", kind.expected())
        };
        self.report(Code::WrongType, at, message, remedy);
    }
}

fn finite(text: &str) -> Option<f64> {
    let number: f64 = text.trim().parse().ok()?;
    number.is_finite().then_some(number)
}

fn compact(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    push_compact(text, &mut out);
    out
}
