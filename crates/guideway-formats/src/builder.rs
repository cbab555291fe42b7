//! Layout builder: collects the paths, nodes and stations that a text reader finds into a
//! [`Layout`], holds them to the limits and to budgets by file size, and records diagnostics.

use guideway_layout::{
    Attributes, Block, Code, Diagnostics, Layout, Member, NewPath, Origin, Place, Property,
    RefusedPath, Severity, SourceSpans, TextColumn, TextPosition, Value, element_name,
};
use guideway_spline::{Point, Runs};

use crate::fields::FormatField;
use crate::{
    Problem, ReadError,
    source::Source,
    text::{compact, printable},
};

/// Makes the place of an element in the file. The builder calls it only for diagnostics it stores:
/// formatting a place for each of a million faulty elements would dominate the read.
pub(crate) type PlaceFn<'f> = &'f dyn Fn() -> Place;

/// Control points that any file may expand to, however small.
///
/// A few weighted curves, or elements that refer to others, could else expand to more than any
/// machine holds.
const MIN_POINT_BUDGET: u64 = 1 << 18;
/// Control points that a file may expand to in addition, per byte.
pub(crate) const POINTS_PER_BYTE: u64 = 4;

/// Fills a layout within the limits of a read.
pub(crate) struct Builder<'a> {
    pub(crate) source: Source<'a>,
    pub(crate) layout: Layout,
    /// Control points that the file may expand to.
    point_budget: u64,
    /// Control points that the file may still expand to.
    pub(crate) points_left: u64,
    text_bytes: u64,
    max_text_bytes: u64,
    file_bytes: u64,
    /// Bytes of the file that were read, for readers that pass through it once.
    read_bytes: u64,
    /// First byte in the file of the element that is mapped, where lines are found at the end.
    pub(crate) element_byte: Option<usize>,
    /// Place of the element that is mapped, where the layout does not keep the text.
    pub(crate) element_position: Option<TextPosition>,
}

/// The table that an attribute belongs to.
#[derive(Clone, Copy)]
pub(crate) enum Table {
    Paths,
    /// Entries of paths per vehicle type.
    PathTypes,
    Nodes,
    /// Entries of nodes per vehicle type.
    NodeTypes,
    Stations,
    /// The block of this row, whose attributes are in row 0.
    Block(u32),
    /// The layout as a whole, whose attributes are in row 0.
    Layout,
}

