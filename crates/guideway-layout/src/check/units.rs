//! Units: sizes, coordinates and speeds that suggest another unit than the file states.

use std::f64::consts::{PI, TAU};

use super::element::{element_name, element_place};
use super::options::CheckOptions;
use super::scale::{Axis, DriveTime, LARGEST_SPEED_M_PER_S, Scale, SizeDoubt};
use crate::{Attribute, Code, Diagnostics, Layout, Member, Place, Quantity, TypeEntries, Value};

/// Fastest plausible turn on the spot, in radians per second: a full turn per second. In degrees,
/// slow turns have larger numbers.
const LARGEST_ROTATION_RAD_PER_S: f64 = TAU;
/// Writers round angles to four digits.
const ROUNDING_RAD: f64 = 1.5e-5;
/// Largest plausible angle: a full turn.
const LARGEST_ANGLE_RAD: f64 = TAU + ROUNDING_RAD;
/// Largest angle of formats whose angles range from -pi to pi.
const HALF_TURN_RAD: f64 = PI + ROUNDING_RAD;
/// Formats with such angles.
const HALF_TURN_FORMATS: [&str; 2] = ["LIF", "VDA 5050"];

/// Reports a layout that is too large or too small, once, coordinates too far from the origin, and
/// columns with impossible speeds or angles.
pub(super) fn check(
    layout: &Layout,
    options: &CheckOptions,
    scale: &Scale,
    found: &mut Diagnostics,
) {
    match scale.doubt(options) {
        Some(SizeDoubt::Small) => push(found, || small(scale, options), SMALL_REMEDY),
        Some(SizeDoubt::Large) => push(found, || large(layout, scale), LARGE_REMEDY),
        None => {
            if let Some(message) = far(layout, scale, options) {
                push(found, || message, FAR_REMEDY);
            }
        }
    }
    columns(layout, found);
}

const SMALL_REMEDY: &str =
    "Check the unit of the file: meters read as millimeters make a hall as small as a coin";
const LARGE_REMEDY: &str = "Check the unit of the file: millimeters read as meters make a hall as \
                            large as a country, centimeters as large as a town; if it is right, \
                            look for stray paths";
const FAR_REMEDY: &str = "Check the unit of the file; if it is right, look for stray paths";

fn push(found: &mut Diagnostics, message: impl FnOnce() -> String, remedy: &str) {
    let place = || Place::element("layout");
    found.push(Code::Implausible, place, message, remedy);
}

fn small(scale: &Scale, options: &CheckOptions) -> String {
    let extent_m = scale.extent_m();
    let median_m = scale
        .median_size_m
        .filter(|_| extent_m >= options.smallest_extent_m);
    let median = median_m.map_or_else(String::new, |median_m| {
        format!(", and half of its paths are smaller than {median_m:.2e} m")
    });
    format!("the layout is only {extent_m:.2e} m in size{median}")
}

fn large(layout: &Layout, scale: &Scale) -> String {
    let [x, y] = scale.axes;
    let (axis, adjective) = match x.extent_m() >= y.extent_m() {
        true => (x, "wide"),
        false => (y, "high"),
    };
    let path = |row| element_name("path", row, layout.paths.id(row));
    let (from, to) = (path(axis.least.1), path(axis.greatest.1));
    let extent_km = axis.extent_m() / 1e3;
    let long = scale.long_m().map_or_else(String::new, |size_m| {
        let size_km = size_m / 1e3;
        format!("; half of its paths are larger than {size_km:.1} km")
    });
    let slow = scale.slow().map_or_else(String::new, |median| {
        let DriveTime {
            time_s,
            speed_m_per_s,
        } = median;
        let minutes = time_s / 60.0;
        format!("; half of its paths take more than {minutes:.0} minutes at {speed_m_per_s} m/s")
    });
    format!("the layout is {extent_km:.0} km {adjective}, from {from} to {to}{long}{slow}")
}

/// The coordinate farthest from the origin, if it is too far.
fn far(layout: &Layout, scale: &Scale, options: &CheckOptions) -> Option<String> {
    let ends = |(axis, name): (&Axis, &'static str)| {
        [axis.least, axis.greatest].map(|(value_m, row)| (value_m, row, name))
    };
    let ends = scale.axes.iter().zip(["x", "y"]).flat_map(ends);
    let (value_m, row, axis) = ends
        .filter(|(value_m, ..)| value_m.is_finite())
        .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    (value_m.abs() > options.largest_coordinate_m).then(|| {
        let path = element_name("path", row, layout.paths.id(row));
        format!("{path} reaches {axis} = {value_m:.3e} m")
    })
}

/// Column of the permitted orientations, a list of angles in radians.
const ORIENTATIONS: &str = "vehicleOrientations";

