//! Transforms of elements: parses them with their origin, and measures the bounding box that
//! `transform-box` may refer to.
//!
//! The box of an element is that of its shapes in its own user space, without strokes. Source: SVG
//! 2, section 8.10; CSS Transforms 1, section 6.

use guideway_layout::Code;
use guideway_spline::{Affine, Bounds, Point};
use roxmltree::Node;

use super::cascade::{Cascade, Property};
use super::context::ElementContext;
use super::transform::{
    about, attribute_transform, css_transform, single_transform, transform_origin,
};
use super::viewport::Viewport;
use crate::ReadError;
use crate::xml_builder::XmlBuilder;

/// Measures elements.
pub(super) trait Measure<'a, 'd, 't> {
    /// The builder, for findings.
    fn base(&mut self) -> &mut XmlBuilder<'a, 'd, 't>;

    /// The box of the shapes of an element, in its user space; `None` where it is not known.
    fn bounding_box(
        &mut self,
        node: Node<'d, 't>,
        cascade: &Cascade<'d>,
        context: &ElementContext<'_>,
    ) -> Result<Option<Bounds<f64>>, ReadError>;

    /// The transform of an element about its origin, which does not apply to `context` yet. Reports
    /// a finding, and applies no transform, if it is malformed.
    fn transform(
        &mut self,
        node: Node<'d, 't>,
        cascade: &Cascade<'d>,
        context: &ElementContext<'_>,
    ) -> Result<Affine, ReadError> {
        let css = cascade.value(Property::Transform);
        let attribute = node.attribute("transform");
        let origin = cascade.value(Property::TransformOrigin);
        // In the order in which they apply.
        let singles = [Property::Scale, Property::Rotate, Property::Translate];
        let singles = singles.map(|property| Some((property, cascade.value(property)?)));
        let is_moved = singles.iter().any(Option::is_some);
        if css.is_none() && attribute.is_none() && !is_moved {
            return Ok(Affine::IDENTITY);
        }
        let reference = self.reference_box(node, cascade, context)?;
        let size = reference.size();
        let viewport = context.viewport.resized(size.x, size.y);
        let css = css.and_then(|text| css_transform(text, viewport));
        let written = css.is_none().then_some(attribute).flatten();
        let transform = css.or_else(|| written.map_or(Some(Affine::IDENTITY), attribute_transform));
        let Some(transform) = transform else {
            let message = || "its `transform` is malformed".to_owned();
            let remedy = "It is drawn without the `transform`; correct it";
            let base = self.base();
            base.report(Code::WrongType, node, message, remedy);
            return Ok(Affine::IDENTITY);
        };
        let singles = singles.into_iter().flatten();
        let singles = singles.filter_map(|(of, text)| single_transform(of, text, viewport));
        let transform = singles.fold(transform, Affine::then);
        let origin = origin.and_then(|text| transform_origin(text, viewport));
        Ok(about(transform, reference.min + origin.unwrap_or_default()))
    }

    /// The box that the origin and percentages of a transform refer to.
    fn reference_box(
        &mut self,
        node: Node<'d, 't>,
        cascade: &Cascade<'d>,
        context: &ElementContext<'_>,
    ) -> Result<Bounds<f64>, ReadError> {
        let Viewport { width, height, .. } = context.viewport;
        let of_view = Bounds {
            min: Point::default(),
            max: Point::new(width, height),
        };
        let name = cascade.value(Property::TransformBox).unwrap_or("view-box");
        let measured = match name {
            "view-box" => return Ok(of_view),
            "fill-box" | "content-box" => self.bounding_box(node, cascade, context)?,
            _ => None,
        };
        if measured.is_none() {
            let message = || format!("`transform-box: {name}` is not supported here");
            let remedy = "It is drawn with the origin of `view-box`; apply its transform in the \
                          drawing program";
            let base = self.base();
            base.report(Code::UnknownValue, node, message, remedy);
        }
        Ok(measured.unwrap_or(of_view))
    }
}
