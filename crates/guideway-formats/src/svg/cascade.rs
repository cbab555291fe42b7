//! Cascades declarations of properties: values from attributes, style sheets and `style` in, one
//! value per property out.
//!
//! Source: CSS Cascading 4, section 6. Among valid declarations of a property the greatest
//! [`Priority`] wins.

use std::str::FromStr;

use svgtypes::{Color, Paint};

use super::length::{font_size_factor, is_length};
use super::transform::{is_origin, is_single_transform, is_transform};

macro_rules! properties {
    ($($variant:ident $name:literal)*) => {
        /// A property that changes how a shape is drawn.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Property { $($variant,)* }

        impl Property {
            /// All properties, in the order in which they are computed: lengths depend on the size
            /// of the font, paints on the color.
            pub(super) const ALL: &[Self] = &[$(Self::$variant,)*];

            fn of_name(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$variant),)*
                    _ => None,
                }
            }

            /// The name in a style sheet.
            pub(super) fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
}

properties! {
    FontSize "font-size"
    Color "color"
    Stroke "stroke"
    Fill "fill"
    StrokeWidth "stroke-width"
    StrokeOpacity "stroke-opacity"
    FillOpacity "fill-opacity"
    Opacity "opacity"
    Display "display"
    Visibility "visibility"
    ClipPath "clip-path"
    Mask "mask"
    VectorEffect "vector-effect"
    Transform "transform"
    Translate "translate"
    Rotate "rotate"
    Scale "scale"
    TransformOrigin "transform-origin"
    TransformBox "transform-box"
    X "x"
    Y "y"
    Width "width"
    Height "height"
    CenterX "cx"
    CenterY "cy"
    Radius "r"
    RadiusX "rx"
    RadiusY "ry"
    PathData "d"
}

/// Properties that state the geometry of a shape, as the attributes of their names do. SVG 2,
/// section 7.
const GEOMETRY: [Property; 10] = [
    Property::X,
    Property::Y,
    Property::Width,
    Property::Height,
    Property::CenterX,
    Property::CenterY,
    Property::Radius,
    Property::RadiusX,
    Property::RadiusY,
    Property::PathData,
];

/// Properties that transform an element.
const TRANSFORMS: [Property; 5] = [
    Property::Transform,
    Property::Translate,
    Property::Rotate,
    Property::Scale,
    Property::TransformOrigin,
];

/// Rank of a declaration among those of the same property.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Priority {
    is_important: bool,
    specificity: u8,
    /// Index of the rule in its sheets.
    order: usize,
}

/// Specificity of the attribute `style`: above every rule. That of attributes is 0, below.
pub(super) const INLINE: u8 = u8::MAX;

/// A declaration of a property.
#[derive(Clone, Copy, Debug)]
struct Declaration<'d> {
    property: Property,
    priority: Priority,
    value: &'d str,
}

/// The winning declaration of each property that is declared.
#[derive(Clone, Debug, Default)]
pub(super) struct Cascade<'d> {
    winners: Vec<Declaration<'d>>,
    /// The first declaration of a place or a shape whose value is not one that is read.
    unread: Option<(Property, &'d str)>,
}

impl<'d> Cascade<'d> {
    /// Adds the declarations of a block. Ignores those of other properties and invalid ones.
    pub(super) fn add_block(&mut self, block: &'d str, specificity: u8, order: usize) {
        for part in block.split(';') {
            if let Some((name, value)) = part.split_once(':') {
                // A comment may precede the name.
                let name = name.rsplit("*/").next().unwrap_or(name).trim();
                let (value, mark) = value.split_once('!').unwrap_or((value, ""));
                let priority = Priority {
                    is_important: mark.trim() == "important",
                    specificity,
                    order,
                };
                self.add(name, value, priority);
            }
        }
    }

    /// Adds a declaration as an attribute.
    pub(super) fn add_attribute(&mut self, name: &str, value: &'d str) {
        // Their grammar differs from that of the properties, or they have other meanings. Those of
        // the geometry are read with the shape.
        use Property::{Rotate, Scale, Transform, Translate};
        let is_other = |property: Property| {
            let of_transform = [Transform, Translate, Rotate, Scale];
            of_transform.contains(&property) || GEOMETRY.contains(&property)
        };
        if !Property::of_name(name).is_some_and(is_other) {
            self.add(name, value, Priority::default());
        }
    }

    fn add(&mut self, name: &str, value: &'d str, priority: Priority) {
        let (property, value) = match (Property::of_name(name), name) {
            (Some(property), _) => (property, value.trim()),
            (None, "font") => match font_size(value) {
                Some(size) => (Property::FontSize, size),
                None => return,
            },
            _ => return,
        };
        if is_valid(property, value) {
            self.offer(Declaration {
                property,
                priority,
                value,
            });
        } else if GEOMETRY.contains(&property) || TRANSFORMS.contains(&property) {
            // Words such as `auto` leave the property as it is.
            let has_number = value.contains(|c: char| c.is_ascii_digit());
            let unread = has_number.then_some((property, value));
            self.unread = self.unread.or(unread);
        }
    }