/// The greatest magnitude in a list of numbers.
fn greatest(list: &str) -> Option<f64> {
    let items = list.trim().trim_start_matches('[').trim_end_matches(']');
    let numbers = items
        .split(',')
        .filter_map(|item| item.trim().parse::<f64>().ok());
    numbers.map(f64::abs).reduce(f64::max)
}

/// The greatest angle that the formats of a layout allow, in radians. A larger one was probably
/// written in degrees.
pub fn largest_angle_rad(layout: &Layout) -> f64 {
    match layout.provenance.is_all_of(&HALF_TURN_FORMATS) {
        true => HALF_TURN_RAD,
        false => LARGEST_ANGLE_RAD,
    }
}

/// Reports columns with impossible values, each once.
fn columns(layout: &Layout, found: &mut Diagnostics) {
    let (paths, nodes) = (&layout.paths, &layout.nodes);
    let largest_angle = largest_angle_rad(layout);
    let path = |row: usize| element_place(Member::Path(row as u32), paths.id(row));
    let node = |row: usize| element_place(Member::Node(row as u32), nodes.id(row as u32));
    for column in paths.attributes.iter() {
        check_column(column, "paths", path, largest_angle, found);
    }
    for column in nodes.attributes.iter() {
        check_column(column, "nodes", node, largest_angle, found);
    }
    let stations = &layout.stations;
    let id = |row: usize| stations.id(row as u32);
    let station = |row: usize| element_place(Member::Station(row as u32), id(row));
    for column in stations.attributes.iter() {
        check_column(column, "stations", station, largest_angle, found);
    }
    let element = |entries: &TypeEntries, entry: usize| {
        let end = |element: usize| entries.entries(element).end;
        let (mut low, mut high) = (0, entries.len());
        while low < high {
            let middle = usize::midpoint(low, high);
            match end(middle) <= entry {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        low
    };
    for (entries, table) in [
        (paths.vehicle_types(), "paths"),
        (nodes.vehicle_types(), "nodes"),
    ] {
        for column in entries.attributes.iter() {
            let name = |entry| {
                let row = element(entries, entry);
                if table == "paths" {
                    path(row)
                } else {
                    node(row)
                }
            };
            check_column(column, table, name, largest_angle, found);
        }
    }
}

fn check_column(
    column: &Attribute,
    table: &str,
    element: impl Fn(usize) -> Place,
    largest_angle: f64,
    found: &mut Diagnostics,
) {
    let (largest, remedy) = match column.quantity {
        Some(Quantity::Speed) => (
            LARGEST_SPEED_M_PER_S,
            "Check whether the speeds are in mm/s",
        ),
        Some(Quantity::RotationSpeed) => (
            LARGEST_ROTATION_RAD_PER_S,
            "Check whether the rotation speeds are in degrees per second",
        ),
        Some(Quantity::Angle) => (largest_angle, "Check whether the angles are in degrees"),
        _ if column.name == ORIENTATIONS => {
            (largest_angle, "Check whether the angles are in degrees")
        }
        _ => return,
    };
    let number = |row: usize| column.values.get(row).and_then(Value::number);
    // Vehicles that drive backwards have a reverse speed.
    let is_negative = |row: usize| {
        column.quantity == Some(Quantity::Speed) && number(row).is_some_and(|speed| speed < 0.0)
    };
    let magnitude = |row: usize| match column.values.get(row)? {
        Value::Float(_) | Value::Int(_) => number(row).map(f64::abs),
        Value::Json(list) if column.name == ORIENTATIONS => greatest(list),
        Value::Bool(_) | Value::Text(_) | Value::Json(_) => None,
    };
    let rows = 0..column.values.len();
    let is_large = |row: usize| magnitude(row).is_some_and(|value| value > largest);
    let mut wrong = rows.filter(|&row| is_large(row) || is_negative(row));
    let Some(first) = wrong.next() else {
        return;
    };
    let others = wrong.count();
    found.push(
        Code::Implausible,
        || Place {
            origin: element(first).origin,
            ..Place::element(format!("column {} of {table}", column.label()))
        },
        || {
            let value = column.values.get(first).map(|value| value.to_string());
            let (value, name) = (value.unwrap_or_default(), element(first).element);
            let others = match others {
                0 => String::new(),
                1 => ", and another value is wrong".to_owned(),
                n => format!(", and {n} other values are wrong"),
            };
            let largest = (largest * 1e4).round() / 1e4;
            match is_negative(first) {
                true => format!("{name} has {value}, less than 0{others}"),
                false => format!("{name} has {value}, more than {largest}{others}"),
            }
        },
        remedy,
    );
}
