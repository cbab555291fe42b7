//! Counts the elements of a drawing for its provenance, and reports those that Guideway ignores.

use guideway_layout::{Code, Place};
use roxmltree::Node;

use super::shapes::SHAPES;
use super::style_sheet::StyleSheet;
use crate::builder::{Builder, PlaceFn};
use crate::text::printable;

/// Elements that show something other than a path.
const NOT_DRAWN: [&str; 4] = ["text", "image", "foreignObject", "video"];

/// Elements whose shapes are only drawn where something refers to them.
const DEFINITIONS: [&str; 6] = ["defs", "symbol", "clipPath", "mask", "pattern", "marker"];

/// Counted elements besides shapes.
const COUNTED: [&str; 5] = ["svg", "g", "use", "text", "image"];

/// Number of elements per counted tag.
pub(super) fn element_counts(root: Node<'_, '_>) -> Vec<(String, u64)> {
    let tags = SHAPES.iter().chain(&COUNTED);
    tags.map(|tag| ((*tag).to_owned(), count(root, tag)))
        .collect()
}

/// Reports texts, images and definitions, the number of `clipped` paths, and the number of
/// unsupported selectors of style sheets; and the style sheets of other files.
pub(super) fn report_ignored(
    builder: &mut Builder<'_>,
    root: Node<'_, '_>,
    clipped: u64,
    sheet: &StyleSheet<'_>,
) {
    let at: PlaceFn<'_> = &|| Place::element("the drawing");
    let mut report = |message: String, remedy: &str| {
        builder.report(Code::NotDrawn, at, || message, remedy);
    };
    for tag in NOT_DRAWN {
        let found = count(root, tag);
        if found > 0 {
            let remedy = "They are left out; Guideway draws shapes only";
            report(format!("<{tag}> elements: {found}"), remedy);
        }
    }
    let defined = shapes_in_definitions(root);
    if defined > 0 {
        let message = format!("shapes within definitions: {defined}");
        let remedy = "Only <use> elements that refer to them are drawn";
        report(message, remedy);
    }
    if clipped > 0 {
        let message = format!("shapes with a clip path or a mask: {clipped}");
        let remedy = "They are drawn without clipping; cut them in the drawing program";
        report(message, remedy);
    }
    let ignored = sheet.ignored_selectors;
    if ignored > 0 {
        let message = format!("unsupported style sheet selectors: {ignored}");
        let remedy = "Guideway reads rules for an element, a class or an identifier";
        report(message, remedy);
    }
    for file in &sheet.in_other_files {
        let message = || format!("the style sheet `{}` is not in this file", printable(file));
        let remedy = "Lines may have other colors and widths, or be hidden: put its rules into a \
                      <style> element";
        builder.report(Code::UnknownValue, at, message, remedy);
    }
}

fn count(root: Node<'_, '_>, tag: &str) -> u64 {
    let has_tag = |node: &Node<'_, '_>| node.is_element() && node.tag_name().name() == tag;
    root.descendants().filter(has_tag).count() as u64
}

fn shapes_in_definitions(root: Node<'_, '_>) -> usize {
    let is_definition = |node: &Node<'_, '_>| DEFINITIONS.contains(&node.tag_name().name());
    // Nested definitions count once, with their outermost one.
    let outermost = root
        .descendants()
        .filter(|node| is_definition(node) && !node.ancestors().skip(1).any(|a| is_definition(&a)));
    let inner = outermost.flat_map(|node| node.descendants());
    inner
        .filter(|node| SHAPES.contains(&node.tag_name().name()))
        .count()
}
