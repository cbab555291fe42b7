//! Conversion of values of columns to members of an order: as they are, in another form, or not at
//! all.

use std::f64::consts::PI;

use guideway_layout::Value;

use super::actions::complete;
use super::members::{Member, REFERENCE_POINT};
use super::version::Version;
use crate::json::{CellKind, Tree};

/// Greatest angle of the schemas, in radians: pi as they write it.
#[allow(
    clippy::approx_constant,
    reason = "the schemas cut pi after eleven digits"
)]
const MAX_ANGLE: f64 = 3.141_592_653_59;

/// Column of the radius in which a vehicle has arrived: a number up to 2.1, an ellipse from 3.0 on.
const DEVIATION: &str = "allowedDeviationXY";

/// A value of a member.
pub(super) struct Held<'a> {
    pub(super) tree: Tree<'a>,
    /// True if a reader gets another value for the column.
    pub(super) is_changed: bool,
}

impl<'a> Held<'a> {
    fn same(tree: Tree<'a>) -> Option<Self> {
        Some(Self {
            tree,
            is_changed: false,
        })
    }

    fn changed(tree: Tree<'a>) -> Option<Self> {
        Some(Self {
            tree,
            is_changed: true,
        })
    }
}

/// The format that values are converted for.
#[derive(Clone, Copy)]
pub(super) struct Form {
    pub(super) version: Version,
    /// True for a file of the same version, whose values need not follow the schema.
    pub(super) is_as_written: bool,
}

impl Form {
    /// Converts a value; `None` if the member cannot hold it. `owner` makes the identifiers of
    /// actions unique.
    pub(super) fn convert<'a>(
        self,
        member: &Member,
        value: Value<'a>,
        owner: &str,
    ) -> Option<Held<'a>> {
        match (member.kind, value) {
            (CellKind::Flag, Value::Bool(value)) => Held::same(Tree::Bool(value)),
            (CellKind::Integer, Value::Int(value)) => {
                Held::same(Tree::Raw(value.to_string().into()))
            }
            (CellKind::Number, Value::Int(value)) => self.number(member, value as f64),
            (CellKind::Number, Value::Float(value)) => self.number(member, value),
            (CellKind::Number, Value::Json(text)) if member.column == DEVIATION => {
                Held::changed(Tree::number(radius(text)?)?)
            }
            (CellKind::Text, Value::Text(text)) => Held::same(Tree::Text(text.into())),
            (CellKind::Choice(choices), Value::Text(text)) => {
                let text = match (member.name, text) {
                    (REFERENCE_POINT, "KINEMATICCENTER") => "KINEMATIC_CENTER",
                    (_, text) => text,
                };
                let fits = self.is_as_written || choices.contains(&text);
                fits.then(|| Held::same(Tree::Text(text.into())))?
            }
            (CellKind::List, Value::Json(text)) if text.starts_with('[') => {
                Held::same(Tree::Raw(text.into()))
            }
            (CellKind::Json, Value::Float(radius)) if member.column == DEVIATION => {
                let radius = Tree::number(radius).filter(|_| radius >= 0.0)?;
                Held::changed(Tree::Object(vec![
                    ("a".into(), radius.clone()),
                    ("b".into(), radius),
                    ("theta".into(), Tree::Number(0.0)),
                ]))
            }
            (CellKind::Json, Value::Json(text)) if !self.is_as_written => match member.column {
                "actions" => match complete(text, self.version, owner)? {
                    Some(completed) => Held::changed(Tree::Raw(completed.into())),
                    None => Held::same(Tree::Raw(text.into())),
                },
                DEVIATION => ellipse(text).and_then(|_| Held::same(Tree::Raw(text.into()))),
                _ => Held::same(Tree::Raw(text.into())),
            },
            (CellKind::Json, Value::Json(text)) => Held::same(Tree::Raw(text.into())),
            _ => None,
        }
    }

    fn number<'a>(self, member: &Member, number: f64) -> Option<Held<'a>> {
        let tree = Tree::number(number)?;
        if self.is_as_written {
            return Held::same(tree);
        }
        match member.column {
            "vehicleOrientation" | "theta" if number.abs() > MAX_ANGLE => {
                let turned = (number + PI).rem_euclid(2.0 * PI) - PI;
                Held::changed(Tree::number(turned)?)
            }
            "allowedDeviationTheta" if !(0.0..=MAX_ANGLE).contains(&number) => None,
            DEVIATION | "corridor.leftWidth" | "corridor.rightWidth" if number < 0.0 => None,
            _ => Held::same(tree),
        }
    }
}

/// Returns the half axes and the angle of an ellipse.
fn ellipse(text: &str) -> Option<[f64; 3]> {
    let value: serde_json::Value = serde_json::from_str(text).ok()?;
    let [a, b, theta] = ["a", "b", "theta"].map(|key| value.get(key)?.as_f64());
    let (a, b, theta) = (a?, b?, theta?);
    (a >= 0.0 && b >= 0.0 && theta.abs() <= PI / 2.0).then_some([a, b, theta])
}

/// Returns the radius of the circle in an ellipse, in which a vehicle has arrived in any case.
fn radius(text: &str) -> Option<f64> {
    ellipse(text).map(|[a, b, _]| a.min(b))
}
