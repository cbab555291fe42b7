//! GeoJSON extension: reads the properties of a feature that hold parts of a layout.

use std::borrow::Cow;

use guideway_layout::{Code, WrittenCurve};
use guideway_spline::{Point, Runs};
use serde::Deserialize;

use super::names;
use super::properties::{Properties, Property};
use crate::builder::{Builder, PlaceFn};
use crate::json::{Field, field_place};

/// A reference to an element: by its identifier, or by its row among the features of its kind
/// where several have the identifier.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub(super) enum Reference {
    Row(u32),
    Id(String),
}

/// Parts of a layout in the properties of one feature.
#[derive(Default)]
pub(super) struct Extension<'a> {
    pub(super) element: Option<Cow<'a, str>>,
    pub(super) level: Option<Reference>,
    pub(super) start: Option<Reference>,
    pub(super) end: Option<Reference>,
    pub(super) is_two_way: bool,
    pub(super) vehicle_types: Vec<String>,
    pub(super) type_properties: Vec<Field<Properties<'a>>>,
    pub(super) nodes: Vec<Reference>,
    pub(super) width_m: Option<f32>,
    pub(super) color_rgba: Option<u32>,
    pub(super) rank: Option<i32>,
    pub(super) curve: Option<Runs>,
    pub(super) nurbs: Option<WrittenCurve>,
}

#[derive(Deserialize)]
struct NurbsJson {
    degree: u32,
    knots: Vec<f64>,
    points: Vec<[f64; 2]>,
    weights: Option<Vec<f64>>,
}

impl<'a> Extension<'a> {
    /// Reads the properties with the names of [`names`]; reports those with another structure.
    pub(super) fn read(
        builder: &mut Builder<'_>,
        properties: &Properties<'a>,
        at: PlaceFn<'_>,
    ) -> Self {
        let mut found = Self::default();
        for (name, property) in properties.iter().filter(|(name, _)| Self::has(name)) {
            if found.set(name, property).is_none() {
                let message = || format!("`{name}` does not have the structure of this property");
                let remedy = "It is ignored; correct it, or remove it";
                let at: PlaceFn<'_> = &|| field_place(at, "properties");
                builder.report(Code::WrongType, at, message, remedy);
            }
        }
        found
    }

    /// Returns whether a property is part of the extension.
    pub(super) fn has(name: &str) -> bool {
        use names::*;
        const ALL: [&str; 13] = [
            ELEMENT,
            LEVEL,
            START,
            END,
            DIRECTION,
            VEHICLE_TYPES,
            TYPE_PROPERTIES,
            NODES,
            WIDTH,
            COLOR,
            RANK,
            CURVE,
            NURBS,
        ];
        name.starts_with(PREFIX) && ALL.contains(&name)
    }

    fn set(&mut self, name: &str, property: Property<'a>) -> Option<()> {
        match name {
            names::ELEMENT => self.element = Some(property.text()?),
            names::LEVEL => self.level = Some(property.parse()?),
            names::START => self.start = Some(property.parse()?),
            names::END => self.end = Some(property.parse()?),
            names::DIRECTION => {
                self.is_two_way = match property.text()?.as_ref() {
                    "both" => true,
                    "forward" => false,
                    _ => return None,
                }
            }
            names::VEHICLE_TYPES => self.vehicle_types = property.parse()?,
            names::TYPE_PROPERTIES => self.type_properties = property.parse()?,
            names::NODES => self.nodes = property.parse()?,
            names::WIDTH => self.width_m = Some(property.parse()?),
            names::COLOR => self.color_rgba = Some(color(&property.text()?)?),
            names::RANK => self.rank = Some(property.parse()?),
            names::CURVE => self.curve = Some(runs(&property.parse::<Vec<Vec<[f64; 2]>>>()?)?),
            _ => self.nurbs = Some(nurbs(property.parse()?)?),
        }
        Some(())
    }
}

fn color(text: &str) -> Option<u32> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 8)?;
    u32::from_str_radix(digits, 16).ok()
}

fn runs(json: &[Vec<[f64; 2]>]) -> Option<Runs> {
    let mut runs = Runs::default();
    for run in json {
        if run.len() < 4 {
            return None;
        }
        runs.push(&points(run));
    }
    Some(runs)
}

fn nurbs(json: NurbsJson) -> Option<WrittenCurve> {
    let count = json.points.len();
    let has_knots = json.knots.is_empty() || json.knots.len() == count + json.degree as usize + 1;
    let has_weights = json.weights.as_ref().is_none_or(|w| w.len() == count);
    let is_curve = json.degree > 0 && count > json.degree as usize && has_knots && has_weights;
    is_curve.then(|| WrittenCurve {
        degree: json.degree,
        knots: json.knots,
        points_m: points(&json.points),
        weights: json.weights,
    })
}

fn points(json: &[[f64; 2]]) -> Vec<Point<f64>> {
    json.iter().map(|&[x, y]| Point::new(x, y)).collect()
}