impl<'a> Builder<'a> {
    /// Makes a builder of an empty layout for a file of `file_bytes` bytes.
    pub(crate) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        let mut layout = Layout {
            diagnostics: Diagnostics::with_limit(source.options.limits.diagnostics_per_code),
            ..Layout::default()
        };
        source.name.clone_into(&mut layout.provenance.source);
        let point_budget = MIN_POINT_BUDGET + file_bytes as u64 * POINTS_PER_BYTE;
        Self {
            source,
            layout,
            point_budget,
            points_left: point_budget,
            text_bytes: 0,
            max_text_bytes: max_text_bytes(file_bytes as u64),
            file_bytes: file_bytes as u64,
            read_bytes: 0,
            element_byte: None,
            element_position: None,
        }
    }

    /// Adds to the bytes read, and reports progress once per MiB. Fails if the caller cancels.
    pub(crate) fn advance(&mut self, bytes: usize) -> Result<(), ReadError> {
        let before = self.read_bytes >> 20;
        self.read_bytes += bytes as u64;
        if self.read_bytes >> 20 == before {
            return Ok(());
        }
        let paths = self.layout.paths.len();
        self.source
            .advance([self.read_bytes, self.file_bytes], paths);
        self.source.check_cancelled()
    }

    /// Records a diagnostic. Control characters of the file are escaped in its texts.
    pub(crate) fn report(
        &mut self,
        code: Code,
        at: PlaceFn<'_>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        self.report_as(code.severity(), code, at, message, remedy);
    }

    /// Records a diagnostic whose severity depends on the case, not only on its code.
    pub(crate) fn report_as(
        &mut self,
        severity: Severity,
        code: Code,
        at: PlaceFn<'_>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let byte = self.element_byte;
        let (at, message) = (|| printable_place(at, byte), || printable(&message()));
        let found = &mut self.layout.diagnostics;
        found.push_as(severity, code, at, message, remedy);
    }

    /// Appends a path and returns its row.
    ///
    /// # Errors
    /// When the layout would exceed a limit, or the caller cancels the read.
    pub(crate) fn push_path(&mut self, path: &NewPath<'_>) -> Result<usize, ReadError> {
        self.charge_text(path.id)?;
        let limits = &self.source.options.limits;
        let geometry = self.layout.paths.geometry();
        let points = geometry.point_count() + path.runs.points().len();
        self.check_limit("control points", limits.control_points, points as u64)?;
        self.check_paths()?;
        let points = path.runs.points().len() as u64;
        self.points_left = self.points_left.saturating_sub(points);
        let row = self.layout.paths.push(path);
        let place = (self.element_byte, self.element_position);
        mark(&mut self.layout.paths.source, row as u32, place);
        Ok(row)
    }

    /// Sets the number of control points that the file may expand to.
    pub(crate) fn set_point_budget(&mut self, points: u64) {
        (self.point_budget, self.points_left) = (points, points);
    }

    /// Describes a curve that exceeds the point budget.
    pub(crate) fn point_budget_exceeded(&self) -> String {
        let limit = self.point_budget;
        format!(
            "too many control points for a file of this size (limit {limit}); this curve would \
             exceed it"
        )
    }

    /// Returns whether a curve fits into the point budget of the file.
    ///
    /// The first curve that does not fit empties the budget: a file could else make the reader
    /// convert curves without end in search of one that fits.
    pub(crate) fn within_point_budget(&mut self, runs: &Runs) -> bool {
        let fits = self.points_left > 0 && runs.points().len() as u64 <= self.points_left;
        if !fits {
            self.points_left = 0;
        }
        fits
    }

    /// Returns whether all control points are finite and within the coordinate limit.
    pub(crate) fn within_coordinate_limit(&self, runs: &Runs) -> bool {
        let limit = self.source.options.limits.coordinate_m;
        let mut points = runs.points().iter();
        points.all(|p| p.x.abs() <= limit && p.y.abs() <= limit)
    }

    /// Records a path that cannot be drawn, with the reason, and a finding at the path. For paths
    /// whose fault has been reported at one of their fields.
    pub(crate) fn refuse(&mut self, id: &str, code: Code, detail: &str) -> Result<(), ReadError> {
        let row = self.layout.path_count();
        let at = || Place::element(element_name("path", row, id));
        let remedy = "It is left out; correct it in the tool that wrote the file";
        self.refuse_at(id, code, detail, &at, remedy)
    }

    /// Records a path that cannot be drawn, with the reason, and a finding at a place of the file.
    pub(crate) fn refuse_at(
        &mut self,
        id: &str,
        code: Code,
        detail: &str,
        at: PlaceFn<'_>,
        remedy: &str,
    ) -> Result<(), ReadError> {
        let detail = &printable(detail);
        self.charge_text(id)?;
        self.charge_text(detail)?;
        self.check_paths()?;
        let path = RefusedPath { id, code, detail };
        let byte = self.element_byte;
        let found = &mut self.layout.diagnostics;
        found.push_refused(path, || printable_place(at, byte), remedy);
        self.layout.refused.push(id, code, detail);
        Ok(())
    }

    /// Appends a node and returns its row.
    pub(crate) fn push_node(
        &mut self,
        id: &str,
        position_m: Point<f64>,
        level: Option<u32>,
    ) -> Result<u32, ReadError> {
        self.push_node_for_types(id, position_m, level, &[])
    }

    /// Appends a node with an entry per vehicle type and returns its row.
    pub(crate) fn push_node_for_types(
        &mut self,
        id: &str,
        position_m: Point<f64>,
        level: Option<u32>,
        types: &[&str],
    ) -> Result<u32, ReadError> {
        self.charge_text(id)?;
        let place = (self.element_byte, self.element_position);
        let nodes = &mut self.layout.nodes;
        let row = nodes.push_for_types(id, position_m, level, types);
        Ok(mark(&mut nodes.source, row, place))
    }

    /// Appends a station and returns its row.
    pub(crate) fn push_station(
        &mut self,
        id: &str,
        position_m: Option<Point<f64>>,
        nodes: Vec<u32>,
        level: Option<u32>,
    ) -> Result<u32, ReadError> {
        self.charge_text(id)?;
        let place = (self.element_byte, self.element_position);
        let stations = &mut self.layout.stations;
        let row = stations.push(id, position_m, nodes, level);
        Ok(mark(&mut stations.source, row, place))
    }

    /// Appends a block and returns its row.
    pub(crate) fn push_block(&mut self, id: &str, members: Vec<Member>) -> Result<u32, ReadError> {
        self.charge_text(id)?;
        self.layout.blocks.push(Block {
            id: id.to_owned(),
            members,
            attributes: Attributes::default(),
        });
        Ok((self.layout.blocks.len() - 1) as u32)
    }

    /// Sets an attribute of a row. A number of a known property is in its SI unit.
    pub(crate) fn set(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        value: Value<'_>,
    ) -> Result<(), ReadError> {
        if let Value::Text(text) | Value::Json(text) = value {
            self.charge_text(text)?;
        }
        self.attributes(table).set(row, name, value);
        Ok(())
    }

    /// Sets the property of a row that a field of the file holds, in SI units.
    pub(crate) fn set_field(
        &mut self,
        table: Table,
        row: usize,
        field: &FormatField,
        value: Value<'_>,
    ) -> Result<(), ReadError> {
        let quantity = field.property().and_then(Property::quantity);
        match (quantity, value.number()) {
            (Some(quantity), Some(number)) => {
                let number = field.to_si(number);
                let attributes = self.attributes(table);
                attributes.set_quantity(row, field.property, number, quantity);
                Ok(())
            }
            _ => self.set(table, row, field.property, value),
        }
    }

    /// The attributes of a table.
    pub(crate) fn attributes(&mut self, table: Table) -> &mut Attributes {
        match table {
            Table::Paths => &mut self.layout.paths.attributes,
            Table::PathTypes => &mut self.layout.paths.vehicle_types_mut().attributes,
            Table::Nodes => &mut self.layout.nodes.attributes,
            Table::NodeTypes => &mut self.layout.nodes.vehicle_types_mut().attributes,
            Table::Stations => &mut self.layout.stations.attributes,
            Table::Block(row) => &mut self.layout.blocks[row as usize].attributes,
            Table::Layout => &mut self.layout.attributes,
        }
    }

    /// Returns whether a point is finite and within the coordinate limit; reports it if not.
    pub(crate) fn check_point(&mut self, point: Point<f64>, at: PlaceFn<'_>) -> bool {
        let limit = self.source.options.limits.coordinate_m;
        if !point.is_finite() {
            let message = || format!("the position ({}, {}) is not finite", point.x, point.y);
            self.report(Code::NonFinite, at, message, "Correct the position");
            return false;
        }
        if point.x.abs().max(point.y.abs()) > limit {
            let message = || {
                let [x, y] = [point.x, point.y].map(compact);
                format!("the position ({x} m, {y} m) is beyond the limit of {limit} m")
            };
            self.report(
                Code::OutOfRange,
                at,
                message,
                "Check the unit of the position",
            );
            return false;
        }
        true
    }

    /// Fails for a text longer than the limit of one text.
    pub(crate) fn check_text(&self, text: &str) -> Result<(), ReadError> {
        let limit = self.source.options.limits.text_bytes as u64;
        self.check_limit("bytes in one text", limit, text.len() as u64)
    }

    /// Fails for a curve with more points or knots than the limit of one curve.
    pub(crate) fn check_curve_points(&self, count: usize) -> Result<(), ReadError> {
        let limit = self.source.options.limits.curve_points as u64;
        self.check_limit("control points or knots of one curve", limit, count as u64)
    }

    /// Charges a text to the budget of the file.
    pub(crate) fn charge_text(&mut self, text: &str) -> Result<(), ReadError> {
        self.text_bytes += text.len() as u64;
        let what = "bytes of names and attributes";
        self.check_limit(what, self.max_text_bytes, self.text_bytes)
    }

    fn check_paths(&self) -> Result<(), ReadError> {
        let paths = self.layout.path_count() as u64 + 1;
        if paths.is_multiple_of(1024) {
            self.source.check_cancelled()?;
        }
        self.check_limit("paths", self.source.options.limits.paths, paths)
    }

    fn check_limit(&self, what: &'static str, limit: u64, actual: u64) -> Result<(), ReadError> {
        if actual <= limit {
            return Ok(());
        }
        Err(self.source.fail(Problem::LimitReached {
            what,
            limit,
            actual,
        }))
    }
}

/// A place without control characters of the file, whose line follows from a byte.
fn printable_place(at: PlaceFn<'_>, byte: Option<usize>) -> Place {
    let mut place = at();
    place.element = printable(&place.element);
    place.origin = byte.map(Origin::Byte);
    place
}

/// Keeps the place of the element of a row: its line, and its first byte if the column can hold it.
/// Returns the row.
fn mark(source: &mut SourceSpans, row: u32, place: (Option<usize>, Option<TextPosition>)) -> u32 {
    let (byte, position) = place;
    if let Some(position) = position {
        source.set_position(row as usize, position);
    }
    if let Some(byte) = byte.filter(|&byte| byte < u32::MAX as usize) {
        source.set(row as usize, byte);
    }
    row
}

/// Text budget of a file: 64 bytes per byte and 1 MiB, at most a full text column.
///
/// Names and reasons that a reader composes are longer than their source, but by a bounded factor.
fn max_text_bytes(file_bytes: u64) -> u64 {
    let budget = file_bytes.saturating_mul(64).saturating_add(1 << 20);
    budget.min(TextColumn::MAX_BYTES as u64)
}
