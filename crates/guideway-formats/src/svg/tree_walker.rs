//! Walks the element tree: follows groups, `use` references and nested viewports, hands down
//! transform, viewport and style, and passes each shape to the mapper.

use std::collections::HashMap;

use guideway_layout::{Code, Layout};
use guideway_spline::{Affine, Point};
use roxmltree::Node;
use svgtypes::ViewBox;

use super::context::ElementContext;
use super::element_counts::{element_counts, report_ignored};
use super::shape_mapper::ShapeMapper;
use super::shapes::SHAPES;
use super::style::Style;
use super::style_sheet::StyleSheet;
use super::viewport::{
    METERS_PER_PX, Viewport, is_physical, transform, view_box, view_box_transform,
};
use crate::ReadError;
use crate::source::Source;
use crate::xml::Xml;

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Page size without `width`, `height` and `viewBox`, in pixels: the default of browsers.
const DEFAULT_PAGE: Viewport = Viewport {
    width: 300.0,
    height: 150.0,
};

/// Bytes of elements that references may repeat in any file. Without a bound, nested `use` elements
/// in a file of a kilobyte expand to billions of shapes.
const BASE_REPEATED_BYTES: u64 = 16 << 20;

/// Further bytes of elements that references may repeat, per byte of the file.
const REPEATED_PER_BYTE: u64 = 16;

/// Cost of repeating any element, in bytes, so that empty groups are not free.
const ELEMENT_COST: u64 = 64;

/// Walks a document.
pub(super) struct TreeWalker<'a, 'd, 't> {
    mapper: ShapeMapper<'a, 'd, 't>,
    sheet: &'d StyleSheet<'d>,
    /// The first element per `id`.
    ids: HashMap<&'d str, Node<'d, 't>>,
    /// Remaining budget of bytes that references may repeat.
    repeated_left: u64,
    /// Whether the finding about the exhausted budget was recorded.
    is_exhaustion_reported: bool,
}

impl<'a, 'd, 't> TreeWalker<'a, 'd, 't> {
    pub(super) fn new(
        source: Source<'a>,
        xml: &'d Xml<'t>,
        sheet: &'d StyleSheet<'d>,
        file_bytes: usize,
    ) -> Self {
        Self {
            mapper: ShapeMapper::new(source, xml, file_bytes),
            sheet,
            ids: HashMap::new(),
            repeated_left: BASE_REPEATED_BYTES + file_bytes as u64 * REPEATED_PER_BYTE,
            is_exhaustion_reported: false,
        }
    }

