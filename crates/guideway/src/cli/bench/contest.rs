//! The measurement that the arguments of `bench` describe.

use std::path::Path;

use guideway::layout::UserError;
use guideway::scene::density::ToneMap;
use guideway::scene::{Budget, LineRule, Shading, Style};
use guideway_bench::{Contest, Dataset, Motion, Moves, StylePreset, Way, plain_scene};

use super::args::{Args, MotionKind, StyleChoice};
use crate::cli::error::usage_error;
use crate::cli::input;
use crate::cli::output::Output;
use crate::cli::render::{Rule, Shade};

/// Paths of a dataset without `--paths`.
const DEFAULT_PATHS: usize = 10_000;
/// Share of the paths that move without `--moved`.
const DEFAULT_MOVED_PERCENT: f64 = 1.0;

impl Args {
    /// The layout file; `None` for a dataset or the tools.
    pub(super) fn file(&self) -> Option<&Path> {
        let is_file = self.dataset().is_none() && !self.is_of_tools();
        is_file.then_some(&*self.subject)
    }

    /// Returns `true` if the tools of a network are measured, not render methods.
    pub(super) fn is_of_tools(&self) -> bool {
        self.subject.as_os_str() == "tools"
    }

    fn dataset(&self) -> Option<Dataset> {
        match self.subject.to_str() {
            Some("d1") => Some(Dataset::D1),
            Some("d2") => Some(Dataset::D2),
            _ => None,
        }
    }

    /// The measurement that the arguments describe.
    pub(super) fn contest(&self, out: &Output) -> Result<Contest, UserError> {
        if self.file().is_some() && self.paths.is_some() {
            return Err(usage_error(
                "--paths applies only to the datasets d1 and d2",
                "Omit --paths, or measure a dataset, such as `guideway bench d1 --paths 100000`",
            ));
        }
        let has_way = self.apart || self.drop || self.remove || self.restyle || self.recolor;
        if self.motion != MotionKind::Edit && (self.moved.is_some() || has_way) {
            return Err(usage_error(
                "--moved, --drop, --apart, --remove, --restyle and --recolor apply only with \
                 --motion edit",
                "Add it, such as `--motion edit --moved 10`",
            ));
        }
        let scene = match self.dataset() {
            Some(dataset) => {
                let _progress = out.progress("generating the dataset");
                dataset.scene(self.paths.unwrap_or(DEFAULT_PATHS))
            }
            None => plain_scene(input::read(&self.subject, out)?.0),
        };
        let style_preset = match self.dress {
            StyleChoice::Own => StylePreset::Own,
            StyleChoice::Mixed => StylePreset::Mixed,
            StyleChoice::Translucent => StylePreset::Translucent,
        };
        Ok(Contest {
            name: self.subject.to_string_lossy().into_owned(),
            scene: style_preset.scene(scene),
            style_preset,
            methods: self.specs(),
            size: self.size,
            magnify: self.magnify,
            motion: match self.motion {
                MotionKind::Still => Motion::Still,
                MotionKind::Pan => Motion::Pan,
                MotionKind::Zoom => Motion::Zoom,
                MotionKind::Edit => Motion::Edit,
            },
            edit: Moves {
                share: self.moved.unwrap_or(DEFAULT_MOVED_PERCENT) / 100.0,
                way: self.way(),
            },
            style: Style {
                line_rule: match (self.width_px, self.line_rule) {
                    (Some(width_px), _) => LineRule::World {
                        width_m: 0.0,
                        min_px: width_px,
                        max_px: width_px,
                    },
                    (None, Rule::World) => LineRule::default(),
                    (None, Rule::Thesis) => LineRule::Thesis,
                },
                shading: match self.shade {
                    Shade::Color => Shading::Color,
                    Shade::Density => Shading::Density(ToneMap::default()),
                },
                ..Style::default()
            },
            budget: Budget {
                memory_bytes: self.memory.saturating_mul(1_000_000),
                threads: self.threads,
            },
            warmup: self.warmup,
            frames: self.frames,
            enough_ms: f64::INFINITY,
        })
    }

    fn way(&self) -> Way {
        let ways = [
            (self.drop, Way::Drop),
            (self.apart, Way::Apart),
            (self.remove, Way::Remove),
            (self.restyle, Way::Restyle),
            (self.recolor, Way::Recolor),
        ];
        let chosen = ways.into_iter().find(|(is_chosen, _)| *is_chosen);
        chosen.map_or(Way::Gesture, |(_, way)| way)
    }

    /// The requested methods, or all that run here except the slow reference.
    pub(super) fn specs(&self) -> Vec<String> {
        if self.methods.is_empty() {
            let all = guideway::methods().into_iter();
            let running = all.filter(|m| m.unavailable.is_none() && m.info.name != "oracle");
            return running.map(|m| m.info.name.to_owned()).collect();
        }
        self.methods.clone()
    }
}
