//! Changes of one open file that concern the whole window.

use guideway_spline::Bounds;

use crate::services::LoadStage;

/// A change of one open file that concerns the whole window.
pub(crate) enum LayerEvent {
    /// The file is read, and its paths are in this box.
    Appeared(Option<Bounds<f64>>),
    /// The file has reached a stage.
    Reached(LoadStage),
    /// The fallback method replaced the selected one; the reason as a sentence.
    FellBack(String),
    /// Its first picture is a crowd of paths, whose density says more than their colors.
    Crowded,
    /// A notice for the user.
    Notice(String),
}
