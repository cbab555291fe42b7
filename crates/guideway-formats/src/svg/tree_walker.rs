//! Walks the element tree: follows groups, `use` references and nested viewports, hands down
//! transform, viewport and style, and passes each shape to the mapper.

use std::collections::HashMap;

use guideway_layout::{Code, Layout};
use guideway_spline::{Affine, Bounds, Point};
use roxmltree::{Node, NodeId};
use svgtypes::ViewBox;

use super::cascade::Cascade;
use super::conditions::{choice, is_met};
use super::context::ElementContext;
use super::element_transform::Measure;
use super::page::{DEFAULT_PAGE_PX, page_size};
use super::repeat_budget::RepeatBudget;
use super::shape_mapper::ShapeMapper;
use super::shapes::SHAPES;
use super::style::{PAINT_SERVERS, PaintServers, Style};
use super::style_sheet::StyleSheet;
use super::viewport::{METERS_PER_PX, Viewport, corner, view_box, view_box_transform};
use crate::ReadError;
use crate::source::Source;
use crate::text::{percent_decoded, printable};
use crate::xml::Xml;
use crate::xml_builder::XmlBuilder;

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Walks a document.
pub(super) struct TreeWalker<'a, 'd, 't> {
    mapper: ShapeMapper<'a, 'd, 't>,
    sheet: &'d StyleSheet<'d>,
    /// The first element per `id`.
    ids: HashMap<&'d str, Node<'d, 't>>,
    paint_servers: PaintServers<'d>,
    /// Targets of the references around the current element.
    targets: Vec<NodeId>,
    budget: RepeatBudget,
    /// Measured elements: the viewport, and the box of their shapes in their user space.
    boxes: HashMap<NodeId, (Viewport, Option<Bounds<f64>>)>,
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
            paint_servers: PaintServers::new(),
            targets: Vec::new(),
            budget: RepeatBudget::new(file_bytes),
            boxes: HashMap::new(),
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
        let is_server = |node: &Node<'_, '_>| PAINT_SERVERS.contains(&node.tag_name().name());
        let servers = self.ids.iter().filter(|(_, node)| is_server(node));
        self.paint_servers = servers.map(|(&id, _)| id).collect();
        let context = self.root_context(root);
        for child in root.children() {
            self.element(child, &context)?;
        }
        self.mapper.base.refuse_includes()?;
        Ok(self.mapper.finish(root, self.sheet))
    }

    /// The context of the children of the root.
    fn root_context(&mut self, root: Node<'d, 't>) -> ElementContext<'static> {
        let view = self.view_box(root);
        let [width, height] = page_size(&mut self.mapper.base, root);
        let viewport = match view {
            Some(view) => Viewport::new(view.w, view.h),
            None => Viewport::new(
                width.unwrap_or(DEFAULT_PAGE_PX[0]),
                height.unwrap_or(DEFAULT_PAGE_PX[1]),
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
        let style =
            Style::INITIAL.of_child(&self.sheet.cascade(root), viewport, &self.paint_servers);
        let mut viewport = viewport.with_font_size(style.font_size);
        viewport.fonts.root = style.font_size;
        ElementContext {
            meters_from_user,
            viewport,
            style,
            group: None,
            id_prefix: "",
            depth: 0,
        }
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
        if !context.id_prefix.is_empty() && !self.charge(node, context) {
            return Ok(());
        }
        let cascade = self.sheet.cascade(node);
        if let Some((property, value)) = cascade.unread() {
            self.mapper.report_unread(node, property.name(), value);
        }
        let mut style = context
            .style
            .of_child(&cascade, context.viewport, &self.paint_servers);
        style.is_displayed &= is_met(node);
        let viewport = context.viewport.with_font_size(style.font_size);
        let mut inner = ElementContext {
            viewport,
            style,
            depth: context.depth + 1,
            ..*context
        };
        let transform = self.transform(node, &cascade, &inner)?;
        inner.meters_from_user = transform.then(context.meters_from_user);
        self.content(node, &cascade, &inner)
    }

    /// Walks what an element shows, in its user space.
    fn content(
        &mut self,
        node: Node<'d, 't>,
        cascade: &Cascade<'d>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        match node.tag_name().name() {
            "g" | "a" => {
                let label = node.attribute((INKSCAPE, "label")).or(node.attribute("id"));
                let group = label.or(context.group);
                self.children(node, &ElementContext { group, ..*context })
            }
            "switch" => choice(node).map_or(Ok(()), |choice| self.element(choice, context)),
            "svg" => self.nested_viewport(node, [None, None], context),
            "use" => self.reference(node, context),
            _ => self.mapper.map_shape(node, cascade, context),
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

    /// Charges the budget for one more repetition of an element. Returns `false` if it is
    /// exhausted.
    fn charge(&mut self, node: Node<'d, 't>, context: &ElementContext<'_>) -> bool {
        self.budget
            .charge(&mut self.mapper.base, node, context.id_prefix)
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
                outer.resized(view.w, view.h),
            ),
            None => (Affine::IDENTITY, outer.resized(width, height)),
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

    /// Follows the reference of a `use` element.
    fn reference(
        &mut self,
        node: Node<'d, 't>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        let href = node.attribute("href").or(node.attribute((XLINK, "href")));
        let target = href.and_then(|href| self.element_named(href.trim().strip_prefix('#')?));
        let Some(target) = target else {
            let detail = match href {
                Some(href) => format!("its target `{}` is not in this file", printable(href)),
                None => "it has no `href`".to_owned(),
            };
            let remedy = "It is left out; refer to the `id` of an element of this file";
            let mapper = &mut self.mapper;
            return mapper.refuse(node, context, Code::UnknownValue, &detail, remedy);
        };
        let is_around = node.ancestors().any(|around| around == target);
        if is_around || self.targets.contains(&target.id()) {
            let detail = "it refers to an element that contains it";
            let remedy = "It is left out: it would have no end; refer to another element";
            let mapper = &mut self.mapper;
            return mapper.refuse(node, context, Code::UnknownValue, detail, remedy);
        }
        self.targets.push(target.id());
        let result = self.target(node, target, context);
        self.targets.pop();
        result
    }

    /// The element of an identifier, which a reference may state with `%` and the bytes of its
    /// characters.
    fn element_named(&self, fragment: &str) -> Option<Node<'d, 't>> {
        let found = self.ids.get(fragment).copied();
        found.or_else(|| self.ids.get(percent_decoded(fragment)?.as_str()).copied())
    }

    /// Walks the target of a `use` element.
    fn target(
        &mut self,
        node: Node<'d, 't>,
        target: Node<'d, 't>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        let viewport = context.viewport;
        let offset = corner(node, viewport);
        let id_prefix = format!("{}{}/", context.id_prefix, self.mapper.element_id(node));
        self.mapper.base.builder.check_text(&id_prefix)?;
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
                let max_depth = self.mapper.base.builder.source.options.limits.depth;
                if inner.depth >= max_depth || !self.charge(target, &inner) {
                    return Ok(());
                }
                let cascade = self.sheet.cascade(target);
                let style = inner
                    .style
                    .of_child(&cascade, viewport, &self.paint_servers);
                let mut inner = ElementContext {
                    viewport: viewport.with_font_size(style.font_size),
                    style,
                    depth: inner.depth + 1,
                    ..inner
                };
                let transform = self.transform(target, &cascade, &inner)?;
                inner.meters_from_user = transform.then(inner.meters_from_user);
                self.nested_viewport(target, size, &inner)
            }
            _ => self.element(target, &inner),
        }
    }

    /// Tells if an element has another namespace than the drawing.
    fn is_foreign(&self, node: Node<'d, 't>) -> bool {
        node.tag_name().namespace() != self.mapper.base.xml.root().tag_name().namespace()
    }
}

