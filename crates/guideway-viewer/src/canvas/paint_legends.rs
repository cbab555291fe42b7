//! Legends: the meaning of the colors that are drawn, of each file in view.

use std::borrow::Cow;

use guideway_document::decorations::{Corner, DecorationStyle, legend};
use guideway_document::text_format::single_line;
use guideway_scene::{DrawList, FrameSize, Legend, LegendEntry};

use crate::display_settings::DisplaySettings;
use crate::files::{Layer, OpenFiles};
use crate::language::{Language, language, say, t};

/// Longest name of a file in a title, in characters: the column stays readable beside it.
const MAX_NAME_CHARS: usize = 20;

/// The meaning of the colors of each visible file as they are drawn, the upper file first: of the
/// column, or of the density. With several files each title begins with the name of its file.
pub(crate) fn shown_legends<'a>(
    files: &'a OpenFiles,
    settings: &DisplaySettings,
) -> Vec<Cow<'a, Legend>> {
    let mut visible: Vec<&Layer> = files.visible().collect();
    visible.reverse();
    let has_several = visible.len() > 1;
    let of_file = |layer: &'a Layer| {
        let colors = colors_of(layer, settings)?;
        let titled = titled(colors, has_several.then(|| layer.name()));
        Some(match settings.breaks.breaks() {
            Some(_) => with_class_names(titled),
            None => titled,
        })
    };
    visible.into_iter().filter_map(of_file).collect()
}

/// The meaning of the colors of a file.
fn colors_of<'a>(layer: &'a Layer, settings: &DisplaySettings) -> Option<&'a Legend> {
    match settings.shows_density() {
        _ if !layer.look.has_paths => None,
        true => layer.picture.shown()?.report.density.as_ref(),
        false => layer.document()?.scene().legend(),
    }
}

/// A legend with the name of its file, if there is one, and its title in the language of the
/// window, if the title is not a name of the file.
fn titled(legend: &Legend, file: Option<String>) -> Cow<'_, Legend> {
    let title = t(&legend.column);
    let column = match file {
        Some(file) => format!("{}: {title}", single_line(&file, MAX_NAME_CHARS)),
        None if title == legend.column => return Cow::Borrowed(legend),
        None => title.to_owned(),
    };
    Cow::Owned(Legend {
        column,
        ..legend.clone()
    })
}

/// A legend whose classes between breaks have their names in the language of the window.
fn with_class_names(legend: Cow<'_, Legend>) -> Cow<'_, Legend> {
    if language() == Language::English {
        return legend;
    }
    let mut legend = legend.into_owned();
    for LegendEntry { label, .. } in &mut legend.entries {
        *label = class_name(label);
    }
    Cow::Owned(legend)
}

fn class_name(label: &str) -> String {
    if let Some(end) = label.strip_prefix("below ") {
        return say!("below {end}", end);
    }
    if let Some(start) = label.strip_suffix(" and more") {
        return say!("{start} and more", start);
    }
    match label.split_once(" to ") {
        Some((start, end)) => say!("{start} to {end}", start, end),
        None => t(label).to_owned(),
    }
}

/// Legends below each other in the upper left corner, as far as they fit.
pub(crate) fn legends(
    shown: &[Cow<'_, Legend>],
    size: FrameSize,
    style: &DecorationStyle,
) -> Vec<DrawList> {
    let mut top_px = 0.0;
    let place = |colors: &Cow<'_, Legend>| {
        let (list, bounds) = legend(colors, size, top_px, Corner::UpperLeft, style)?;
        top_px = bounds.max.y;
        Some(list)
    };
    shown.iter().filter_map(place).collect()
}
