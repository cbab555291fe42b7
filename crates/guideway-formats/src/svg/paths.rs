//! From shapes to paths, with their color, width and group.

use guideway_layout::{Code, Direction, NewPath, Value};
use guideway_spline::Affine;
use roxmltree::Node;

use super::data::Pen;
use super::shapes::draw;
use super::walk::{Around, Walker};
use crate::ReadError;
use crate::builder::{POINT_BUDGET_EXCEEDED, Table};

impl<'d, 't> Walker<'_, 'd, 't> {
    /// Draws a shape, or refuses it with the reason.
    pub(super) fn shape(
        &mut self,
        node: Node<'d, 't>,
        around: &Around<'_>,
    ) -> Result<(), ReadError> {
        let style = around.style;
        let hidden = match (style.is_displayed, style.is_visible, style.color_rgba()) {
            (false, ..) => Err("it is not displayed"),
            (_, false, _) => Err("it is not visible"),
            (.., None) => Err("neither its line nor its area is painted"),
            (.., Some(color)) => Ok(color),
        };
        let color = match hidden {
            Ok(color) => color,
            Err(detail) => {
                let remedy = "Nothing to do if it is not meant to be seen";
                self.report(Code::NotDrawn, node, || detail.to_owned(), remedy);
                return self.refuse(node, around, Code::NotDrawn, detail);
            }
        };
        let limits = &self.builder.source.options.limits;
        let mut pen = Pen::new(
            around.meters_from_user,
            limits.conversion_tolerance_m,
            limits.coordinate_m,
            self.builder.points_left,
        );
        let drawn = draw(node, around.viewport, &mut pen);
        let runs = &pen.runs;
        let wrong = drawn.err();
        let refused = if pen.is_too_far() || !self.builder.within_coordinate_limit(runs) {
            Some((Code::OutOfRange, "it goes beyond the largest coordinate"))
        } else if runs.is_empty() {
            Some((Code::TooFewPoints, "there is no line and no curve in it"))
        } else if !self.builder.within_point_budget(runs) {
            Some((Code::Implausible, POINT_BUDGET_EXCEEDED))
        } else {
            None
        };
        if let Some((code, detail)) = refused {
            let remedy = "It is left out; correct it in the tool that wrote the file";
            let detail = wrong.as_deref().unwrap_or(detail);
            self.report(code, node, || detail.to_owned(), remedy);
            return self.refuse(node, around, code, detail);
        }
        if let Some(wrong) = wrong {
            let remedy = "It is drawn up to there; correct it";
            self.report(Code::WrongType, node, || wrong, remedy);
        }
        self.clipped += u64::from(style.is_clipped);
        let id = format!("{}{}", around.references, self.name(node));
        self.builder.check_text(&id)?;
        let row = self.builder.push_path(&NewPath {
            id: &id,
            runs,
            direction: Direction::Both,
            ..NewPath::default()
        })?;
        self.colors.push(color);
        let Affine { x, y, .. } = around.meters_from_user;
        let width_m = style.stroke_width * x.cross(y).abs().sqrt();
        let is_sound = width_m <= self.builder.source.options.limits.coordinate_m;
        if style.has_stroke() && !is_sound {
            let message = || format!("the line is {width_m} m wide");
            let remedy = "The width of the view is used; correct the width";
            self.report(Code::OutOfRange, node, message, remedy);
        }
        self.widths_m.push(match style.has_stroke() && is_sound {
            true => width_m as f32,
            false => f32::NAN,
        });
        let element = Value::Text(node.tag_name().name());
        self.builder.set(Table::Paths, row, "element", element)?;
        match around.group {
            Some(group) => {
                self.builder.check_text(group)?;
                self.builder
                    .set(Table::Paths, row, "group", Value::Text(group))
            }
            None => Ok(()),
        }
    }

    /// Lists a shape that is not drawn.
    pub(super) fn refuse(
        &mut self,
        node: Node<'d, 't>,
        around: &Around<'_>,
        code: Code,
        detail: &str,
    ) -> Result<(), ReadError> {
        let id = format!("{}{}", around.references, self.name(node));
        self.builder.check_text(&id)?;
        self.builder.refuse(&id, code, detail)
    }
}
