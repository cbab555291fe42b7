//! Evaluates conditions of elements: `requiredExtensions`, `systemLanguage` and `switch`.
//!
//! Source: SVG 2, section 5.7. Guideway has no extension, and reads drawings as an English reader.

use roxmltree::Node;

use super::shapes::SHAPES;

/// Elements besides shapes that a `switch` can choose.
const CHOICES: [&str; 7] = ["svg", "g", "a", "switch", "use", "text", "image"];

/// Returns whether the conditions of an element hold.
pub(super) fn is_met(node: Node<'_, '_>) -> bool {
    let is_english = |tag: &str| {
        let language = tag.split('-').next().unwrap_or(tag);
        language.trim().eq_ignore_ascii_case("en")
    };
    let languages = node.attribute("systemLanguage");
    !node.has_attribute("requiredExtensions")
        && languages.is_none_or(|tags| tags.split(',').any(is_english))
}

/// The child of a `switch` that is drawn: the first graphics element whose conditions hold.
pub(super) fn choice<'d, 't>(switch: Node<'d, 't>) -> Option<Node<'d, 't>> {
    let namespace = switch.tag_name().namespace();
    let mut children = switch.children().filter(Node::is_element);
    children.find(|child| {
        let tag = child.tag_name();
        let is_graphic = SHAPES.contains(&tag.name()) || CHOICES.contains(&tag.name());
        is_graphic && tag.namespace() == namespace && is_met(*child)
    })
}
