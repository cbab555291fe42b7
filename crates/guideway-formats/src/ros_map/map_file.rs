//! [`MapFile`]: the fields of a `map.yaml`, checked.

use std::path::{Path, PathBuf};

use guideway_layout::{Place, Value};
use guideway_spline::Point;

use crate::encoding::to_utf8;
use crate::raster::ImagePlacement;
use crate::source::Source;
use crate::text::{decode_utf8, printable};
use crate::yaml::{Yaml, YamlNode};
use crate::{Problem, ReadError};

/// The fields of a map; all but `mode` are required, as map servers require them.
const FIELDS: [&str; 7] = [
    "image",
    "resolution",
    "origin",
    "negate",
    "occupied_thresh",
    "free_thresh",
    "mode",
];

/// Smallest and greatest resolution, in meters per pixel: a micrometer and a kilometer.
const RESOLUTION_M: [f64; 2] = [1e-6, 1e3];

/// Greatest absolute yaw, in radians: a full turn. Degrees in its place exceed it.
const MAX_YAW_RAD: f64 = std::f64::consts::TAU;

/// The content of a `map.yaml`.
#[derive(Clone, Debug, PartialEq)]
pub struct MapFile {
    /// The image file; a relative name is already relative to the folder of the map file.
    pub image: PathBuf,
    /// Resolution and origin as a placement.
    pub placement: ImagePlacement,
    /// True if white pixels are occupied and black ones free.
    pub negate: bool,
    /// Occupancy above which a pixel is occupied, from 0 to 1.
    pub occupied_thresh: f64,
    /// Occupancy below which a pixel is free, from 0 to 1.
    pub free_thresh: f64,
    /// The rule by which the lightness of a pixel becomes an occupancy.
    pub mode: MapMode,
}

/// The rule by which the lightness of a pixel becomes an occupancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapMode {
    /// Free, occupied, or unknown between the thresholds.
    Trinary,
    /// Proportional between the thresholds; pixels that are not opaque are unknown.
    Scale,
    /// The value of a pixel from 0 to 100 is its occupancy in percent; others are unknown.
    Raw,
}

impl MapFile {
    /// Reads the fields of the map file at `path`.
    pub(super) fn parse(source: &Source<'_>, path: &Path, bytes: &[u8]) -> Result<Self, ReadError> {
        let bytes = to_utf8(bytes).map_err(|problem| source.fail(problem))?;
        let text = decode_utf8(source, &bytes)?;
        let yaml = Yaml::parse(source, text)?;
        Self::of_yaml(&yaml, path).map_err(|problem| source.fail(problem))
    }

    fn of_yaml(yaml: &Yaml<'_>, path: &Path) -> Result<Self, Problem> {
        let fields = Fields::new(yaml)?;
        let [free_thresh, occupied_thresh] =
            ["free_thresh", "occupied_thresh"].map(|key| fields.share(key));
        let (free_thresh, occupied_thresh) = (free_thresh?, occupied_thresh?);
        if free_thresh > occupied_thresh {
            let detail = format!("{free_thresh} exceeds occupied_thresh, {occupied_thresh}");
            let remedy = "Give thresholds such as free_thresh: 0.25 and occupied_thresh: 0.65";
            return Err(fields.invalid("free_thresh", detail, remedy));
        }
        Ok(Self {
            image: fields.image(path)?,
            placement: fields.placement()?,
            negate: fields.negate()?,
            occupied_thresh,
            free_thresh,
            mode: fields.mode()?,
        })
    }
}

/// The root object of a map file.
struct Fields<'y> {
    root: YamlNode<'y>,
}

impl<'y> Fields<'y> {
    /// Checks the keys of the root object.
    fn new(yaml: &'y Yaml<'_>) -> Result<Self, Problem> {
        let list = FIELDS.join(", ");
        let Some(root) = yaml.root().filter(|root| root.is_map()) else {
            return Err(invalid(
                Place::element("map file"),
                "it has no fields".into(),
                format!("Give the fields {list}, one a line"),
            ));
        };
        let at = |key: &str, line| Place::on_line(printable(key), line);
        if let Some((key, line)) = yaml.duplicate_keys.first() {
            let remedy = "Remove all but one of them".into();
            return Err(invalid(
                at(key, *line),
                "the field is given twice".into(),
                remedy,
            ));
        }
        if let Some(line) = yaml.next_document {
            let detail = "a second document begins here".into();
            let remedy = "Give one map per file".into();
            return Err(invalid(at("map file", line), detail, remedy));
        }
        // An object that another one merges may have any name.
        let is_odd = |key: &str, value: YamlNode<'_>| !FIELDS.contains(&key) && !value.is_merged();
        let mut keys = root.entries();
        if let Some((key, value)) = keys.find(|(key, value)| is_odd(key, *value)) {
            let detail = "this is no field of a map".into();
            let remedy = format!("Correct or remove it; the fields are {list}");
            return Err(invalid(at(key, value.line()), detail, remedy));
        }
        Ok(Self { root })
    }

