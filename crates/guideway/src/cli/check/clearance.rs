//! `--clearance`: finds swept areas too near to each other or to the walls of a floor plan.

use std::collections::BTreeSet;

use guideway::envelope::{
    ClearanceOptions, ClearanceReport, ClearanceWork, EnvelopeSource, Walls, check_clearance,
};
use guideway::layout::{Diagnostics, Layout, UserError, near_names, shown_path, shown_text};
use guideway::network::LayerRule;
use serde_json::{Value, json};

use super::findings::CheckedFile;
use crate::cli::error::usage_error;
use crate::cli::input::Input;
use crate::cli::output::Output;
use crate::cli::{envelope, floor_plan, text, values};

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Clearance")]
pub(super) struct ClearanceArgs {
    /// Minimum distance between vehicles on two paths, and to the floor plan; 0 finds overlaps.
    /// Without it, distances are not checked
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    clearance: Option<f64>,
    /// The vehicle: length, width and the distance from its rear end to its reference point
    /// (default: half the length), in meters; `file` (the default) uses the envelopes of the file
    #[arg(
        long,
        value_name = "LENGTHxWIDTH[,REAR]",
        value_parser = envelope::source,
        requires = "clearance"
    )]
    envelope: Option<EnvelopeSource>,
    /// Radius around a common end of two paths within which their distance is ignored [default: six
    /// times the distance from the reference point to the farthest corner of the vehicle]
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        requires = "clearance"
    )]
    near_node: Option<f64>,
    /// File with the walls: a drawing, a layout, or a `map.yaml` of ROS, whose occupied cells are
    /// walls
    #[arg(long, value_name = "FILE", value_parser = Input::parser(), requires = "clearance")]
    floor_plan: Option<Input>,
    /// Layer of the floor plan with walls; can be repeated [default: all layers]
    #[arg(long, value_name = "NAME", requires = "floor_plan")]
    wall_layer: Vec<String>,
}

/// The check that runs on each file.
pub(super) struct ClearanceCheck {
    source: EnvelopeSource,
    walls: Option<Walls>,
    options: ClearanceOptions,
}

/// Column of the layers of a drawing.
const LAYER: &str = "layer";

impl ClearanceArgs {
    /// The check, with the floor plan read; `None` without `--clearance`.
    pub(super) fn check(&self, out: &Output) -> Result<Option<ClearanceCheck>, UserError> {
        let Some(clearance_m) = self.clearance else {
            return Ok(None);
        };
        let walls = self.floor_plan.as_ref().map(|plan| self.walls(plan, out));
        Ok(Some(ClearanceCheck {
            source: self.source(),
            walls: walls.transpose()?,
            options: ClearanceOptions {
                clearance_m,
                near_joint_m: self.near_node,
                ..ClearanceOptions::default()
            },
        }))
    }

    fn source(&self) -> EnvelopeSource {
        self.envelope.unwrap_or(EnvelopeSource::File)
    }

    fn walls(&self, plan: &Input, out: &Output) -> Result<Walls, UserError> {
        let layout = floor_plan::read_walls(plan, out)?;
        let layers = layout.paths.attributes.get(LAYER);
        let layer = |path: usize| layers?.values.get(path).map(|value| value.to_string());
        let known: BTreeSet<String> = (0..layout.paths.len()).filter_map(layer).collect();
        let rules = self.wall_layer.iter().map(|name| LayerRule {
            name: name.clone(),
            ..LayerRule::default()
        });
        let rules: Vec<LayerRule> = rules.collect();
        for rule in &rules {
            if !known.iter().any(|layer| rule.fits(layer)) {
                return Err(unknown_layer(&rule.name, plan, &known));
            }
        }
        let is_wall = |path: usize| {
            let is_named = |layer: String| rules.iter().any(|rule| rule.fits(&layer));
            rules.is_empty() || layer(path).is_some_and(is_named)
        };
        Ok(Walls::new(&layout, is_wall))
    }
}

/// No line of a floor plan is on a layer.
fn unknown_layer(name: &str, plan: &Input, known: &BTreeSet<String>) -> UserError {
    let near = near_names(name, known.iter().map(String::as_str));
    /// Layers that the hint names at most.
    const MOST: usize = 30;
    let known: Vec<&str> = known.iter().take(MOST).map(String::as_str).collect();
    let hint = match (near.first(), &known[..]) {
        (_, []) => "The file has no layers: omit --wall-layer".to_owned(),
        (Some(near), _) => format!("Did you mean `{near}`? The layers are {}", known.join(", ")),
        (None, _) => format!("The layers are {}", known.join(", ")),
    };
    usage_error(
        format!("{}: no path is on layer `{name}`", shown_path(&plan.path)),
        hint,
    )
}

impl ClearanceCheck {
    /// Appends the findings of a layout to `found`.
    ///
    /// # Errors
    /// When no path has an envelope.
    pub(super) fn run(
        &self,
        layout: &Layout,
        found: &mut Diagnostics,
    ) -> Result<ClearanceWork, UserError> {
        let walls = self.walls.as_ref();
        let ClearanceReport {
            findings: near,
            work,
        } = check_clearance(layout, self.source, walls, &self.options);
        envelope::require_any(work.paths, &work.no_envelope)?;
        found.append(near);
        Ok(work)
    }
}

/// The work of the check: one line per file.
pub(super) fn text(files: &[CheckedFile]) -> String {
    let mut text = String::new();
    for file in files {
        let Some(work) = &file.clearance else {
            continue;
        };
        text += &format!(
            "{}: {}, {} near each other or a wall, {}\n",
            shown_text(&file.file),
            text::counted(work.paths, "envelope"),
            text::counted(work.candidates, "pair"),
            text::counted(work.tests, "distance"),
        );
        if work.incomplete > 0 {
            text += &format!(
                "note: {} compared with a part of what is near them only\n",
                text::counted(work.incomplete, "path")
            );
        }
        let doubt = envelope::doubt(work.doubtful);
        for line in envelope::missing(&work.no_envelope)
            .into_iter()
            .chain(doubt)
        {
            text += &format!("note: {line}\n");
        }
    }
    text
}

pub(super) fn json(args: &ClearanceArgs, files: &[CheckedFile]) -> Value {
    let works = files.iter().filter_map(|file| file.clearance);
    let sum = |of: fn(ClearanceWork) -> u64| works.clone().map(of).sum::<u64>();
    args.clearance.map_or(Value::Null, |clearance_m| {
        json!({
            "clearance_m": clearance_m,
            "source": envelope::name(args.source()),
            "envelopes": sum(|work| work.paths),
            "without": sum(|work| work.no_envelope.iter().sum()),
            "doubtful": sum(|work| work.doubtful),
            "candidate_pairs": sum(|work| work.candidates),
            "distances": sum(|work| work.tests),
            "incomplete_paths": sum(|work| work.incomplete),
        })
    })
}
