//! From entities to paths: blocks are put in place, and layers and colors handed down.

use guideway_layout::{Code, NewPath, Place, Value};
use guideway_spline::Runs;

use super::drawing::Drawing;
use super::entity::{Entity, Insert, Shape};
use super::shapes::{Bounds, Excess, append_arc, append_polyline, append_spline};
use super::space::{Affine, Vector};
use super::style::{Color, decoded, on_paper};
use crate::ReadError;
use crate::builder::{Builder, POINT_BUDGET_EXCEEDED, POINTS_PER_BYTE, PlaceFn, Table};

/// So many entities may come from references to blocks, beside some for each byte of the file, and so many
/// control points instead of what other files may become: a small file could else ask for more than any
/// machine has.
const MOST_ENTITIES: u64 = 1 << 20;
const BYTES_AN_ENTITY: u64 = 16;
const LEAST_POINTS: u64 = 4 << 20;

/// Where a block is put, and what its entities take from the reference to it.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub(super) map: Affine,
    pub(super) layer: Option<u32>,
    pub(super) color: u32,
    /// The handles of the references, each with a slash after it.
    pub(super) handles: &'a str,
    pub(super) depth: usize,
}

/// Makes the paths of a drawing.
pub(super) struct Painter<'a> {
    pub(super) builder: Builder<'a>,
    /// The color of every path.
    pub(super) colors: Vec<u32>,
    /// How many more entities references may make.
    entities_left: u64,
}

impl<'a> Painter<'a> {
    pub(super) fn new(mut builder: Builder<'a>, file_bytes: usize) -> Self {
        builder.points_left = LEAST_POINTS + file_bytes as u64 * POINTS_PER_BYTE;
        Self {
            builder,
            colors: Vec::new(),
            entities_left: MOST_ENTITIES + file_bytes as u64 / BYTES_AN_ENTITY,
        }
    }

