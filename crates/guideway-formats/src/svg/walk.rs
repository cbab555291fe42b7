//! From elements to paths: groups, references and pages within pages are followed, and styles handed down.

use std::collections::HashMap;

use guideway_layout::{Code, Layout};
use guideway_spline::{Affine, Point};
use roxmltree::Node;
use svgtypes::ViewBox;

use super::css::Sheet;
use super::page::{PIXEL_M, Viewport, fit, is_physical, transform, view_box};
use super::shapes::SHAPES;
use super::style::Style;
use crate::ReadError;
use crate::builder::Builder;
use crate::source::Source;
use crate::xml::Xml;

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// What a page has in pixels where nothing says: the size that browsers take.
const DEFAULT_PAGE: Viewport = Viewport {
    width: 300.0,
    height: 150.0,
};

/// So many bytes of elements may references repeat, beside some for each byte of the file.
const LEAST_REPEATED: u64 = 16 << 20;
const REPEATED_A_BYTE: u64 = 16;

/// What an element takes from those around it.
#[derive(Clone, Copy)]
pub(super) struct Around<'p> {
    pub(super) meters_from_user: Affine,
    pub(super) viewport: Viewport,
    pub(super) style: Style,
    /// The label or identifier of the group that it is in.
    pub(super) group: Option<&'p str>,
    /// The identifiers of the references that repeat it, each with a slash after it.
    pub(super) references: &'p str,
    depth: usize,
}

/// Makes the paths of a drawing.
pub(super) struct Walker<'a, 'd, 't> {
    pub(super) builder: Builder<'a>,
    xml: &'d Xml<'t>,
    pub(super) sheet: &'d Sheet<'d>,
    ids: HashMap<&'d str, Node<'d, 't>>,
    pub(super) colors: Vec<u32>,
    pub(super) widths_m: Vec<f32>,
    repeated_left: u64,
    /// Whether that was said.
    is_spent: bool,
    /// How many paths should be cut by a clip path or a mask.
    pub(super) clipped: u64,
}