impl<'a, 'd, 't> Measure<'a, 'd, 't> for TreeWalker<'a, 'd, 't> {
    fn base(&mut self) -> &mut XmlBuilder<'a, 'd, 't> {
        &mut self.mapper.base
    }

    /// The box of the shapes of an element, in its user space; `None` if it is a symbol, or takes
    /// more work than the file may.
    fn bounding_box(
        &mut self,
        node: Node<'d, 't>,
        cascade: &Cascade<'d>,
        context: &ElementContext<'_>,
    ) -> Result<Option<Bounds<f64>>, ReadError> {
        if node.tag_name().name() == "symbol" {
            return Ok(None);
        }
        // The box of a group needs that of groups in it, as each of these does for itself.
        if let Some((viewport, known)) = self.boxes.get(&node.id())
            && *viewport == context.viewport
        {
            return Ok(*known);
        }
        let around = self.mapper.measured.replace(None);
        let was_silent = std::mem::replace(&mut self.mapper.base.is_silent, true);
        let content = ElementContext {
            meters_from_user: Affine::IDENTITY,
            // Everything in it is walked once more, and pays for that as repetitions do.
            id_prefix: "/",
            depth: context.depth + 1,
            ..*context
        };
        let walked = self.content(node, cascade, &content);
        self.mapper.base.is_silent = was_silent;
        let measured = std::mem::replace(&mut self.mapper.measured, around);
        walked?;
        // Without shapes nothing is drawn, whatever its box.
        let nothing = Bounds {
            min: Point::default(),
            max: Point::default(),
        };
        let measured = measured.flatten().unwrap_or(nothing);
        let measured = (!self.budget.is_exhausted()).then_some(measured);
        self.boxes.insert(node.id(), (context.viewport, measured));
        Ok(measured)
    }
}