    /// Walks all elements and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(mut self, root: Node<'d, 't>) -> Result<Layout, ReadError> {
        for node in root.descendants() {
            if let Some(id) = node.attribute("id") {
                self.ids.entry(id).or_insert(node);
            }
        }
        let context = self.root_context(root);
        for child in root.children() {
            self.element(child, &context)?;
        }
        Ok(self.finish(root))
    }

    /// The context of the children of the root.
    fn root_context(&mut self, root: Node<'d, 't>) -> ElementContext<'static> {
        let view = self.view_box(root);
        let [width, height] = self.page_size(root);
        let viewport = match view {
            Some(view) => Viewport::new(view.w, view.h),
            None => Viewport::new(
                width.unwrap_or(DEFAULT_PAGE.width),
                height.unwrap_or(DEFAULT_PAGE.height),
            ),
        };
        let pixel_from_user = match (view, width, height) {
            (Some(view), None, None) => view_box_transform(root, view, view.w, view.h),
            (Some(view), width, height) => {
                let ratio = view.h / view.w;
                let width = width.or(height.map(|h| h / ratio)).unwrap_or(view.w);
                view_box_transform(root, view, width, height.unwrap_or(width * ratio))
            }
            (None, ..) => Affine::IDENTITY,
        };
        // Applies the scale only: the layout keeps the origin of the drawing, not of the page.
        let meters_from_user = Affine {
            x: pixel_from_user.x * METERS_PER_PX,
            y: pixel_from_user.y * -METERS_PER_PX,
            origin: Point::new(0.0, 0.0),
        };
        ElementContext {
            meters_from_user,
            viewport,
            style: Style::INITIAL.of_child(root, self.sheet, viewport),
            group: None,
            id_prefix: "",
            depth: 0,
        }
    }

    /// The page size in pixels. Reports a finding if the size has no physical unit.
    fn page_size(&mut self, root: Node<'d, 't>) -> [Option<f64>; 2] {
        let attributes = ["width", "height"].map(|name| root.attribute(name));
        // Percentages refer to the window of a browser, so they give no size.
        let size = attributes.map(|text| {
            let pixels = DEFAULT_PAGE.length(text?, |_| f64::NAN)?;
            (pixels > 0.0).then_some(pixels)
        });
        if !attributes.iter().flatten().any(|text| is_physical(text)) {
            let message = || {
                "the page has no width or height in mm, cm or in; a pixel is read as 1/96 inch \
                 (CSS)"
                    .to_owned()
            };
            let remedy = "If that is wrong, give the page its size, such as width=\"210mm\"";
            self.mapper
                .base
                .report(Code::AssumedUnit, root, message, remedy);
        }
        size
    }

    /// Sets styles, counts and provenance of the layout, and reports ignored elements.
    fn finish(self, root: Node<'d, 't>) -> Layout {
        let ShapeMapper {
            base,
            colors,
            widths_m,
            clipped,
        } = self.mapper;
        let mut builder = base.builder;
        report_ignored(&mut builder, root, clipped, self.sheet.ignored_selectors);
        let mut layout = builder.layout;
        crate::Format::Svg
            .name()
            .clone_into(&mut layout.provenance.format);
        let version = root.attribute("version").unwrap_or_default();
        layout.provenance.format_version = version.chars().take(16).collect();
        layout.provenance.counts = element_counts(root);
        if !colors.is_empty() {
            layout.paths.set_color_rgba(colors);
            layout.paths.set_width_m(widths_m);
        }
        layout
    }

    fn element(
        &mut self,
        node: Node<'d, 't>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        if !node.is_element() || self.is_foreign(node) {
            return Ok(());
        }
        let tag = node.tag_name().name();
        let is_shape = SHAPES.contains(&tag);
        if !is_shape && !["svg", "g", "a", "switch", "use"].contains(&tag) {
            return Ok(());
        }
        let limits = &self.mapper.base.builder.source.options.limits;
        if context.depth > limits.depth {
            let depth = limits.depth;
            let message = || format!("references nest more than {depth} levels deep");
            let remedy = "It is left out; remove references to elements that contain them";
            self.mapper
                .base
                .report(Code::Implausible, node, message, remedy);
            return Ok(());
        }
        if !context.id_prefix.is_empty() && !self.charge_repeat(node, is_shape) {
            return Ok(());
        }
        let Some(own) = transform(node) else {
            let detail = "its `transform` is malformed";
            let remedy = "It is left out with all its children; correct the `transform`";
            let code = Code::WrongType;
            if is_shape {
                return self.mapper.refuse(node, context, code, detail, remedy);
            }
            let base = &mut self.mapper.base;
            base.report(code, node, || detail.to_owned(), remedy);
            return Ok(());
        };
        let inner = ElementContext {
            meters_from_user: own.then(context.meters_from_user),
            style: context.style.of_child(node, self.sheet, context.viewport),
            depth: context.depth + 1,
            ..*context
        };
        match tag {
            "g" | "a" => {
                let label = node.attribute((INKSCAPE, "label")).or(node.attribute("id"));
                let group = label.or(context.group);
                self.children(node, &ElementContext { group, ..inner })
            }
            "switch" => {
                let mut choices = node.children().filter(Node::is_element);
                let choice = choices.find(|c| !c.has_attribute("requiredExtensions"));
                choice.map_or(Ok(()), |choice| self.element(choice, &inner))
            }
            "svg" => self.nested_viewport(node, [None, None], &inner),
            "use" => self.reference(node, &inner),
            _ => self.mapper.map_shape(node, &inner),
        }
    }

    /// The `viewBox` of an element. Reports a finding if it is malformed.
    fn view_box(&mut self, node: Node<'d, 't>) -> Option<ViewBox> {
        let text = node.attribute("viewBox")?;
        let found = view_box(text);
        if found.is_none() {
            let message = || format!("the `viewBox` is \"{text}\", expected four numbers");
            let remedy = "The `viewBox` is ignored; correct it";
            self.mapper
                .base
                .report(Code::WrongType, node, message, remedy);
        }
        found
    }

    fn children(
        &mut self,
        node: Node<'d, 't>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        for child in node.children() {
            self.element(child, context)?;
        }
        Ok(())
    }

    /// Charges the budget for one more repetition of an element; false if it is exhausted, with a
    /// finding the first time.
    fn charge_repeat(&mut self, node: Node<'d, 't>, is_shape: bool) -> bool {
        let shape_bytes = match is_shape {
            true => node.range().len() as u64,
            false => 0,
        };
        let left = self.repeated_left.checked_sub(ELEMENT_COST + shape_bytes);
        if left.is_none() && !self.is_exhaustion_reported {
            self.is_exhaustion_reported = true;
            let message = || "references repeat too much for a file of this size".to_owned();
            let remedy = "It and all later repetitions are left out; use fewer references";
            self.mapper
                .base
                .report(Code::Implausible, node, message, remedy);
        }
        self.repeated_left = left.unwrap_or(0);
        left.is_some()
    }

    /// Walks a nested `svg` or a `symbol`, whose reference may override its size.
    fn nested_viewport(
        &mut self,
        node: Node<'d, 't>,
        size: [Option<f64>; 2],
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        let outer = context.viewport;
        let corner = match node.tag_name().name() {
            "symbol" => Point::new(0.0, 0.0),
            _ => corner(node, outer),
        };
        let width = size[0].or_else(|| outer.attribute(node, "width", Viewport::width));
        let height = size[1].or_else(|| outer.attribute(node, "height", Viewport::height));
        let (width, height) = (width.unwrap_or(outer.width), height.unwrap_or(outer.height));
        let (transform, viewport) = match self.view_box(node) {
            Some(view) => (
                view_box_transform(node, view, width, height),
                Viewport::new(view.w, view.h),
            ),
            None => (Affine::IDENTITY, Viewport::new(width, height)),
        };
        let transform = transform.then(Affine::translation(corner));
        self.children(
            node,
            &ElementContext {
                meters_from_user: transform.then(context.meters_from_user),
                viewport,
                ..*context
            },
        )
    }

    /// Walks the target of a `use` element.
    fn reference(
        &mut self,
        node: Node<'d, 't>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        let href = node.attribute("href").or(node.attribute((XLINK, "href")));
        let target = href.and_then(|href| self.ids.get(href.trim().strip_prefix('#')?).copied());
        let Some(target) = target else {
            let message = || match href {
                Some(href) => format!("its target `{href}` is not in this file"),
                None => "it has no `href`".to_owned(),
            };
            let remedy = "It is left out; refer to the `id` of an element of this file";
            self.mapper
                .base
                .report(Code::UnknownValue, node, message, remedy);
            return Ok(());
        };
        let viewport = context.viewport;
        let offset = corner(node, viewport);
        let id_prefix = format!("{}{}/", context.id_prefix, self.mapper.element_id(node));
        self.mapper.base.builder.check_text(&id_prefix)?;
        self.repeated_left = self.repeated_left.saturating_sub(id_prefix.len() as u64);
        let inner = ElementContext {
            meters_from_user: Affine::translation(offset).then(context.meters_from_user),
            id_prefix: &id_prefix,
            ..*context
        };
        let size = [
            viewport.attribute(node, "width", Viewport::width),
            viewport.attribute(node, "height", Viewport::height),
        ];
        match target.tag_name().name() {
            "symbol" | "svg" => {
                let inner = ElementContext {
                    style: inner.style.of_child(target, self.sheet, viewport),
                    depth: inner.depth + 1,
                    ..inner
                };
                let max_depth = self.mapper.base.builder.source.options.limits.depth;
                if inner.depth > max_depth || !self.charge_repeat(target, false) {
                    return Ok(());
                }
                self.nested_viewport(target, size, &inner)
            }
            _ => self.element(target, &inner),
        }
    }

    /// Whether an element has another namespace than the drawing.
    fn is_foreign(&self, node: Node<'d, 't>) -> bool {
        node.tag_name().namespace() != self.mapper.base.xml.root().tag_name().namespace()
    }
}

/// The position in the attributes `x` and `y`.
fn corner(node: Node<'_, '_>, viewport: Viewport) -> Point<f64> {
    let x = viewport.attribute(node, "x", Viewport::width);
    let y = viewport.attribute(node, "y", Viewport::height);
    Point::new(x.unwrap_or(0.0), y.unwrap_or(0.0))
}
