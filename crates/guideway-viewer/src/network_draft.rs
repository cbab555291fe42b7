//! The network that a drawing would become: options, and the result of the background task.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_layout::{Layout, UserError};
use guideway_network::{
    BuildOptions, BuildReport, DrawingSources, LayerRule, Network, NoteSource, build,
};

use crate::background::{LatestTask, RepaintHandle};
use crate::files::{Layer, OpenFiles};

/// Ends within this distance become one node, in meters, until the user chooses another one.
const WELD_M: f64 = 0.05;

/// The subject of a result: the file, the state of its document, and the options.
#[derive(Clone, Debug, PartialEq)]
struct DraftKey {
    file: PathBuf,
    state: u64,
    options: BuildOptions,
}

impl DraftKey {
    /// Returns `true` if the subject is the present drawing, with any options.
    fn is_present(&self, files: &OpenFiles) -> bool {
        let active = files.active().filter(|active| active.path() == self.file);
        let document = active.and_then(Layer::document);
        document.is_some_and(|document| document.state() == self.state)
    }
}

/// A network that is not in the drawing yet.
pub(crate) struct Drafted {
    pub(crate) layout: Arc<Layout>,
    pub(crate) report: BuildReport,
    /// The report in words.
    pub(crate) lines: Vec<String>,
}

struct Made {
    sources: Arc<DrawingSources>,
    network: Result<Drafted, UserError>,
}

/// Options and result of the network of the active file.
pub(crate) struct NetworkDraft {
    pub(crate) options: BuildOptions,
    latest: LatestTask<DraftKey, Made>,
}

impl Default for NetworkDraft {
    fn default() -> Self {
        let options = BuildOptions {
            weld_m: WELD_M,
            split_junctions: true,
            split_crossings: true,
            ..BuildOptions::default()
        };
        Self {
            options,
            latest: LatestTask::default(),
        }
    }
}

impl NetworkDraft {
    /// The key of the present drawing and options; `None` while the document is not there.
    fn key(&self, files: &OpenFiles) -> Option<DraftKey> {
        let active = files.active()?;
        Some(DraftKey {
            file: active.path().to_owned(),
            state: active.document()?.state(),
            options: self.options.clone(),
        })
    }

    pub(crate) fn is_busy(&self) -> bool {
        self.latest.is_busy()
    }

    /// Layers and notes of the active file.
    pub(crate) fn sources(&self, files: &OpenFiles) -> Option<Arc<DrawingSources>> {
        let path = files.active()?.path();
        let (key, made) = self.latest.result()?;
        (key.file == path).then(|| Arc::clone(&made.sources))
    }

    /// The network of the present drawing by the last options, or why there is none; `is_ready`
    /// tells whether the options are those of the panel.
    pub(crate) fn network(&self, files: &OpenFiles) -> Option<Result<&Drafted, &UserError>> {
        let (key, made) = self.latest.result()?;
        key.is_present(files).then_some(made.network.as_ref())
    }

    /// Returns `true` if [`Self::network`] is by the present options.
    pub(crate) fn is_ready(&self, files: &OpenFiles) -> bool {
        let done = self.latest.result();
        done.is_some_and(|(key, _)| key.options == self.options && key.is_present(files))
    }

    /// Builds again after a change; takes a finished result.
    pub(crate) fn update(&mut self, files: &OpenFiles, repaint: &RepaintHandle) {
        self.latest.take_finished(|error| Made {
            sources: Arc::default(),
            network: Err(error),
        });
        let (Some(key), Some(document)) = (self.key(files), files.document()) else {
            return;
        };
        if !self.latest.is_due(&key) {
            return;
        }
        let (snapshot, options) = (document.snapshot(), self.options.clone());
        self.latest.start(key, repaint, move || {
            let drawing = snapshot.to_layout();
            let sources = Arc::new(DrawingSources::of(&drawing));
            let network = build(&drawing, &options).map_err(UserError::from);
            let network = network.map(|Network { layout, report }| Drafted {
                layout: Arc::new(layout),
                lines: report.lines(&options),
                report,
            });
            Made { sources, network }
        });
    }

    /// Frees the network; the options stay.
    pub(crate) fn forget(&mut self) {
        self.latest = LatestTask::default();
    }

    /// The rule that the build applies to a layer, under the name of the layer; the default one if
    /// none fits.
    pub(crate) fn rule(&self, layer: &str) -> LayerRule {
        let rules = &mut self.options.layers.iter();
        let found = rules.find(|rule| rule.fits(layer)).cloned();
        LayerRule {
            name: layer.to_owned(),
            ..found.unwrap_or_default()
        }
    }

    /// Replaces the rule of a layer, before those of patterns that fit it too; a rule that changes
    /// nothing is dropped.
    pub(crate) fn set_rule(&mut self, rule: LayerRule) {
        let rules = &mut self.options.layers;
        rules.retain(|other| other.name != rule.name);
        if rule != self.rule(&rule.name) {
            self.options.layers.insert(0, rule);
        }
    }
}

/// Adds a source to a list, or takes it out.
pub(crate) fn toggle_source(sources: &mut Vec<NoteSource>, source: &NoteSource) {
    let count = sources.len();
    sources.retain(|other| other != source);
    if sources.len() == count {
        sources.push(source.clone());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The build takes the first rule that fits a layer, whatever its case, and so must the panel.
    #[test]
    fn rule_of_a_pattern_is_that_of_its_layers() {
        let mut draft = NetworkDraft::default();
        let walls = LayerRule {
            leave: true,
            ..draft.rule("wall*")
        };
        draft.set_rule(walls);
        let shown = draft.rule("WALLS");
        assert!(shown.leave && shown.name == "WALLS");
        assert!(!draft.rule("LANES").leave);
        let kept = LayerRule {
            leave: false,
            ..shown
        };
        draft.set_rule(kept);
        assert!(!draft.rule("WALLS").leave && draft.rule("WALL-2").leave);
        let mut rules = draft.options.layers.iter();
        let first = rules.find(|rule| rule.fits("WALLS"));
        assert!(
            first.is_some_and(|rule| !rule.leave),
            "the build does so too"
        );
    }

    #[test]
    fn rule_that_says_nothing_is_dropped() {
        let mut draft = NetworkDraft::default();
        let rule = LayerRule {
            leave: true,
            ..draft.rule("WALLS")
        };
        draft.set_rule(rule.clone());
        draft.set_rule(rule.clone());
        assert_eq!(draft.options.layers, std::slice::from_ref(&rule));
        let rule = LayerRule {
            leave: false,
            ..rule
        };
        draft.set_rule(rule);
        assert_eq!(draft.options.layers, []);
    }
}
