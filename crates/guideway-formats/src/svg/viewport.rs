//! Resolves lengths, viewports, view boxes and transforms of elements to user units.

use std::str::FromStr;

use guideway_spline::{Affine, Point};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, Transform, ViewBox};

/// Meters per CSS pixel, which is 1/96 of an inch.
pub(super) const METERS_PER_PX: f64 = 0.0254 / 96.0;

/// Pixels per `em`: the default font size of browsers. Font sizes of the drawing are not read.
const FONT_PX: f64 = 16.0;

/// The size that percentages refer to, in user units.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewport {
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Viewport {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self { width, height }
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
        let length = Length::from_str(text.trim()).ok()?;
        let factor = match length.unit {
            LengthUnit::None | LengthUnit::Px => 1.0,
            LengthUnit::In => 96.0,
            LengthUnit::Cm => 96.0 / 2.54,
            LengthUnit::Mm => 96.0 / 25.4,
            LengthUnit::Pt => 96.0 / 72.0,
            LengthUnit::Pc => 16.0,
            LengthUnit::Em => FONT_PX,
            LengthUnit::Ex => FONT_PX / 2.0,
            LengthUnit::Percent => reference(self) / 100.0,
        };
        let length = length.number * factor;
        length.is_finite().then_some(length)
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

/// The `transform` of an element; `None` if it is malformed.
pub(super) fn transform(node: Node<'_, '_>) -> Option<Affine> {
    let Some(text) = node.attribute("transform") else {
        return Some(Affine::IDENTITY);
    };
    let Transform { a, b, c, d, e, f } = Transform::from_str(text).ok()?;
    let affine = Affine {
        x: Point::new(a, b),
        y: Point::new(c, d),
        origin: Point::new(e, f),
    };
    affine.is_finite().then_some(affine)
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

/// Whether a length has a physical unit, such as mm or in.
pub(super) fn is_physical(text: &str) -> bool {
    let unit = Length::from_str(text.trim()).map(|length| length.unit);
    use LengthUnit::{Cm, In, Mm, Pc, Pt};
    matches!(unit, Ok(In | Cm | Mm | Pt | Pc))
}