    /// An error about a field.
    fn invalid(&self, key: &str, detail: String, remedy: &str) -> Problem {
        let line = self.root.get(key).map(|value| value.line());
        let element = key.to_owned();
        let place = Place {
            line,
            ..Place::element(element)
        };
        invalid(place, detail, remedy.into())
    }

    fn required(&self, key: &str, remedy: &str) -> Result<YamlNode<'y>, Problem> {
        let value = self.root.get(key);
        value.ok_or_else(|| self.invalid(key, "the field is missing".into(), remedy))
    }

    fn image(&self, path: &Path) -> Result<PathBuf, Problem> {
        let remedy = "Name the image of the map, relative to the folder of this file, such as \
                      `image: hall.pgm`";
        let value = self.required("image", remedy)?;
        match value.text().filter(|text| !text.trim().is_empty()) {
            Some(text) => Ok(path.parent().unwrap_or(Path::new("")).join(text)),
            None => Err(self.invalid("image", "this is no file name".into(), remedy)),
        }
    }

    fn placement(&self) -> Result<ImagePlacement, Problem> {
        let [min, max] = RESOLUTION_M;
        let remedy = format!(
            "Give the size of a pixel in meters, from {min} to {max}, such as `resolution: 0.05`"
        );
        let resolution = self.required("resolution", &remedy)?;
        let resolution_m = number(resolution).filter(|size| (min..=max).contains(size));
        let Some(resolution_m) = resolution_m else {
            let detail = format!("{} is no size from {min} to {max} m", shown(resolution));
            return Err(self.invalid("resolution", detail, &remedy));
        };
        let remedy = "Give x and y of the lower left corner in meters and the yaw in radians, \
                      such as `origin: [-5.0, -2.5, 0]`";
        let origin = self.required("origin", remedy)?;
        let numbers: Vec<Option<f64>> = origin.items().map(number).collect();
        let &[Some(x), Some(y), Some(yaw)] = &*numbers else {
            let detail = match origin.is_list() {
                true if numbers.len() != 3 => {
                    format!("{} values in place of three", numbers.len())
                }
                _ => format!("{} is no list of three numbers", shown(origin)),
            };
            return Err(self.invalid("origin", detail, remedy));
        };
        if yaw.abs() > MAX_YAW_RAD {
            let detail = format!("the yaw {yaw} exceeds a full turn, {MAX_YAW_RAD:.4} radians");
            return Err(self.invalid("origin", detail, remedy));
        }
        Ok(ImagePlacement {
            px_per_m: 1.0 / resolution_m,
            rotate_deg: yaw.to_degrees(),
            offset_m: Point::new(x, y),
        })
    }

    fn negate(&self) -> Result<bool, Problem> {
        let remedy = "Give 0 if dark pixels are occupied, as usual, or 1 if light ones are";
        let value = self.required("negate", remedy)?;
        match value.value() {
            Some(Value::Int(0) | Value::Bool(false)) => Ok(false),
            Some(Value::Int(1) | Value::Bool(true)) => Ok(true),
            _ => {
                let detail = format!("{} is neither 0 nor 1", shown(value));
                Err(self.invalid("negate", detail, remedy))
            }
        }
    }

    /// A threshold.
    fn share(&self, key: &str) -> Result<f64, Problem> {
        let remedy = "Give an occupancy from 0 to 1; map savers write `occupied_thresh: 0.65` and \
                      `free_thresh: 0.25`";
        let value = self.required(key, remedy)?;
        let share = number(value).filter(|share| (0.0..=1.0).contains(share));
        share.ok_or_else(|| {
            let detail = format!("{} is no number from 0 to 1", shown(value));
            self.invalid(key, detail, remedy)
        })
    }

    fn mode(&self) -> Result<MapMode, Problem> {
        let Some(value) = self.root.get("mode") else {
            return Ok(MapMode::Trinary);
        };
        match value.text() {
            Some("trinary") => Ok(MapMode::Trinary),
            Some("scale") => Ok(MapMode::Scale),
            Some("raw") => Ok(MapMode::Raw),
            _ => {
                let detail = format!("{} is no mode", shown(value));
                let remedy = "Give trinary, scale or raw";
                Err(self.invalid("mode", detail, remedy))
            }
        }
    }
}

/// A finite number; map servers read quoted ones too.
fn number(value: YamlNode<'_>) -> Option<f64> {
    let number = value.number().or_else(|| value.text()?.parse().ok());
    number.filter(|number| number.is_finite())
}

/// A value, for messages.
fn shown(value: YamlNode<'_>) -> String {
    match value.text().filter(|text| !text.is_empty()) {
        Some(text) => format!("`{}`", printable(text)),
        None => value.kind().into(),
    }
}

fn invalid(place: Place, detail: String, remedy: String) -> Problem {
    Problem::InvalidValue {
        place,
        detail,
        remedy,
    }
}
