//! Maps shapes to the paths of a layout, with color, width and group.

use std::collections::HashMap;

use guideway_layout::{Code, Direction, Layout, NewPath, Value};
use guideway_spline::{Affine, Bounds};
use roxmltree::{Node, NodeId};

use super::cascade::Cascade;
use super::context::ElementContext;
use super::element_counts::{element_counts, report_ignored};
use super::path_builder::PathBuilder;
use super::shapes::{append_shape, unread_length};
use super::style_sheet::StyleSheet;
use super::viewport::METERS_PER_PX;
use crate::ReadError;
use crate::builder::Table;
use crate::source::Source;
use crate::xml::Xml;
use crate::xml_builder::XmlBuilder;

/// Collects paths and their styles.
pub(super) struct ShapeMapper<'a, 'd, 't> {
    pub(super) base: XmlBuilder<'a, 'd, 't>,
    /// Color per path, 0xRRGGBBAA.
    pub(super) colors: Vec<u32>,
    /// Width per path; NaN for the width of the view.
    pub(super) widths_m: Vec<f32>,
    /// Number of paths with a clip path or a mask.
    pub(super) clipped: u64,
    /// The box of the shapes so far, while an element is measured; then nothing else is collected.
    pub(super) measured: Option<Option<Bounds<f64>>>,
    names: LineNames,
}

/// Tells the elements of one line apart that have no identifier.
#[derive(Default)]
struct LineNames {
    numbers: HashMap<NodeId, u32>,
    /// Number of named elements per line.
    counts: HashMap<u32, u32>,
}

impl LineNames {
    /// The number of an element among those of its line, from 1.
    fn number(&mut self, node: NodeId, line: u32) -> u32 {
        let counts = &mut self.counts;
        *self.numbers.entry(node).or_insert_with(|| {
            let count = counts.entry(line).or_default();
            *count += 1;
            *count
        })
    }
}