    pub(super) fn draw(
        &mut self,
        drawing: &Drawing<'_>,
        entity: &Entity<'_>,
        around: &Around<'_>,
    ) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place {
            element: format!("{} {}", entity.kind, name(entity, around)),
            line: entity.line,
        };
        // Layer 0 of a block is the layer of the reference.
        let own = drawing.layers.get(entity.layer);
        let layer = match around.layer {
            Some(outer) if own.name == "0" => outer,
            _ => entity.layer,
        };
        let of_layer = drawing.layers.get(layer);
        let color = match entity.color {
            Color::Rgba(color) => color,
            Color::OfBlock => around.color,
            Color::OfLayer => of_layer.color,
        };
        let is_insert = matches!(entity.shape, Shape::Insert(_));
        let detail = match entity.hidden {
            Some(why) => Some(why.to_owned()),
            None if of_layer.is_frozen => Some(format!("its layer `{}` is frozen", of_layer.name)),
            // What is in a block may be on other layers.
            None if of_layer.is_off && !is_insert => {
                Some(format!("its layer `{}` is off", of_layer.name))
            }
            None => None,
        };
        if let Some(detail) = detail {
            return self.refuse(entity, around, Code::NotDrawn, &detail, at);
        }
        if let Shape::Insert(insert) = &entity.shape {
            let inner = Around {
                layer: Some(layer),
                color,
                ..*around
            };
            return self.insert(drawing, (entity, insert), around, &inner, at);
        }
        if let Shape::Broken(code, detail) = &entity.shape {
            return self.refuse(entity, around, *code, detail, at);
        }
        let mut runs = Runs::default();
        if let Err(excess) = self.append(&entity.shape, &around.map, at, &mut runs)? {
            let (code, detail) = match excess {
                Excess::Far => (Code::OutOfRange, "it goes beyond the largest coordinate"),
                Excess::Points => (Code::Implausible, POINT_BUDGET_EXCEEDED),
            };
            return self.refuse(entity, around, code, detail, at);
        }
        if runs.is_empty() {
            let detail = "it has fewer than two points";
            return self.refuse(entity, around, Code::TooFewPoints, detail, at);
        }
        let id = name(entity, around);
        self.builder.check_text(&id)?;
        self.builder.check_text(&of_layer.name)?;
        let row = self.builder.push_path(&NewPath {
            id: &id,
            runs: &runs,
            ..NewPath::default()
        })?;
        self.colors.push(on_paper(color));
        let layer = Value::Text(&of_layer.name);
        self.builder.set(Table::Paths, row, "layer", layer)?;
        let kind = Value::Text(entity.kind);
        self.builder.set(Table::Paths, row, "entity", kind)
    }

    /// Puts a shape into empty `runs`, if it is within bounds.
    fn append(
        &mut self,
        shape: &Shape,
        map: &Affine,
        at: PlaceFn<'_>,
        runs: &mut Runs,
    ) -> Result<Result<(), Excess>, ReadError> {
        let limits = &self.builder.source.options.limits;
        let bounds = Bounds {
            tolerance_m: limits.conversion_tolerance_m,
            coordinate_m: limits.coordinate_m,
            points: self.builder.points_left,
        };
        if bounds.points == 0 {
            return Ok(Err(Excess::Points));
        }
        let appended = match shape {
            Shape::Line(ends) => {
                let [start, end] = ends.map(|end| map.point(end).flat());
                runs.push_line(start, end);
                Ok(())
            }
            Shape::Arc(arc) => append_arc(arc, map, &bounds, runs),
            Shape::Polyline(polyline) => {
                self.builder.check_curve_points(polyline.vertices.len())?;
                append_polyline(polyline, map, &bounds, runs)
            }
            Shape::Spline(spline) => {
                append_spline(&mut self.builder, spline, map, at, runs)?;
                Ok(())
            }
            Shape::Insert(_) | Shape::Broken(..) => Ok(()),
        };
        let checked = appended.and_then(|()| bounds.check(runs));
        if checked == Err(Excess::Points) {
            // There is no room for this one, and looking for one that still fits could take for ever.
            self.builder.points_left = 0;
        }
        Ok(checked)
    }

    fn insert(
        &mut self,
        drawing: &Drawing<'_>,
        (entity, insert): (&Entity<'_>, &Insert),
        around: &Around<'_>,
        inner: &Around<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let block = &drawing.blocks[insert.block as usize];
        let Some(base) = block.base else {
            let detail = "the block that it refers to is not there";
            return self.refuse(entity, around, Code::UnknownValue, detail, at);
        };
        // Only what the drawing itself refers to is counted: all blocks within are in its number.
        if around.depth == 0 {
            let depth = self.builder.source.options.limits.depth;
            let count = entity.count(|block| drawing.count(block, depth));
            let Some(left) = self.entities_left.checked_sub(count) else {
                let detail = format!(
                    "it stands for more than {} entities: its block is within itself, or is repeated \
                     too often, or blocks are more than {depth} deep",
                    self.entities_left
                );
                return self.refuse(entity, around, Code::Implausible, &detail, at);
            };
            self.entities_left = left;
        }
        let handle = name(entity, around);
        let is_array = insert.columns > 1 || insert.rows > 1;
        for row in 0..insert.rows {
            for column in 0..insert.columns {
                let handles = match is_array {
                    true => format!("{handle}[{column},{row}]/"),
                    false => format!("{handle}/"),
                };
                let [along, up] = insert.steps;
                let step = along * f64::from(column) + up * f64::from(row);
                let map = around
                    .map
                    .after(&Affine::translation(step))
                    .after(&insert.placed)
                    .after(&Affine::translation(Vector::ZERO - base));
                let inner = Around {
                    map,
                    handles: &handles,
                    depth: around.depth + 1,
                    ..*inner
                };
                for entity in &block.entities {
                    self.draw(drawing, entity, &inner)?;
                }
            }
        }
        Ok(())
    }

    fn refuse(
        &mut self,
        entity: &Entity<'_>,
        around: &Around<'_>,
        code: Code,
        detail: &str,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let remedy = match code {
            Code::NotDrawn => "Nothing to do if it is not meant to be seen",
            _ => "It is left out; correct it in the tool that wrote the file",
        };
        self.builder.report(code, at, || detail.to_owned(), remedy);
        self.builder.refuse(&name(entity, around), code, detail)
    }
}

/// The identifier of an entity: the handles of all references around it and its own. Old files have none.
fn name(entity: &Entity<'_>, around: &Around<'_>) -> String {
    let own = match (&entity.id, entity.handle, entity.line) {
        (Some(id), ..) => id.clone(),
        (None, b"", Some(line)) => format!("line {line}"),
        (None, b"", None) => entity.kind.to_owned(),
        (None, handle, _) => decoded(handle),
    };
    format!("{}{own}", around.handles)
}
