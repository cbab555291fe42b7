//! Computes the style of an element: inherited style, attributes, style sheet rules and its `style`
//! attribute in; stroke, fill, width and visibility out.

use std::str::FromStr;

use roxmltree::Node;
use svgtypes::{Color, PaintFallback};

use super::style_sheet::{StyleSheet, declarations};
use super::viewport::Viewport;

/// The paint of a stroke or a fill.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Paint {
    None,
    Color(Color),
    /// A gradient or a pattern: drawn in the color of the view.
    Other,
}

/// The computed style of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    stroke: Paint,
    fill: Paint,
    color: Color,
    pub(super) stroke_width: f64,
    stroke_opacity: f64,
    fill_opacity: f64,
    /// Product of the opacities of the element and all groups around it.
    opacity: f64,
    pub(super) is_displayed: bool,
    pub(super) is_visible: bool,
    /// Whether it or a group around it has a clip path or a mask; Guideway ignores both.
    pub(super) is_clipped: bool,
}

impl Style {
    /// The style of the root element: black fill, no stroke.
    pub(super) const INITIAL: Self = Self {
        stroke: Paint::None,
        fill: Paint::Color(Color {
            red: 0,
            green: 0,
            blue: 0,
            alpha: 255,
        }),
        color: Color {
            red: 0,
            green: 0,
            blue: 0,
            alpha: 255,
        },
        stroke_width: 1.0,
        stroke_opacity: 1.0,
        fill_opacity: 1.0,
        opacity: 1.0,
        is_displayed: true,
        is_visible: true,
        is_clipped: false,
    };

    /// The style of a child element of an element with this style.
    pub(super) fn of_child(
        mut self,
        node: Node<'_, '_>,
        sheet: &StyleSheet<'_>,
        viewport: Viewport,
    ) -> Self {
        let parent = self;
        let attributes = node.attributes();
        let own = attributes.filter(|a| a.namespace().is_none());
        for attribute in own.filter(|a| a.name() != "style") {
            self.set(attribute.name(), attribute.value(), parent, viewport);
        }
        let written = node.attribute("style").unwrap_or_default();
        for (name, value) in sheet.matching(node).chain([written]).flat_map(declarations) {
            self.set(name, value, parent, viewport);
        }
        self
    }

    /// Sets a property. Ignores a malformed value, as SVG requires.
    fn set(&mut self, name: &str, value: &str, parent: Self, viewport: Viewport) {
        let value = value.trim();
        let is_inherited = value == "inherit";
        let opacity = || opacity(value);
        match name {
            "stroke" if is_inherited => self.stroke = parent.stroke,
            "stroke" => self.stroke = self.paint(value).unwrap_or(self.stroke),
            "fill" if is_inherited => self.fill = parent.fill,
            "fill" => self.fill = self.paint(value).unwrap_or(self.fill),
            "color" => self.color = Color::from_str(value).unwrap_or(self.color),
            "stroke-width" => {
                let width = viewport.length(value, Viewport::diagonal);
                self.stroke_width = width.filter(|w| *w >= 0.0).unwrap_or(self.stroke_width);
            }
            "stroke-opacity" => self.stroke_opacity = opacity().unwrap_or(self.stroke_opacity),
            "fill-opacity" => self.fill_opacity = opacity().unwrap_or(self.fill_opacity),
            "opacity" => self.opacity = opacity().map_or(self.opacity, |o| parent.opacity * o),
            "display" => self.is_displayed = parent.is_displayed && value != "none",
            "visibility" if !is_inherited => self.is_visible = value == "visible",
            "clip-path" | "mask" => self.is_clipped = parent.is_clipped || value != "none",
            _ => {}
        }
    }

    fn paint(&self, value: &str) -> Option<Paint> {
        use svgtypes::Paint as Found;
        Some(match Found::from_str(value).ok()? {
            Found::None | Found::FuncIRI(_, Some(PaintFallback::None)) => Paint::None,
            Found::Color(color) | Found::FuncIRI(_, Some(PaintFallback::Color(color))) => {
                Paint::Color(color)
            }
            Found::CurrentColor | Found::FuncIRI(_, Some(PaintFallback::CurrentColor)) => {
                Paint::Color(self.color)
            }
            Found::FuncIRI(_, None) | Found::ContextFill | Found::ContextStroke => Paint::Other,
            Found::Inherit => return None,
        })
    }

    /// Whether the stroke has a paint and a width.
    pub(super) fn has_stroke(&self) -> bool {
        self.stroke != Paint::None && self.stroke_width > 0.0
    }

    /// The color of the path, 0xRRGGBBAA: of the stroke, or of the fill without a stroke. 0 for the
    /// color of the view; `None` if it has no paint or is fully transparent.
    pub(super) fn color_rgba(&self) -> Option<u32> {
        let (paint, opacity) = match self.has_stroke() {
            true => (self.stroke, self.stroke_opacity),
            false => (self.fill, self.fill_opacity),
        };
        let color = match paint {
            Paint::None => return None,
            Paint::Other => return Some(0),
            Paint::Color(color) => color,
        };
        let alpha = (f64::from(color.alpha) * opacity * self.opacity).round() as u8;
        let rgba = u32::from_be_bytes([color.red, color.green, color.blue, alpha]);
        (alpha > 0).then_some(rgba)
    }
}

/// Parses an opacity, a number or a percentage, and clamps it to 0..=1.
fn opacity(value: &str) -> Option<f64> {
    let number = match value.strip_suffix('%') {
        Some(percent) => percent.trim().parse::<f64>().ok()? / 100.0,
        None => value.parse().ok()?,
    };
    number.is_finite().then(|| number.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiplies_opacities_and_ignores_malformed_values() {
        let mut style = Style::INITIAL;
        assert_eq!(style.color_rgba(), Some(0x0000_00FF), "the default fill");
        let viewport = Viewport::new(100.0, 100.0);
        for (name, value) in [
            ("stroke", "#fff"),
            ("stroke-opacity", "50%"),
            ("opacity", ".5"),
        ] {
            style.set(name, value, Style::INITIAL, viewport);
        }
        assert_eq!(style.color_rgba(), Some(0xFFFF_FF40));
        style.set("stroke", "nonsense", Style::INITIAL, viewport);
        assert_eq!(
            style.color_rgba(),
            Some(0xFFFF_FF40),
            "a malformed value is ignored"
        );
        style.set("stroke", "url(#gradient)", Style::INITIAL, viewport);
        assert_eq!(style.color_rgba(), Some(0));
        style.set("opacity", "0", Style::INITIAL, viewport);
        style.set("stroke", "none", Style::INITIAL, viewport);
        assert_eq!(style.color_rgba(), None);
    }
}
