//! [`BuildArgs`]: the arguments of `Layout.network`.

use guideway::network::BuildOptions;
use pyo3::prelude::*;

use crate::error::{bad_argument, exception};

/// The arguments of `Layout.network`.
pub(crate) struct BuildArgs<'a> {
    pub(crate) weld_m: Option<f64>,
    pub(crate) split: bool,
    pub(crate) smooth_m: Option<f64>,
    pub(crate) stations: Vec<String>,
    pub(crate) names: Vec<String>,
    pub(crate) one_way: bool,
    /// TOML that the other arguments override.
    pub(crate) options: Option<&'a str>,
}

impl BuildArgs<'_> {
    /// The options that they make.
    pub(crate) fn build_options(self) -> PyResult<BuildOptions> {
        let mut chosen = match self.options {
            Some(text) => BuildOptions::from_toml(text).map_err(exception)?,
            None => BuildOptions::default(),
        };
        chosen.weld_m = self.weld_m.unwrap_or(chosen.weld_m);
        chosen.smooth_m = self.smooth_m.or(chosen.smooth_m);
        chosen.split_junctions |= self.split;
        chosen.split_crossings |= self.split;
        chosen.two_way &= !self.one_way;
        for (texts, sources) in [
            (self.stations, &mut chosen.stations),
            (self.names, &mut chosen.names),
        ] {
            for text in texts {
                let source = text.parse();
                let failed = |error| {
                    let remedy = "Write such as \"text:LAYER\" or \"block:NAME\"";
                    bad_argument(format!("source `{text}`: {error}"), remedy)
                };
                sources.push(source.map_err(failed)?);
            }
        }
        Ok(chosen)
    }
}
