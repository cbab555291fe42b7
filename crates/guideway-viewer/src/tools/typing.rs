//! Typed input of the tools that add points: keys and texts in the order in which they came.

use eframe::egui::{Key, Modifiers};
use guideway_document::{Drawing, DrawnCurve, Snapped};
use guideway_spline::Point;

use super::tool::Tool;
use super::tool_context::ToolContext;
use super::tool_set::{ToolEffect, Tools};
use super::typed_text::{Typed, TypedText, parse};
use crate::language::t;

/// The answer of the tools to a key.
pub(crate) enum KeyAnswer {
    /// The key is none of theirs.
    NotTaken,
    Taken(Option<ToolEffect>),
}

/// The points so far with the next one, and the path through them.
pub(crate) struct Sketch {
    pub(crate) points_m: Vec<Point<f64>>,
    /// `None` without a tool that draws.
    pub(crate) drawing: Option<Drawing>,
}

impl Tools {
    /// The tools would draw this: with the typed place or radius, else with the place at the
    /// pointer. `None` without a point.
    pub(crate) fn sketch(
        &self,
        context: &ToolContext<'_>,
        pointer_m: Option<Point<f64>>,
        modifiers: Modifiers,
    ) -> Option<Sketch> {
        let typed = self.typed.as_ref();
        let typed = typed.and_then(|typed| parse(&typed.text).ok());
        if let Some(Typed::Radius(radius_m)) = typed
            && let Ok(drawing) = self.drawing_of_radius(radius_m, pointer_m)
        {
            let (points_m, drawing) = (self.points().to_vec(), Some(drawing));
            return Some(Sketch { points_m, drawing });
        }
        let typed = typed.and_then(|typed| self.place_of(typed, pointer_m, context).ok());
        if typed.is_none() && self.points().is_empty() {
            return None;
        }
        let snapped = |at_m| self.snapped(context, at_m, modifiers).at_m;
        let next_m = typed.or_else(|| pointer_m.map(snapped));
        Some(Sketch {
            points_m: self.points().iter().copied().chain(next_m).collect(),
            drawing: self.drawing(next_m),
        })
    }

    /// The text that is being typed.
    pub(crate) fn typed(&self) -> Option<&TypedText> {
        self.typed.as_ref()
    }

    /// Takes a typed text: a digit or sign begins one, further ones continue it. Returns `false`
    /// if the text is none of theirs.
    pub(crate) fn type_text(&mut self, text: &str) -> bool {
        if self.typed.is_none() && !self.begins_text(text) {
            return false;
        }
        let typed = self.typed.get_or_insert_default();
        typed
            .text
            .extend(text.chars().filter(|sign| !sign.is_control()));
        typed.error = None;
        true
    }

    /// Takes a key: Tab opens the text, Enter confirms it, Escape closes it.
    pub(crate) fn type_key(
        &mut self,
        key: Key,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
        pointer_px: Option<Point<f64>>,
    ) -> KeyAnswer {
        let Some(typed) = &mut self.typed else {
            let opens = key == Key::Tab && self.tool.adds_points() && modifiers.is_none();
            if opens {
                self.typed = Some(TypedText::default());
            }
            // The text of the key follows.
            let begins = match key {
                Key::R => self.begins_text("r"),
                Key::Minus => self.begins_text("-"),
                _ => false,
            };
            return match opens || begins && modifiers.is_none() {
                true => KeyAnswer::Taken(None),
                false => KeyAnswer::NotTaken,
            };
        };
        match key {
            Key::Enter => return KeyAnswer::Taken(self.confirm_text(context, pointer_px)),
            Key::Escape => self.typed = None,
            Key::Backspace => {
                typed.text.pop();
                typed.error = None;
            }
            // Commands such as Save work, other keys are part of the text.
            _ if modifiers.command => return KeyAnswer::NotTaken,
            _ => {}
        }
        KeyAnswer::Taken(None)
    }

    /// Returns `true` if a text begins typed input.
    fn begins_text(&self, text: &str) -> bool {
        let is_number =
            text.starts_with(|sign: char| sign.is_ascii_digit() || "-.@".contains(sign));
        let is_radius = text.starts_with(['r', 'R']) && self.tool == Tool::Arc;
        (is_number && self.tool.adds_points()) || (is_radius && self.points().len() == 2)
    }

    /// Adds the point that the text means, or says in its place what is wrong.
    fn confirm_text(
        &mut self,
        context: &ToolContext<'_>,
        pointer_px: Option<Point<f64>>,
    ) -> Option<ToolEffect> {
        let typed = self.typed.as_ref()?;
        let pointer_m = pointer_px.map(|at_px| context.world(at_px));
        let effect = match parse(&typed.text) {
            Ok(Typed::Radius(radius_m)) => {
                let drawing = self.drawing_of_radius(radius_m, pointer_m);
                drawing.map(|drawing| Some(self.draw(drawing, context)))
            }
            Ok(typed) => self
                .place_of(typed, pointer_m, context)
                .map(|at_m| self.add_point(Snapped { at_m, to: None }, context)),
            Err(error) => Err(error),
        };
        let error = match effect {
            Ok(Some(ToolEffect::Refused(error))) | Err(error) => error,
            Ok(effect) => return effect,
        };
        self.typed.get_or_insert_default().error = Some(error);
        None
    }

    /// The position that a text means.
    fn place_of(
        &self,
        typed: Typed,
        pointer_m: Option<Point<f64>>,
        context: &ToolContext<'_>,
    ) -> Result<Point<f64>, String> {
        let last = self.points().last().copied();
        let last = last.ok_or(t("this needs a first point; click one, or type x,y"));
        match typed {
            Typed::Place(at_m) => Ok(at_m),
            Typed::Offset(by_m) => Ok(last? + by_m),
            Typed::Polar {
                length_m,
                angle_deg,
            } => {
                let (sin, cos) = angle_deg.to_radians().sin_cos();
                Ok(last? + Point::new(cos, sin) * length_m)
            }
            Typed::Length(length_m) => {
                let last = last?;
                // A pointer on the last point gives no direction: that of the last line continues.
                let reach_m = context.hit_radius_m();
                let along = pointer_m.map(|at_m| at_m - last);
                let along = along.filter(|along| along.norm() > reach_m);
                let along = along.or_else(|| {
                    let [from, to] = *self.points().last_chunk()?;
                    Some(to - from).filter(|along| along.norm() > 0.0)
                });
                let along = along.unwrap_or(Point::new(1.0, 0.0));
                Ok(last + along * (length_m / along.norm()))
            }
            Typed::Radius(_) => Err(t("a radius needs start and end of an arc").to_owned()),
        }
    }

    /// The arc of a radius, on the side of the pointer.
    fn drawing_of_radius(
        &self,
        radius_m: f64,
        pointer_m: Option<Point<f64>>,
    ) -> Result<Drawing, String> {
        let needs_ends = || t("a radius needs start and end of an arc").to_owned();
        let (Tool::Arc, &[start, end]) = (self.tool, self.points()) else {
            return Err(needs_ends());
        };
        let mut drawing = self.drawing(None).ok_or_else(needs_ends)?;
        // An arc that bulges to the right of its chord turns to the left.
        let bulges_left = pointer_m.is_some_and(|at_m| (end - start).cross(at_m - start) > 0.0);
        let signed_m = if bulges_left { -radius_m } else { radius_m };
        drawing.curve = DrawnCurve::ArcOfRadius(signed_m);
        Ok(drawing)
    }
}
