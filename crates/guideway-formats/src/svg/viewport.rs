//! Resolves viewports, view boxes and the lengths that refer to them to user units.

use std::str::FromStr;

use guideway_spline::{Affine, Point};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, ViewBox};

use super::length::{FontSizes, length};

/// Meters per CSS pixel, which is 1/96 of an inch.
pub(super) const METERS_PER_PX: f64 = 0.0254 / 96.0;

/// The sizes that lengths refer to, in user units: of the viewport and of the font.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Viewport {
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) fonts: FontSizes,
}

impl Viewport {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            fonts: FontSizes::INITIAL,
        }
    }

    /// The viewport of a nested element, with the same fonts.
    pub(super) fn resized(self, width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            ..self
        }
    }

    /// The viewport for an element with this font size.
    pub(super) fn with_font_size(mut self, own: f64) -> Self {
        self.fonts.own = own;
        self
    }

    /// Reference of lengths along x.
    pub(super) fn width(self) -> f64 {
        self.width
    }

    /// Reference of lengths along y.
    pub(super) fn height(self) -> f64 {
        self.height
    }

    /// Reference of lengths along neither axis, such as radii. Source: SVG 2, section 8.9.
    pub(super) fn diagonal(self) -> f64 {
        (0.5 * (self.width * self.width + self.height * self.height)).sqrt()
    }

    /// Parses a length to user units; percentages are of `reference`.
    pub(super) fn length(self, text: &str, reference: fn(Self) -> f64) -> Option<f64> {
        length(text, self.fonts, reference(self))
    }

    /// The length in an attribute.
    pub(super) fn attribute(
        self,
        node: Node<'_, '_>,
        name: &'static str,
        reference: fn(Self) -> f64,
    ) -> Option<f64> {
        self.length(node.attribute(name)?, reference)
    }
}

/// Parses a view box with a positive size.
pub(super) fn view_box(text: &str) -> Option<ViewBox> {
    let view = ViewBox::from_str(text).ok()?;
    let is_finite = [view.x, view.y, view.w, view.h]
        .iter()
        .all(|v| v.is_finite());
    (is_finite && view.w > 0.0 && view.h > 0.0).then_some(view)
}

/// The transform from a view box to a page of a size, by `preserveAspectRatio`.
pub(super) fn view_box_transform(
    node: Node<'_, '_>,
    view: ViewBox,
    width: f64,
    height: f64,
) -> Affine {
    let ratio = node.attribute("preserveAspectRatio");
    let ratio = ratio.and_then(|text| AspectRatio::from_str(text).ok());
    let (align, is_slice) = ratio.map_or((Align::XMidYMid, false), |r| (r.align, r.slice));
    let (mut x, mut y) = (width / view.w, height / view.h);
    if align != Align::None {
        let both = if is_slice { x.max(y) } else { x.min(y) };
        (x, y) = (both, both);
    }
    // Half steps from the start (0) to the end (2) of each axis.
    let (x_align, y_align) = match align {
        Align::None | Align::XMinYMin => (0, 0),
        Align::XMidYMin => (1, 0),
        Align::XMaxYMin => (2, 0),
        Align::XMinYMid => (0, 1),
        Align::XMidYMid => (1, 1),
        Align::XMaxYMid => (2, 1),
        Align::XMinYMax => (0, 2),
        Align::XMidYMax => (1, 2),
        Align::XMaxYMax => (2, 2),
    };
    let offset = Point::new(
        f64::from(x_align) / 2.0 * (width - view.w * x),
        f64::from(y_align) / 2.0 * (height - view.h * y),
    );
    Affine::translation(Point::new(-view.x, -view.y))
        .then(Affine::scale(x, y, Point::new(0.0, 0.0)))
        .then(Affine::translation(offset))
}

/// The position in the attributes `x` and `y`.
pub(super) fn corner(node: Node<'_, '_>, viewport: Viewport) -> Point<f64> {
    let x = viewport.attribute(node, "x", Viewport::width);
    let y = viewport.attribute(node, "y", Viewport::height);
    Point::new(x.unwrap_or(0.0), y.unwrap_or(0.0))
}
