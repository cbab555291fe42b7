//! How near vehicles come to each other and to the walls of a floor plan.

use guideway::envelope::{
    ClearanceOptions, ClearanceReport, ClearanceWork, EnvelopeSource, Walls, check_clearance,
};
use guideway::layout::{Diagnostics, Layout};
use serde_json::{Value, json};

use super::Checked;
use crate::cli::input::{self, Input};
use crate::cli::{Failure, Output, envelope, text, values};

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "How near vehicles come")]
pub(super) struct ClearanceArgs {
    /// Least distance of vehicles on two paths, and from the floor plan; 0 finds what overlaps. Not looked at
    /// unless given
    #[arg(long, value_name = "METERS", value_parser = values::not_negative, allow_hyphen_values = true)]
    clearance: Option<f64>,
    /// The vehicle: its length and width in meters, and how far its reference point is from its rear end (the middle
    /// unless given); or `file` for the corridors that the file gives, the default
    #[arg(long, value_name = "LENGTHxWIDTH[,REAR]", value_parser = envelope::source, requires = "clearance")]
    envelope: Option<EnvelopeSource>,
    /// How near to an end that two paths have in common no distance between them counts [default: six times the
    /// distance of the vehicle's farthest corner from its reference point]
    #[arg(long, value_name = "METERS", value_parser = values::not_negative, requires = "clearance")]
    near_node: Option<f64>,
    /// Drawing or layout whose lines are walls
    #[arg(long, value_name = "FILE", value_parser = Input::parser(), requires = "clearance")]
    floor_plan: Option<Input>,
    /// A layer of the floor plan that has walls; several can be given [default: all layers]
    #[arg(long, value_name = "NAME", requires = "floor_plan")]
    wall_layer: Vec<String>,
}

/// What is asked of each file.
pub(super) struct Question {
    source: EnvelopeSource,
    walls: Option<Walls>,
    options: ClearanceOptions,
}

/// The column of the layers of a drawing.
const LAYER: &str = "layer";

impl ClearanceArgs {
    /// What is asked, with the floor plan read; nothing without a clearance.
    pub(super) fn question(&self, out: &Output) -> Result<Option<Question>, Failure> {
        let Some(clearance_m) = self.clearance else {
            return Ok(None);
        };
        let walls = self.floor_plan.as_ref().map(|plan| self.walls(plan, out));
        Ok(Some(Question {
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

    fn walls(&self, plan: &Input, out: &Output) -> Result<Walls, Failure> {
        let (layout, _) = input::read_all(std::slice::from_ref(plan), out)?;
        let layers = layout.paths.attributes.get(LAYER);
        let layer = |path: usize| layers?.values.get(path).map(|value| value.to_string());
        let is_wall = |path: usize| {
            let is_named = |layer: String| self.wall_layer.contains(&layer);
            self.wall_layer.is_empty() || layer(path).is_some_and(is_named)
        };
        for name in &self.wall_layer {
            let has = |path: usize| layer(path).as_ref() == Some(name);
            if !(0..layout.paths.len()).any(has) {
                return Err(Failure::arguments(
                    format!("{}: no path is on a layer `{name}`", plan.path.display()),
                    "Look at the column `layer` of `guideway info`, and name one of those",
                ));
            }
        }
        Ok(Walls::new(&layout, is_wall))
    }
}

impl Question {
    /// Adds what is too near to what was found.
    ///
    /// # Errors
    /// When no path has an envelope.
    pub(super) fn ask(
        &self,
        layout: &Layout,
        found: &mut Diagnostics,
    ) -> Result<ClearanceWork, Failure> {
        let walls = self.walls.as_ref();
        let ClearanceReport {
            findings: near,
            work,
        } = check_clearance(layout, self.source, walls, &self.options);
        envelope::need_some(work.paths, &work.no_envelope)?;
        found.append(near);
        Ok(work)
    }
}

/// What it took, a line for each file.
pub(super) fn text(files: &[Checked]) -> String {
    let mut text = String::new();
    for file in files {
        let Some(work) = &file.clearance else {
            continue;
        };
        text += &format!(
            "{}: {}, {} near each other or a wall, {}\n",
            file.file,
            text::counted(work.paths, "envelope"),
            text::counted(work.candidates, "pair"),
            text::counted(work.tests, "distance"),
        );
        for line in envelope::lacking(&work.no_envelope) {
            text += &format!("note: {line}\n");
        }
    }
    text
}

pub(super) fn json(args: &ClearanceArgs, files: &[Checked]) -> Value {
    let works = files.iter().filter_map(|file| file.clearance);
    let sum = |of: fn(ClearanceWork) -> u64| works.clone().map(of).sum::<u64>();
    args.clearance.map_or(Value::Null, |clearance_m| {
        json!({
            "clearance_m": clearance_m,
            "source": envelope::name(args.source()),
            "envelopes": sum(|work| work.paths),
            "without": sum(|work| work.no_envelope.iter().sum()),
            "candidate_pairs": sum(|work| work.candidates),
            "distances": sum(|work| work.tests),
        })
    })
}