    fn offer(&mut self, declaration: Declaration<'d>) {
        let mut winners = self.winners.iter_mut();
        match winners.find(|winner| winner.property == declaration.property) {
            Some(winner) if winner.priority > declaration.priority => {}
            Some(winner) => *winner = declaration,
            None => self.winners.push(declaration),
        }
    }

    /// Adds all winners of another cascade with this specificity.
    pub(super) fn merge(&mut self, other: &Self, specificity: u8) {
        for &declaration in &other.winners {
            self.offer(Declaration {
                priority: Priority {
                    specificity,
                    ..declaration.priority
                },
                ..declaration
            });
        }
        self.unread = self.unread.or(other.unread);
    }

    /// The property of a place or a shape that has no value because none that is declared is read.
    pub(super) fn unread(&self) -> Option<(Property, &'d str)> {
        self.unread
            .filter(|(property, _)| self.value(*property).is_none())
    }

    /// The length that a property of the geometry has, by its name.
    pub(super) fn geometry(&self, name: &str) -> Option<&'d str> {
        let property = Property::of_name(name)?;
        self.value(property)
            .filter(|_| GEOMETRY.contains(&property))
    }

    /// The winning value of a property.
    pub(super) fn value(&self, property: Property) -> Option<&'d str> {
        let mut winners = self.winners.iter();
        let winner = winners.find(|winner| winner.property == property)?;
        Some(winner.value)
    }
}

/// The size in a value of the property `font`, such as `bold 12px/1.5 serif`.
fn font_size(value: &str) -> Option<&str> {
    let words = value.split_ascii_whitespace();
    let mut sizes = words.map(|word| word.split('/').next().unwrap_or(word));
    // Weights are numbers without a unit.
    sizes.find(|size| is_font_size(size) && size.parse::<f64>().is_err())
}

fn is_font_size(value: &str) -> bool {
    is_length(value) || font_size_factor(value).is_some()
}

/// Returns whether a property can have a value; a declaration of another one is void.
fn is_valid(property: Property, value: &str) -> bool {
    let is_paint = || !matches!(Paint::from_str(value), Err(_) | Ok(Paint::Inherit));
    value == "inherit"
        || match property {
            Property::Stroke | Property::Fill => is_paint(),
            Property::Color => Color::from_str(value).is_ok(),
            Property::StrokeWidth => is_length(value) && !value.starts_with('-'),
            Property::FontSize => is_font_size(value) && !value.starts_with('-'),
            Property::StrokeOpacity | Property::FillOpacity | Property::Opacity => {
                opacity(value).is_some()
            }
            Property::Transform => is_transform(value),
            Property::Translate | Property::Rotate | Property::Scale => {
                is_single_transform(property, value)
            }
            Property::TransformOrigin => is_origin(value),
            Property::Display
            | Property::Visibility
            | Property::ClipPath
            | Property::Mask
            | Property::VectorEffect
            | Property::TransformBox => !value.is_empty(),
            Property::X
            | Property::Y
            | Property::Width
            | Property::Height
            | Property::CenterX
            | Property::CenterY
            | Property::Radius
            | Property::RadiusX
            | Property::RadiusY => is_length(value),
            Property::PathData => value == "none" || path_function(value).is_some(),
        }
}

/// The path data in a value of the property `d`, such as `path("M0 0L1 1")`.
pub(super) fn path_function(value: &str) -> Option<&str> {
    let inner = value.strip_prefix("path(")?.strip_suffix(')')?.trim();
    ['"', '\'']
        .into_iter()
        .find_map(|quote| inner.strip_prefix(quote)?.strip_suffix(quote))
}

/// Parses an opacity, a number or a percentage, and clamps it to 0..=1.
pub(super) fn opacity(value: &str) -> Option<f64> {
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
    fn the_greatest_priority_wins() {
        let mut cascade = Cascade::default();
        cascade.add_block("stroke: red !important; fill: blue", 3, 0);
        cascade.add_block("stroke: blue; fill: black; fill: nonsense", 3, 1);
        cascade.add_attribute("fill", "white");
        cascade.add_block(
            "/* c */stroke: green; opacity: 50%; font: bold 2em/3 serif",
            INLINE,
            0,
        );
        for (property, expected) in [
            (Property::Stroke, Some("red")),
            (Property::Fill, Some("black")),
            (Property::Opacity, Some("50%")),
            (Property::FontSize, Some("2em")),
            (Property::Display, None),
        ] {
            assert_eq!(cascade.value(property), expected, "{property:?}");
        }
    }
}
