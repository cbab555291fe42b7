//! [`BuildOptions`]: what `build` joins, cuts, names and maps; reads and writes them as TOML.

use serde::{Deserialize, Serialize};

use super::note_source::fits;
use super::{BuildError, NoteSource};

/// Options of [`build`](super::build). In TOML the names have hyphens and no units: `weld`,
/// `split-crossings`, `max-speed`; lengths are in meters, speeds in meters per second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct BuildOptions {
    /// Ends within this distance become one node.
    #[serde(rename = "weld")]
    pub weld_m: f64,
    /// Cuts a line where the end of another one meets it.
    #[serde(rename = "split")]
    pub split_junctions: bool,
    /// Cuts lines where they cross.
    pub split_crossings: bool,
    /// Largest distance between a chain of short lines and the curve that replaces it; `None` keeps
    /// the lines.
    #[serde(rename = "smooth", skip_serializing_if = "Option::is_none")]
    pub smooth_m: Option<f64>,
    /// Notes of the drawing that are stations.
    pub stations: Vec<NoteSource>,
    /// Notes of the drawing that name nodes.
    pub names: Vec<NoteSource>,
    /// Largest distance of a note from its node or line.
    #[serde(rename = "reach")]
    pub reach_m: f64,
    /// Vehicles drive along every line in both directions, unless a layer says otherwise. If not,
    /// they drive as the line was drawn.
    pub two_way: bool,
    /// Uses lines of layers without a rule.
    pub other_layers: bool,
    /// Levels lie one over the other, and their ends meet by chance. Else ends of different levels
    /// that meet are an error.
    pub levels_apart: bool,
    /// Most pieces that lines are cut to.
    pub max_pieces: usize,
    /// Rules per layer of the drawing; the first one that fits applies.
    #[serde(rename = "layer")]
    pub layers: Vec<LayerRule>,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self {
            weld_m: 0.01,
            split_junctions: false,
            split_crossings: false,
            smooth_m: None,
            stations: Vec::new(),
            names: Vec::new(),
            reach_m: 1.0,
            two_way: true,
            other_layers: true,
            levels_apart: false,
            max_pieces: 10_000_000,
            layers: Vec::new(),
        }
    }
}

/// The meaning of the lines of a layer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct LayerRule {
    /// Name of the layer, whatever its case; a `*` at its end stands for any rest.
    pub name: String,
    /// Leaves the lines of the layer out, such as walls.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub leave: bool,
    /// Level of its lines, by identifier or name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub level: Option<String>,
    /// Vehicle types that may use its lines; empty keeps those of the drawing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub vehicle_types: Vec<String>,
    /// Greatest permitted speed, in meters per second.
    #[serde(rename = "max-speed", skip_serializing_if = "Option::is_none")]
    pub max_speed_m_s: Option<f64>,
    /// Directions in which vehicles drive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<DirectionRule>,
}

/// Directions in which vehicles drive along the lines of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DirectionRule {
    /// Both.
    Both,
    /// As drawn, from start to end.
    Forward,
    /// Against the drawing, from end to start.
    Backward,
}

impl LayerRule {
    /// Returns `true` if the rule is about a layer of this name.
    pub fn fits(&self, layer: &str) -> bool {
        fits(&self.name, layer)
    }
}

impl BuildOptions {
    /// Reads options from the text of a TOML file; what it omits has the default.
    ///
    /// # Errors
    /// When the text is no TOML, or has an unknown name or a bad value; the message has line and
    /// column.
    pub fn from_toml(text: &str) -> Result<Self, BuildError> {
        let options: Self = toml::from_str(text).map_err(|e| BuildError::Map {
            detail: e.to_string().trim_end().to_owned(),
        })?;
        options.check()?;
        Ok(options)
    }

    /// The text of a TOML file with these options.
    ///
    /// # Errors
    /// When a number does not fit TOML.
    pub fn to_toml(&self) -> Result<String, BuildError> {
        toml::to_string(self).map_err(|e| BuildError::Map {
            detail: e.to_string(),
        })
    }

    /// The rule for a layer, if there is one.
    pub(super) fn rule_of(&self, layer: &str) -> Option<u32> {
        let found = self.layers.iter().position(|rule| rule.fits(layer));
        found.map(|row| row as u32)
    }

    /// Rejects distances and speeds that no drawing can have.
    pub(super) fn check(&self) -> Result<(), BuildError> {
        let lengths = [
            ("weld", Some(self.weld_m)),
            ("reach", Some(self.reach_m)),
            ("smooth", self.smooth_m),
        ];
        let speeds = self
            .layers
            .iter()
            .map(|rule| ("max-speed", rule.max_speed_m_s));
        for (name, value) in lengths.into_iter().chain(speeds) {
            if let Some(value) = value
                && !(value.is_finite() && (0.0..=1e6).contains(&value))
            {
                return Err(BuildError::Value { name, value });
            }
        }
        Ok(())
    }
}
