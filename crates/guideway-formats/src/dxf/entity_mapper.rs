//! Maps entities to paths: expands INSERTs recursively and resolves inherited layers and colors.

use guideway_layout::{Code, NewPath, Place, Severity, TextPosition, Value, WrittenCurve};
use guideway_spline::Runs;

use super::affine3::{Affine3, Vector3};
use super::clip_region::{self, ClipRegion, TooMuchWork};
use super::clips::Boundary;
use super::drawing::Drawing;
use super::entity::Entity;
use super::notes::{add_block, add_mark, is_note};
use super::shape::{Insert, Shape};
use super::shapes::{ExceededLimit, ShapeLimits, append_arc, append_polyline, append_spline};
use super::style::{Color, Layer, path_color};
use crate::ReadError;
use crate::builder::{Builder, POINTS_PER_BYTE, PlaceFn, Table};
use crate::clamped::is_rewritten_as;

/// Entities that INSERTs may expand to in any file. Without this bound, nested INSERTs in a file of
/// a kilobyte expand to more entities than a machine can hold.
const BASE_ENTITIES: u64 = 1 << 20;

/// File size that allows one more expanded entity, in bytes.
const BYTES_PER_ENTITY: u64 = 16;

/// Control points that any drawing may expand to. Larger than for other formats, because INSERTs
/// legitimately repeat large blocks.
const BASE_POINTS: u64 = 4 << 20;

/// Remedy for blocks that are drawn beyond their boundary.
pub(super) const CLIP_REMEDY: &str =
    "To draw the visible part only, explode the block and trim it in the CAD program";

/// The state that entities inherit from the INSERTs around them.
#[derive(Clone, Copy)]
pub(super) struct InsertContext<'a> {
    /// From entity coordinates to meters.
    pub(super) transform: Affine3,
    /// Layer of the innermost INSERT.
    pub(super) layer: Option<u32>,
    /// Color of the innermost INSERT, 0xRRGGBBAA.
    pub(super) color: u32,
    /// The handles of all INSERTs from the outermost on, each followed by a slash.
    pub(super) handle_prefix: &'a str,
    pub(super) depth: usize,
    /// The region outside of which nothing is drawn.
    pub(super) region: Option<&'a ClipRegion<'a>>,
}

/// Maps entities to the paths of a layout.
pub(super) struct EntityMapper<'a> {
    pub(super) builder: Builder<'a>,
    /// The color of every path.
    pub(super) colors: Vec<u32>,
    /// Remaining budget of entities from INSERTs.
    entities_left: u64,
    /// Remaining budget of comparisons with boundaries.
    clip_work_left: u64,
}

impl<'a> EntityMapper<'a> {
    pub(super) fn new(mut builder: Builder<'a>, file_bytes: usize) -> Self {
        builder.set_point_budget(BASE_POINTS + file_bytes as u64 * POINTS_PER_BYTE);
        Self {
            builder,
            colors: Vec::new(),
            entities_left: BASE_ENTITIES + file_bytes as u64 / BYTES_PER_ENTITY,
            clip_work_left: clip_region::work(file_bytes),
        }
    }

