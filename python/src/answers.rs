//! Findings, routes, changes and losses as Python objects whose attributes cannot be set.

use guideway::formats::Losses;
use guideway::layout::{
    self, Change as Kind, Changes, Diagnostic, ElementChange, Layout, Severity,
};
use guideway::network;
use pyo3::prelude::*;

use crate::error::bad_argument;

/// The severity of a name.
pub(crate) fn severity(name: &str) -> PyResult<Severity> {
    let all = [Severity::Info, Severity::Warning, Severity::Error];
    let named = all
        .into_iter()
        .find(|severity| severity.to_string() == name);
    named.ok_or_else(|| {
        let remedy = "Choose \"info\", \"warning\" or \"error\"";
        bad_argument(format!("unknown severity `{name}`"), remedy)
    })
}

/// A finding of `Layout.check`.
#[pyclass(frozen, get_all, module = "guideway")]
pub(crate) struct Finding {
    code: String,
    severity: String,
    element: String,
    line: Option<u32>,
    column: Option<u32>,
    message: String,
    remedy: String,
}

impl Finding {
    pub(crate) fn of(finding: &Diagnostic) -> Self {
        let Diagnostic {
            code,
            severity,
            place,
            message,
            remedy,
        } = finding;
        Self {
            code: code.name().to_owned(),
            severity: severity.to_string(),
            element: place.element.clone(),
            line: place.line,
            column: place.column,
            message: message.clone(),
            remedy: remedy.clone(),
        }
    }
}

#[pymethods]
impl Finding {
    fn __repr__(&self) -> String {
        let Self {
            severity,
            code,
            element,
            message,
            ..
        } = self;
        format!("<Finding {severity} {code}: {element}: {message}>")
    }
}

/// The fastest way between two stations or nodes.
#[pyclass(frozen, get_all, module = "guideway")]
pub(crate) struct Route {
    length_m: f64,
    time_s: f64,
    steps: Vec<Py<RouteStep>>,
}

/// One edge of a route.
#[pyclass(frozen, get_all, module = "guideway")]
pub(crate) struct RouteStep {
    edge: String,
    backward: bool,
    start_node: String,
    end_node: String,
    turn_rad: f64,
    turn_s: f64,
    length_m: f64,
    speed_m_s: f64,
    drive_s: f64,
    end_s: f64,
}

impl Route {
    pub(crate) fn of(py: Python<'_>, route: &network::Route, layout: &Layout) -> PyResult<Self> {
        let node = |row: u32| layout.nodes.id(row).to_owned();
        let steps = route.rows.iter().map(|row| {
            let step = RouteStep {
                edge: layout.paths.id(row.path as usize).to_owned(),
                backward: row.is_backward,
                start_node: node(row.from),
                end_node: node(row.to),
                turn_rad: row.turn_rad,
                turn_s: row.turn_s,
                length_m: row.length_m,
                speed_m_s: row.speed_m_s,
                drive_s: row.drive_s,
                end_s: row.end_s,
            };
            Py::new(py, step)
        });
        Ok(Self {
            length_m: route.length_m,
            time_s: route.time_s,
            steps: steps.collect::<PyResult<_>>()?,
        })
    }
}

#[pymethods]
impl Route {
    fn __len__(&self) -> usize {
        self.steps.len()
    }

    fn __repr__(&self) -> String {
        let Self {
            length_m, time_s, ..
        } = self;
        let edges = self.steps.len();
        format!("<Route of {edges} edges, {length_m:.2} m, {time_s:.1} s>")
    }
}

#[pymethods]
impl RouteStep {
    fn __repr__(&self) -> String {
        let Self {
            edge,
            length_m,
            speed_m_s,
            ..
        } = self;
        format!("<RouteStep {edge}: {length_m:.2} m at {speed_m_s:.2} m/s>")
    }
}

/// A difference between two layouts.
#[pyclass(frozen, get_all, module = "guideway")]
pub(crate) struct Change {
    element: String,
    id: String,
    change: String,
    to: Option<String>,
    distance_m: Option<f64>,
    column: Option<String>,
    vehicle_type: Option<String>,
    before: Option<String>,
    after: Option<String>,
}

impl Change {
    pub(crate) fn of(found: &Changes<'_>, of: &ElementChange) -> Self {
        let distance_m = match of.change {
            Kind::Moved { distance_m } => Some(distance_m),
            Kind::Reshaped { greatest_m } => Some(greatest_m),
            _ => None,
        };
        let values = found.values(of);
        let (column, vehicle_type, before, after) = match values {
            Some(values) => (
                Some(values.property.to_owned()),
                values.vehicle_type.map(str::to_owned),
                values.before.map(|text| text.to_string()),
                values.after.map(|text| text.to_string()),
            ),
            None => (None, None, None, None),
        };
        Self {
            element: of.element.name().to_owned(),
            id: found.id(of).to_owned(),
            change: of.change.name().to_owned(),
            to: found.new_id(of).map(str::to_owned),
            distance_m,
            column,
            vehicle_type,
            before,
            after,
        }
    }

    /// A kind of change that is counted only.
    pub(crate) fn of_group(of: &layout::Difference) -> Self {
        Self {
            element: "layout".to_owned(),
            id: String::new(),
            change: "counted".to_owned(),
            to: None,
            distance_m: None,
            column: Some(of.what.clone()),
            vehicle_type: None,
            before: None,
            after: Some(of.example.clone()),
        }
    }
}

#[pymethods]
impl Change {
    fn __repr__(&self) -> String {
        let Self {
            element,
            id,
            change,
            ..
        } = self;
        let detail = match (&self.column, self.distance_m, &self.to) {
            (Some(column), ..) => {
                let of = |value: &Option<String>| value.clone().unwrap_or_else(|| "none".into());
                format!(" {column}: {} -> {}", of(&self.before), of(&self.after))
            }
            (None, Some(distance_m), _) => format!(" by {distance_m} m"),
            (None, None, Some(to)) => format!(" to {to}"),
            (None, None, None) => String::new(),
        };
        format!("<Change {element} {id} {change}{detail}>")
    }
}

/// A part of a layout that a format cannot hold, or holds in another form.
#[pyclass(frozen, get_all, module = "guideway")]
pub(crate) struct Loss {
    what: String,
    count: u64,
    message: String,
}

impl Loss {
    pub(crate) fn list(losses: &Losses) -> Vec<Self> {
        let losses = losses.iter().map(|loss| Self {
            what: loss.what.clone(),
            count: loss.count,
            message: loss.to_string(),
        });
        losses.collect()
    }
}

#[pymethods]
impl Loss {
    fn __repr__(&self) -> String {
        format!("<Loss {}>", self.message)
    }
}
