//! What a drawing holds besides paths, and how much of everything.

use guideway_layout::{Code, Layout, Place};
use roxmltree::Node;

use super::shapes::SHAPES;
use super::walk::Walker;
use crate::builder::PlaceFn;

/// What shows something that is no path.
const NOT_DRAWN: [&str; 4] = ["text", "image", "foreignObject", "video"];

/// What holds shapes that are only seen where something refers to them.
const DEFINITIONS: [&str; 6] = ["defs", "symbol", "clipPath", "mask", "pattern", "marker"];

/// What is counted.
const COUNTED: [&str; 5] = ["svg", "g", "use", "text", "image"];

impl<'d, 't> Walker<'_, 'd, 't> {
    /// Says what is not drawn, and counts.
    pub(super) fn finish(mut self, root: Node<'d, 't>) -> Layout {
        let count = |tag: &str| {
            let tagged = |node: &Node<'_, '_>| node.is_element() && node.tag_name().name() == tag;
            root.descendants().filter(tagged).count() as u64
        };
        let at: PlaceFn<'_> = &|| Place::element("the drawing");
        let mut note = |message: String, remedy: &str| {
            self.builder.report(Code::NotDrawn, at, || message, remedy);
        };
        for tag in NOT_DRAWN {
            let found = count(tag);
            if found > 0 {
                note(
                    format!("elements <{tag}>: {found}"),
                    "They are left out: what is read are shapes",
                );
            }
        }
        let definitions = root
            .descendants()
            .filter(|node| DEFINITIONS.contains(&node.tag_name().name()));
        let outermost = definitions.filter(|node| {
            let mut around = node.ancestors().skip(1);
            !around.any(|outer| DEFINITIONS.contains(&outer.tag_name().name()))
        });
        let inner = outermost.flat_map(|node| node.descendants());
        let defined = inner
            .filter(|node| SHAPES.contains(&node.tag_name().name()))
            .count();
        if defined > 0 {
            let message = format!("shapes within definitions: {defined}");
            note(
                message,
                "They are drawn where <use> refers to them, and not by themselves",
            );
        }
        if self.clipped > 0 {
            let message = format!("shapes with a clip path or a mask: {}", self.clipped);
            note(
                message,
                "They are drawn whole; cut them in the drawing program",
            );
        }
        if self.sheet.left_out > 0 {
            let message = format!(
                "selectors of style sheets that are not read: {}",
                self.sheet.left_out
            );
            note(
                message,
                "What is read are rules for an element, a class or an identifier",
            );
        }
        let counts = SHAPES
            .iter()
            .chain(&COUNTED)
            .map(|tag| ((*tag).to_owned(), count(tag)));
        let counts = counts.collect();
        let layout = &mut self.builder.layout;
        crate::Format::Svg
            .name()
            .clone_into(&mut layout.provenance.format);
        let version = root.attribute("version").unwrap_or_default();
        layout.provenance.format_version = version.chars().take(16).collect();
        layout.provenance.counts = counts;
        if !self.colors.is_empty() {
            layout.paths.set_color_rgba(self.colors);
            layout.paths.set_width_m(self.widths_m);
        }
        self.builder.layout
    }
}