    /// Appends the paths of an entity, or records the entity as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn map_entity(
        &mut self,
        drawing: &Drawing<'_>,
        entity: &Entity<'_>,
        context: &InsertContext<'_>,
    ) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place {
            line: entity.line,
            ..Place::element(format!(
                "{} {}",
                entity.kind,
                entity.id_after(context.handle_prefix)
            ))
        };
        // Inside a block, layer 0 means the layer of the INSERT.
        let layer_row = match context.layer {
            Some(outer) if drawing.layers.get(entity.layer).name == "0" => outer,
            _ => entity.layer,
        };
        let layer = drawing.layers.get(layer_row);
        let color = match entity.color {
            Color::Rgba(color) => color,
            Color::ByBlock => context.color,
            Color::ByLayer => layer.color,
        };
        let is_insert = matches!(entity.shape, Shape::Insert(_));
        let detail = match entity.hidden {
            Some(reason) => Some(reason.to_owned()),
            None if layer.is_frozen => Some(format!("its layer `{}` is frozen", layer.name)),
            // Entities of a block may be on other layers, so only frozen layers hide an INSERT.
            None if layer.is_off && !is_insert => {
                Some(format!("its layer `{}` is off", layer.name))
            }
            None => None,
        };
        if is_note(entity.kind) {
            // Hidden and broken entities name nothing.
            return match (&entity.shape, detail) {
                (Shape::Mark(mark), None)
                    if self.shows(context.region, context.transform.point(mark.at), at) =>
                {
                    add_mark(&mut self.builder, mark, &context.transform, &layer.name)
                }
                _ => Ok(()),
            };
        }
        if let Some(detail) = detail {
            return self.refuse(entity, context, Code::NotDrawn, &detail, at);
        }
        if let Shape::Insert(insert) = &entity.shape {
            let inner = InsertContext {
                layer: Some(layer_row),
                color,
                ..*context
            };
            return self.map_insert(drawing, (entity, insert), context, &inner, at);
        }
        if let Shape::Broken(code, detail) = &entity.shape {
            return self.refuse(entity, context, *code, detail, at);
        }
        let id = entity.id_after(context.handle_prefix);
        let Shape::Lines(lines) = &entity.shape else {
            return self.map_curve((&entity.shape, &id), entity, context, (layer, color), at);
        };
        for (i, line) in lines.iter().enumerate() {
            let id = format!("{id} [{}]", i + 1);
            self.map_curve((line, &id), entity, context, (layer, color), at)?;
        }
        Ok(())
    }

    /// Appends the path of a curve, or records it as refused, with a finding.
    fn map_curve(
        &mut self,
        (shape, id): (&Shape, &str),
        entity: &Entity<'_>,
        context: &InsertContext<'_>,
        (layer, color): (&Layer, u32),
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let (mut runs, mut written) = (Runs::default(), None);
        let transform = &context.transform;
        let appended = self.append_shape(shape, transform, at, &mut runs, &mut written)?;
        if let Err(limit) = appended {
            let (code, detail) = match limit {
                ExceededLimit::Coordinate => (
                    Code::OutOfRange,
                    "it exceeds the largest allowed coordinate".to_owned(),
                ),
                ExceededLimit::Points => (Code::Implausible, self.builder.point_budget_exceeded()),
            };
            return self.refuse(entity, context, code, &detail, at);
        }
        if runs.is_empty() {
            let detail = "it has fewer than two points";
            return self.refuse(entity, context, Code::TooFewPoints, detail, at);
        }
        let Some(region) = context.region else {
            return self.push_path((id, &runs, written), entity, layer, color);
        };
        let cut = region.cut(&runs, &mut self.clip_work_left);
        let pieces = self.within_work(cut, at);
        let pieces = pieces.unwrap_or_else(|| vec![runs.clone()]);
        match &pieces[..] {
            [] => {
                let detail = "the boundary that clips its block hides it (XCLIP)";
                self.refuse(entity, context, Code::NotDrawn, detail, at)
            }
            [piece] => {
                let written = written.filter(|_| *piece == runs);
                self.push_path((id, piece, written), entity, layer, color)
            }
            pieces => {
                for (i, piece) in pieces.iter().enumerate() {
                    let id = format!("{id} [{}]", i + 1);
                    self.push_path((&id, piece, None), entity, layer, color)?;
                }
                Ok(())
            }
        }
    }

    /// Appends a path.
    fn push_path(
        &mut self,
        (id, runs, written): (&str, &Runs, Option<WrittenCurve>),
        entity: &Entity<'_>,
        layer: &Layer,
        color: u32,
    ) -> Result<(), ReadError> {
        self.builder.check_text(id)?;
        self.builder.check_text(&layer.name)?;
        let row = self.builder.push_path(&NewPath {
            id,
            runs,
            ..NewPath::default()
        })?;
        if let Some(line) = entity.line {
            let source = &mut self.builder.layout.paths.source;
            source.set_position(row, TextPosition::line(line));
        }
        if let Some(written) = written {
            let paths = &mut self.builder.layout.paths;
            if !is_rewritten_as(paths.get(row), None, &written) {
                paths.set_written_curve(row, written);
            }
        }
        self.colors.push(path_color(color));
        let layer = Value::Text(&layer.name);
        self.builder.set(Table::Paths, row, "layer", layer)?;
        let kind = Value::Text(entity.kind);
        self.builder.set(Table::Paths, row, "entity", kind)
    }

    /// Appends a shape to empty `runs`, and sets the NURBS curve of a spline. The inner error means
    /// that only this shape is left out.
    fn append_shape(
        &mut self,
        shape: &Shape,
        transform: &Affine3,
        at: PlaceFn<'_>,
        runs: &mut Runs,
        written: &mut Option<WrittenCurve>,
    ) -> Result<Result<(), ExceededLimit>, ReadError> {
        let limits = &self.builder.source.options.limits;
        let limits = ShapeLimits {
            tolerance_m: limits.conversion_tolerance_m,
            coordinate_m: limits.coordinate_m,
            points: self.builder.points_left,
        };
        if limits.points == 0 {
            return Ok(Err(ExceededLimit::Points));
        }
        let appended = match shape {
            Shape::Line(ends) => {
                let [start, end] = ends.map(|end| transform.point(end).xy());
                runs.push_line(start, end);
                Ok(())
            }
            Shape::Arc(arc) => append_arc(arc, transform, &limits, runs),
            Shape::Polyline(polyline) => {
                self.builder.check_curve_points(polyline.vertices.len())?;
                append_polyline(polyline, transform, &limits, runs)
            }
            Shape::Spline(spline) => {
                *written = append_spline(&mut self.builder, spline, transform, at, runs)?;
                Ok(())
            }
            Shape::Insert(_) | Shape::Lines(_) | Shape::Mark(_) | Shape::Broken(..) => Ok(()),
        };
        let checked = appended.and_then(|()| limits.check(runs));
        if checked == Err(ExceededLimit::Points) {
            // Converting every later shape only to drop it could take unbounded time.
            self.builder.points_left = 0;
        }
        Ok(checked)
    }

    /// Maps all entities of a block, once per cell of the INSERT.
    fn map_insert(
        &mut self,
        drawing: &Drawing<'_>,
        (entity, insert): (&Entity<'_>, &Insert),
        context: &InsertContext<'_>,
        inner: &InsertContext<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let block = &drawing.blocks[insert.block as usize];
        let Some(base) = block.base else {
            let detail = "its block is not defined in the file";
            return self.refuse(entity, context, Code::UnknownValue, detail, at);
        };
        if let Some(file) = block.external.filter(|_| block.entities.is_empty()) {
            let file = drawing.layers.texts.decode(file);
            let detail = format!("the external drawing `{file}` is not in this file");
            return self.refuse(entity, context, Code::UnknownValue, &detail, at);
        }
        let boundary = drawing.clips.of(entity.handle);
        if let Some(Boundary::Unknown(reason)) = boundary {
            self.report_unclipped(at, reason);
        }
        // An outermost INSERT pays for all that it expands to, nested blocks included.
        if context.depth == 0 {
            let depth = self.builder.source.options.limits.depth;
            let count = entity.expanded_count(|block| drawing.expanded_count(block, depth));
            let Some(left) = self.entities_left.checked_sub(count) else {
                let detail = format!(
                    "it expands to more than {} entities: its block contains itself, repeats too \
                     often, or nests more than {depth} levels deep",
                    self.entities_left
                );
                return self.refuse(entity, context, Code::Implausible, &detail, at);
            };
            self.entities_left = left;
        }
        let handle = entity.id_after(context.handle_prefix);
        let is_array = insert.columns > 1 || insert.rows > 1;
        for row in 0..insert.rows {
            for column in 0..insert.columns {
                let handle_prefix = match is_array {
                    true => format!("{handle}[{column},{row}]/"),
                    false => format!("{handle}/"),
                };
                let [column_step, row_step] = insert.steps;
                let offset = column_step * f64::from(column) + row_step * f64::from(row);
                let transform = context
                    .transform
                    .after(&Affine3::translation(offset))
                    .after(&insert.transform)
                    .after(&Affine3::translation(Vector3::ZERO - base));
                let region = match boundary {
                    Some(Boundary::Known {
                        corners,
                        is_inverted,
                    }) => {
                        let corners = corners.iter().map(|&p| transform.point(p).xy());
                        let (around, work) = (context.region, &mut self.clip_work_left);
                        let region = ClipRegion::new(corners, *is_inverted, around, work);
                        self.within_work(region, at).flatten()
                    }
                    _ => None,
                };
                let inner = InsertContext {
                    transform,
                    handle_prefix: &handle_prefix,
                    depth: context.depth + 1,
                    region: region.as_ref().or(context.region),
                    ..*inner
                };
                for entity in &block.entities {
                    self.map_entity(drawing, entity, &inner)?;
                }
                let layer = inner.layer.map_or("", |row| &drawing.layers.get(row).name);
                let place = transform.point(base);
                if self.shows(context.region, place, at) {
                    add_block(&mut self.builder, &block.name, layer, place.xy())?;
                }
            }
        }
        Ok(())
    }

    /// Returns `true` if no region hides a point, or none can tell within its work.
    fn shows(&mut self, region: Option<&ClipRegion<'_>>, point: Vector3, at: PlaceFn<'_>) -> bool {
        let shows = region.map(|region| region.shows(point.xy(), &mut self.clip_work_left));
        self.within_work(shows.unwrap_or(Ok(true)), at)
            .unwrap_or(true)
    }

    /// Unwraps a result of clipping; reports the block, which is drawn whole, if there is none.
    fn within_work<T>(&mut self, found: Result<T, TooMuchWork>, at: PlaceFn<'_>) -> Option<T> {
        if found.is_err() {
            self.report_unclipped(at, "it takes too many comparisons");
        }
        found.ok()
    }

    /// Reports a block that is drawn beyond its boundary.
    fn report_unclipped(&mut self, at: PlaceFn<'_>, reason: &str) {
        let message =
            || format!("a boundary clips the block (XCLIP), but {reason}: it is drawn whole");
        let (warning, code) = (Severity::Warning, Code::ApproximateShape);
        self.builder
            .report_as(warning, code, at, message, CLIP_REMEDY);
    }

    /// Records an entity as refused, with a finding.
    fn refuse(
        &mut self,
        entity: &Entity<'_>,
        context: &InsertContext<'_>,
        code: Code,
        detail: &str,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let remedy = match code {
            Code::NotDrawn => "Nothing to do if it is meant to be hidden",
            _ => "It is left out; correct it in the tool that wrote the file",
        };
        let id = entity.id_after(context.handle_prefix);
        self.builder.refuse_at(&id, code, detail, at, remedy)
    }
}