impl<'a, 'd, 't> ShapeMapper<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            base: XmlBuilder::new(source, xml, file_bytes),
            colors: Vec::new(),
            widths_m: Vec::new(),
            clipped: 0,
            measured: None,
            names: LineNames::default(),
        }
    }

    /// Appends the path of a shape, or records the shape as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn map_shape(
        &mut self,
        node: Node<'d, 't>,
        cascade: &Cascade<'d>,
        context: &ElementContext<'_>,
    ) -> Result<(), ReadError> {
        let style = context.style;
        if self.measured.is_some() {
            self.measure(node, cascade, context);
            return Ok(());
        }
        let painted = match (style.is_displayed, style.is_visible, style.color_rgba()) {
            (false, ..) => Err("it is not displayed"),
            (_, false, _) => Err("it is not visible"),
            (.., None) => Err("it has neither a visible stroke nor a visible fill"),
            (.., Some(color)) => Ok(color),
        };
        let color = match painted {
            Ok(color) => color,
            Err(detail) => {
                let remedy = "Nothing to do if it is meant to be hidden";
                return self.refuse(node, context, Code::NotDrawn, detail, remedy);
            }
        };
        let mut path = self.path_builder(context);
        let error = append_shape(node, cascade, context.viewport, &mut path).err();
        let builder = &mut self.base.builder;
        let runs = &path.runs;
        let refused = if path.is_out_of_range() || !builder.within_coordinate_limit(runs) {
            Some((
                Code::OutOfRange,
                "it exceeds the largest allowed coordinate".to_owned(),
            ))
        } else if runs.is_empty() {
            let detail = "it contains no line and no curve";
            Some((Code::TooFewPoints, detail.to_owned()))
        } else if !builder.within_point_budget(runs) {
            Some((Code::Implausible, builder.point_budget_exceeded()))
        } else {
            None
        };
        if let Some((code, detail)) = refused {
            let remedy = "It is left out; correct it in the tool that wrote the file";
            let detail = error.map_or(detail, |error| error.to_string());
            return self.refuse(node, context, code, &detail, remedy);
        }
        if let Some(error) = error {
            let remedy = "It is drawn up to the error; correct it";
            self.base
                .report(Code::WrongType, node, || error.to_string(), remedy);
        }
        if let Some((name, text)) = unread_length(node, cascade, context.viewport) {
            self.report_unread(node, name, text);
        }
        self.clipped += u64::from(style.is_clipped);
        let id = self.path_id(node, context);
        self.base.builder.check_text(&id)?;
        let row = self.base.push_path(
            node,
            &NewPath {
                id: &id,
                runs,
                direction: Direction::Both,
                ..NewPath::default()
            },
        )?;
        self.colors.push(color);
        let width_m = self.stroke_width_m(node, context);
        self.widths_m.push(width_m.unwrap_or(f32::NAN));
        let builder = &mut self.base.builder;
        let element = Value::Text(node.tag_name().name());
        builder.set(Table::Paths, row, "element", element)?;
        match context.group {
            Some(group) => {
                builder.check_text(group)?;
                builder.set(Table::Paths, row, "group", Value::Text(group))
            }
            None => Ok(()),
        }
    }

    /// Reports a value that is not read, by its attribute or property.
    pub(super) fn report_unread(&mut self, node: Node<'d, 't>, name: &str, value: &str) {
        let message = || {
            let start: String = value.chars().take(40).collect();
            format!("its `{name}` is `{start}`, which is malformed or not supported")
        };
        let remedy = "It is drawn as without it; state it in other units, or apply it in the \
                      drawing program";
        self.base.report(Code::WrongType, node, message, remedy);
    }

    fn path_builder(&self, context: &ElementContext<'_>) -> PathBuilder {
        let builder = &self.base.builder;
        let limits = &builder.source.options.limits;
        PathBuilder::new(
            context.meters_from_user,
            limits.conversion_tolerance_m,
            limits.coordinate_m,
            builder.points_left,
        )
    }

    /// Adds the box of a shape. What is not displayed has none.
    fn measure(&mut self, node: Node<'d, 't>, cascade: &Cascade<'d>, context: &ElementContext<'_>) {
        let mut path = self.path_builder(context);
        // A malformed shape has the box of what is drawn of it; mapping it reports the error.
        let _ = append_shape(node, cascade, context.viewport, &mut path);
        let is_measured = context.style.is_displayed && !path.is_out_of_range();
        let boxes = path.runs.iter().filter_map(Bounds::of_run);
        let shape = boxes.reduce(Bounds::union).filter(|_| is_measured);
        let known = self.measured.flatten();
        self.measured = Some(known.into_iter().chain(shape).reduce(Bounds::union));
    }

    /// The stroke width in meters: scaled by the geometric mean of both axes, unless it is
    /// fixed. `None` without a stroke, and with a finding if the width exceeds the largest
    /// coordinate.
    fn stroke_width_m(&mut self, node: Node<'d, 't>, context: &ElementContext<'_>) -> Option<f32> {
        if !context.style.has_stroke() {
            return None;
        }
        let Affine { x, y, .. } = context.meters_from_user;
        let scale = match context.style.is_stroke_fixed {
            true => METERS_PER_PX,
            false => x.cross(y).abs().sqrt(),
        };
        let width_m = context.style.stroke_width * scale;
        if width_m <= self.base.builder.source.options.limits.coordinate_m {
            return Some(width_m as f32);
        }
        let message = || format!("the stroke width is {width_m} m");
        let remedy = "The width of the view is used; correct the width";
        self.base.report(Code::OutOfRange, node, message, remedy);
        None
    }

    /// Sets styles, counts and provenance of the layout, and reports ignored elements.
    pub(super) fn finish(self, root: Node<'d, 't>, sheet: &StyleSheet<'_>) -> Layout {
        let Self {
            base,
            colors,
            widths_m,
            clipped,
            measured: _,
            names: _,
        } = self;
        let mut builder = base.builder;
        report_ignored(&mut builder, root, clipped, sheet);
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

    /// Records a shape as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn refuse(
        &mut self,
        node: Node<'d, 't>,
        context: &ElementContext<'_>,
        code: Code,
        detail: &str,
        remedy: &str,
    ) -> Result<(), ReadError> {
        let id = self.path_id(node, context);
        self.base.builder.check_text(&id)?;
        self.base.refuse(&id, code, node, detail, remedy)
    }

    fn path_id(&mut self, node: Node<'d, 't>, context: &ElementContext<'_>) -> String {
        format!("{}{}", context.id_prefix, self.element_id(node))
    }

    /// The identifier of an element, or `line N` if it has none; `line N (2)` for the second one
    /// of a line, and so on.
    pub(super) fn element_id(&mut self, node: Node<'d, 't>) -> String {
        if let Some(id) = node.attribute("id").filter(|id| !id.is_empty()) {
            return id.to_owned();
        }
        let line = self.base.xml.position(node).line;
        match self.names.number(node.id(), line) {
            1 => format!("line {line}"),
            number => format!("line {line} ({number})"),
        }
    }
}
