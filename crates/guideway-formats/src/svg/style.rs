//! Computes the style of an element: inherited style and winning declarations in; stroke, fill,
//! width, font size and visibility out.

use std::collections::HashSet;
use std::str::FromStr;

use svgtypes::{Color, PaintFallback};

use super::cascade::{Cascade, Property, opacity};
use super::length::{DEFAULT_FONT_PX, font_size_factor, length};
use super::viewport::Viewport;

/// Elements that a paint may refer to.
pub(super) const PAINT_SERVERS: [&str; 4] =
    ["linearGradient", "radialGradient", "pattern", "hatch"];

/// The identifiers of the gradients and patterns of a document.
pub(super) type PaintServers<'d> = HashSet<&'d str>;

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
    /// Size of the font, in user units.
    pub(super) font_size: f64,
    /// True if transforms leave the width of the stroke as it is. Not inherited.
    pub(super) is_stroke_fixed: bool,
    /// Product of the opacities of the element and all groups around it.
    opacity: f64,
    pub(super) is_displayed: bool,
    pub(super) is_visible: bool,
    /// True if it or a group around it has a clip path or a mask; Guideway ignores both.
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
        font_size: DEFAULT_FONT_PX,
        is_stroke_fixed: false,
        opacity: 1.0,
        is_displayed: true,
        is_visible: true,
        is_clipped: false,
    };

    /// The style of a child element, from its winning declarations.
    pub(super) fn of_child(
        mut self,
        cascade: &Cascade<'_>,
        viewport: Viewport,
        servers: &PaintServers<'_>,
    ) -> Self {
        let parent = self;
        self.is_stroke_fixed = false;
        for &property in Property::ALL {
            if let Some(value) = cascade.value(property) {
                self.set(property, value, parent, viewport, servers);
            }
        }
        self
    }

    /// Sets a property to a valid value.
    fn set(
        &mut self,
        property: Property,
        value: &str,
        parent: Self,
        viewport: Viewport,
        servers: &PaintServers<'_>,
    ) {
        let is_inherited = value == "inherit";
        let of_parent = |own: f64| opacity(value).unwrap_or(own);
        match property {
            Property::FontSize => self.set_font_size(value, viewport),
            Property::Color => self.color = Color::from_str(value).unwrap_or(self.color),
            Property::Stroke => self.stroke = self.paint(value, servers).unwrap_or(parent.stroke),
            Property::Fill => self.fill = self.paint(value, servers).unwrap_or(parent.fill),
            Property::StrokeWidth => {
                let viewport = viewport.with_font_size(self.font_size);
                let width = viewport.length(value, Viewport::diagonal);
                self.stroke_width = width.unwrap_or(parent.stroke_width);
            }
            Property::StrokeOpacity => self.stroke_opacity = of_parent(parent.stroke_opacity),
            Property::FillOpacity => self.fill_opacity = of_parent(parent.fill_opacity),
            Property::Opacity => self.opacity = parent.opacity * of_parent(1.0),
            Property::Display => self.is_displayed = parent.is_displayed && value != "none",
            Property::Visibility if !is_inherited => self.is_visible = value == "visible",
            Property::ClipPath | Property::Mask => {
                self.is_clipped |= value != "none" && !is_inherited;
            }
            Property::VectorEffect => self.is_stroke_fixed = value.contains("non-scaling-stroke"),
            Property::Visibility
            | Property::Transform
            | Property::Translate
            | Property::Rotate
            | Property::Scale
            | Property::TransformOrigin
            | Property::TransformBox
            | Property::X
            | Property::Y
            | Property::Width
            | Property::Height
            | Property::CenterX
            | Property::CenterY
            | Property::Radius
            | Property::RadiusX
            | Property::RadiusY
            | Property::PathData => {}
        }
    }

    /// Sets the size of the font. Lengths relative to a font refer to that of the parent.
    fn set_font_size(&mut self, value: &str, viewport: Viewport) {
        let size = match font_size_factor(value) {
            Some((factor, true)) => Some(self.font_size * factor),
            Some((factor, false)) => Some(DEFAULT_FONT_PX * factor),
            None => {
                let fonts = viewport.with_font_size(self.font_size).fonts;
                length(value, fonts, self.font_size)
            }
        };
        self.font_size = size.unwrap_or(self.font_size);
    }

    /// The paint that a value says. A reference to no paint, without a fallback, is no paint.
    fn paint(&self, value: &str, servers: &PaintServers<'_>) -> Option<Paint> {
        use svgtypes::Paint as Found;
        Some(match Found::from_str(value).ok()? {
            Found::None | Found::FuncIRI(_, Some(PaintFallback::None)) => Paint::None,
            Found::Color(color) | Found::FuncIRI(_, Some(PaintFallback::Color(color))) => {
                Paint::Color(color)
            }
            Found::CurrentColor | Found::FuncIRI(_, Some(PaintFallback::CurrentColor)) => {
                Paint::Color(self.color)
            }
            Found::FuncIRI(id, None) if !servers.contains(id) => Paint::None,
            Found::FuncIRI(_, None) | Found::ContextFill | Found::ContextStroke => Paint::Other,
            Found::Inherit => return None,
        })
    }

    /// Tells if the stroke has a paint and a width.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn style(parent: Style, declarations: &str) -> Style {
        let mut cascade = Cascade::default();
        cascade.add_block(declarations, 0, 0);
        let servers = PaintServers::from(["gradient"]);
        parent.of_child(&cascade, Viewport::new(100.0, 100.0), &servers)
    }

    #[test]
    fn multiplies_opacities_and_ignores_malformed_values() {
        let initial = Style::INITIAL;
        assert_eq!(initial.color_rgba(), Some(0x0000_00FF), "the default fill");
        let half = style(initial, "stroke: #fff; stroke-opacity: 50%; opacity: .5");
        assert_eq!(half.color_rgba(), Some(0xFFFF_FF40));
        let same = style(half, "stroke: nonsense; opacity: x");
        assert_eq!(same.color_rgba(), Some(0xFFFF_FF40));
        let gradient = style(half, "stroke: url(#gradient)");
        assert_eq!(gradient.color_rgba(), Some(0));
        for (stroke, color) in [
            ("url(#none)", None),
            ("url(#none) #abcdef", Some(0xABCD_EF40)),
        ] {
            let found = style(half, &format!("stroke: {stroke}; fill: none"));
            assert_eq!(found.color_rgba(), color, "{stroke}");
        }
        let invisible = style(half, "opacity: 0; stroke: none");
        assert_eq!(invisible.color_rgba(), None);
    }

    #[test]
    fn paints_follow_the_color_whatever_their_order() {
        let found = style(Style::INITIAL, "stroke: currentColor; color: #123456");
        assert_eq!(found.color_rgba(), Some(0x1234_56FF));
    }

    #[test]
    fn fonts_scale_the_widths_of_strokes() {
        let parent = style(Style::INITIAL, "font-size: 20px; stroke: red");
        for (declarations, expected) in [
            ("stroke-width: 1em", 20.0),
            ("stroke-width: .5em; font-size: 2em", 20.0),
            ("font-size: 50%; stroke-width: 1em", 10.0),
            ("font-size: larger; stroke-width: 1em", 24.0),
            ("font: italic 700 8px/2 serif; stroke-width: 1em", 8.0),
            ("stroke-width: 1rem", 16.0),
            ("stroke-width: -1", 1.0),
        ] {
            let width = style(parent, declarations).stroke_width;
            assert!((width - expected).abs() < 1e-12, "{declarations}: {width}");
        }
    }
}