impl<'a, 'd, 't> Walker<'a, 'd, 't> {
    pub(super) fn new(
        source: Source<'a>,
        xml: &'d Xml<'t>,
        sheet: &'d Sheet<'d>,
        file_bytes: usize,
    ) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            xml,
            sheet,
            ids: HashMap::new(),
            colors: Vec::new(),
            widths_m: Vec::new(),
            repeated_left: LEAST_REPEATED + file_bytes as u64 * REPEATED_A_BYTE,
            is_spent: false,
            clipped: 0,
        }
    }

    pub(super) fn map(mut self, root: Node<'d, 't>) -> Result<Layout, ReadError> {
        for node in root.descendants() {
            if let Some(id) = node.attribute("id") {
                self.ids.entry(id).or_insert(node);
            }
        }
        let view = self.view_box(root);
        let [width, height] = self.size(root);
        let viewport = match view {
            Some(view) => Viewport::new(view.w, view.h),
            None => Viewport::new(
                width.unwrap_or(DEFAULT_PAGE.width),
                height.unwrap_or(DEFAULT_PAGE.height),
            ),
        };
        // Only how large a unit is: the origin stays that of the drawing, wherever the page begins.
        let pixel_from_user = match (view, width, height) {
            (Some(view), None, None) => fit(root, view, view.w, view.h),
            (Some(view), width, height) => {
                let ratio = view.h / view.w;
                let width = width.or(height.map(|h| h / ratio)).unwrap_or(view.w);
                fit(root, view, width, height.unwrap_or(width * ratio))
            }
            (None, ..) => Affine::IDENTITY,
        };
        let meters_from_user = Affine {
            x: pixel_from_user.x * PIXEL_M,
            y: pixel_from_user.y * -PIXEL_M,
            origin: Point::new(0.0, 0.0),
        };
        let around = Around {
            meters_from_user,
            viewport,
            style: Style::INITIAL.of(root, self.sheet, viewport),
            group: None,
            references: "",
            depth: 0,
        };
        for child in root.children() {
            self.element(child, &around)?;
        }
        Ok(self.finish(root))
    }

    /// The size of the page in pixels. Says so if it has none on paper.
    fn size(&mut self, root: Node<'d, 't>) -> [Option<f64>; 2] {
        let attributes = ["width", "height"].map(|name| root.attribute(name));
        let whole: [fn(Viewport) -> f64; 2] = [|_| f64::NAN, |_| f64::NAN];
        let size = [0, 1].map(|i| {
            let pixels = DEFAULT_PAGE.length(attributes[i]?, whole[i])?;
            (pixels > 0.0).then_some(pixels)
        });
        if !attributes.iter().flatten().any(|text| is_physical(text)) {
            let message = || {
                "the page has no width or height in mm, cm or in: a pixel is read as 1/96 inch, as CSS has it"
                    .to_owned()
            };
            let remedy = "If that is wrong, give the page its size, such as width=\"210mm\"";
            self.report(Code::AssumedUnit, root, message, remedy);
        }
        size
    }

    fn element(&mut self, node: Node<'d, 't>, around: &Around<'_>) -> Result<(), ReadError> {
        if !node.is_element() || self.is_foreign(node) {
            return Ok(());
        }
        let tag = node.tag_name().name();
        let is_shape = SHAPES.contains(&tag);
        if !is_shape && !["svg", "g", "a", "switch", "use"].contains(&tag) {
            return Ok(());
        }
        let limits = &self.builder.source.options.limits;
        if around.depth > limits.depth {
            let message = || {
                format!(
                    "nested more than {} levels deep by references",
                    limits.depth
                )
            };
            let remedy = "It is left out; a reference to what it is within has no end";
            self.report(Code::Implausible, node, message, remedy);
            return Ok(());
        }
        if !around.references.is_empty() && !self.pay(node, is_shape) {
            return Ok(());
        }
        let Some(own) = transform(node) else {
            let message = || "the `transform` is wrong".to_owned();
            self.report(
                Code::WrongType,
                node,
                message,
                "It is left out with all that is in it",
            );
            return match is_shape {
                true => self.refuse(node, around, Code::WrongType, "its `transform` is wrong"),
                false => Ok(()),
            };
        };
        let inner = Around {
            meters_from_user: own.then(around.meters_from_user),
            style: around.style.of(node, self.sheet, around.viewport),
            depth: around.depth + 1,
            ..*around
        };
        match tag {
            "g" | "a" => {
                let label = node.attribute((INKSCAPE, "label")).or(node.attribute("id"));
                let group = label.or(around.group);
                self.children(node, &Around { group, ..inner })
            }
            "switch" => {
                let mut choices = node.children().filter(Node::is_element);
                let choice = choices.find(|c| !c.has_attribute("requiredExtensions"));
                choice.map_or(Ok(()), |choice| self.element(choice, &inner))
            }
            "svg" => self.page(node, [None, None], &inner),
            "use" => self.reference(node, &inner),
            _ => self.shape(node, &inner),
        }
    }

    /// The `viewBox` of an element. Says so if it is none.
    fn view_box(&mut self, node: Node<'d, 't>) -> Option<ViewBox> {
        let text = node.attribute("viewBox")?;
        let found = view_box(text);
        if found.is_none() {
            let message = || format!("the `viewBox` is \"{text}\", four numbers were expected");
            let remedy = "It is read as if there were none; correct it";
            self.report(Code::WrongType, node, message, remedy);
        }
        found
    }

    fn children(&mut self, node: Node<'d, 't>, around: &Around<'_>) -> Result<(), ReadError> {
        for child in node.children() {
            self.element(child, around)?;
        }
        Ok(())
    }

    /// Whether an element may be repeated once more.
    fn pay(&mut self, node: Node<'d, 't>, is_shape: bool) -> bool {
        const GROUP: u64 = 64;
        let cost = if is_shape {
            node.range().len() as u64
        } else {
            0
        };
        let left = self.repeated_left.checked_sub(GROUP + cost);
        if left.is_none() && !self.is_spent {
            self.is_spent = true;
            let message = || "references repeat more than a file of this size may".to_owned();
            let remedy =
                "It is left out, and what references would repeat after it; draw less by reference";
            self.report(Code::Implausible, node, message, remedy);
        }
        self.repeated_left = left.unwrap_or(0);
        left.is_some()
    }

    /// A page within the page, or a symbol, whose reference may give it another size.
    fn page(
        &mut self,
        node: Node<'d, 't>,
        size: [Option<f64>; 2],
        around: &Around<'_>,
    ) -> Result<(), ReadError> {
        let outer = around.viewport;
        let across: fn(Viewport) -> f64 = Viewport::width;
        let down: fn(Viewport) -> f64 = Viewport::height;
        let is_symbol = node.tag_name().name() == "symbol";
        let place = |name, whole| match is_symbol {
            true => 0.0,
            false => outer.attribute(node, name, whole).unwrap_or(0.0),
        };
        let corner = Point::new(place("x", across), place("y", down));
        let width = size[0].or_else(|| outer.attribute(node, "width", across));
        let height = size[1].or_else(|| outer.attribute(node, "height", down));
        let (width, height) = (width.unwrap_or(outer.width), height.unwrap_or(outer.height));
        let (map, viewport) = match self.view_box(node) {
            Some(view) => (
                fit(node, view, width, height),
                Viewport::new(view.w, view.h),
            ),
            None => (Affine::IDENTITY, Viewport::new(width, height)),
        };
        let map = map.then(Affine::translation(corner));
        self.children(
            node,
            &Around {
                meters_from_user: map.then(around.meters_from_user),
                viewport,
                ..*around
            },
        )
    }

    fn reference(&mut self, node: Node<'d, 't>, around: &Around<'_>) -> Result<(), ReadError> {
        let href = node.attribute("href").or(node.attribute((XLINK, "href")));
        let target = href.and_then(|href| self.ids.get(href.trim().strip_prefix('#')?).copied());
        let Some(target) = target else {
            let message = || match href {
                Some(href) => format!("`{href}` is nothing in this file"),
                None => "it names nothing".to_owned(),
            };
            let remedy = "It is left out; what it refers to must be in the file";
            self.report(Code::UnknownValue, node, message, remedy);
            return Ok(());
        };
        let viewport = around.viewport;
        let across: fn(Viewport) -> f64 = Viewport::width;
        let down: fn(Viewport) -> f64 = Viewport::height;
        let length = |name, whole| viewport.attribute(node, name, whole);
        let offset = Point::new(
            length("x", across).unwrap_or(0.0),
            length("y", down).unwrap_or(0.0),
        );
        let references = format!("{}{}/", around.references, self.name(node));
        self.builder.check_text(&references)?;
        self.repeated_left = self.repeated_left.saturating_sub(references.len() as u64);
        let inner = Around {
            meters_from_user: Affine::translation(offset).then(around.meters_from_user),
            references: &references,
            ..*around
        };
        let size = [length("width", across), length("height", down)];
        match target.tag_name().name() {
            "symbol" | "svg" => {
                let style = inner.style.of(target, self.sheet, viewport);
                let depth = inner.depth + 1;
                let inner = Around {
                    style,
                    depth,
                    ..inner
                };
                if inner.depth > self.builder.source.options.limits.depth
                    || !self.pay(target, false)
                {
                    return Ok(());
                }
                self.page(target, size, &inner)
            }
            _ => self.element(target, &inner),
        }
    }

    /// The identifier of an element; where it has none, its line.
    pub(super) fn name(&self, node: Node<'d, 't>) -> String {
        match node.attribute("id") {
            Some(id) if !id.is_empty() => id.to_owned(),
            _ => format!("line {}", self.xml.line(node)),
        }
    }

    /// Records a finding at an element.
    pub(super) fn report(
        &mut self,
        code: Code,
        node: Node<'d, 't>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let xml = self.xml;
        self.builder
            .report(code, &|| xml.place(node), message, remedy);
    }

    /// Whether an element is of another language than the drawing.
    fn is_foreign(&self, node: Node<'d, 't>) -> bool {
        node.tag_name().namespace() != self.xml.root().tag_name().namespace()
    }
}
