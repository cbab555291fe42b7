//! What all text readers share on the way to a layout: budgets, diagnostics, straight lines.

use guideway_layout::{Attributes, Code, Diagnostics, Layout, NewPath, Place, TextColumn, Value};
use guideway_spline::{Point, Runs};

use crate::{Problem, ReadError, source::Source, text::printable};

/// Where something is in the file. The text is only made when a finding is kept.
pub(crate) type PlaceFn<'f> = &'f dyn Fn() -> Place;

/// So many control points may a file become, and so many more for each of its bytes: a few weighted curves,
/// or things that refer to others, could else become more than any machine holds.
const LEAST_POINTS: u64 = 1 << 18;
pub(crate) const POINTS_PER_BYTE: u64 = 4;

/// Why a curve has no room.
pub(crate) const POINT_BUDGET_EXCEEDED: &str =
    "too many control points for a file of this size; this curve would exceed the limit";

/// Fills a layout within the limits.
pub(crate) struct Builder<'a> {
    pub(crate) source: Source<'a>,
    pub(crate) layout: Layout,
    /// How many more control points the file may become.
    pub(crate) points_left: u64,
    text_bytes: u64,
    most_text_bytes: u64,
    file_bytes: u64,
    /// How much of the file is read, for readers that go through it once.
    read_bytes: u64,
}

/// Which table an attribute belongs to.
#[derive(Clone, Copy)]
pub(crate) enum Table {
    Paths,
    Nodes,
    Stations,
}

impl<'a> Builder<'a> {
    pub(crate) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        let mut layout = Layout {
            diagnostics: Diagnostics::with_limit(source.options.limits.diagnostics_per_code),
            ..Layout::default()
        };
        source.name.clone_into(&mut layout.provenance.source);
        Self {
            source,
            layout,
            points_left: LEAST_POINTS + file_bytes as u64 * POINTS_PER_BYTE,
            text_bytes: 0,
            most_text_bytes: most_text(file_bytes as u64),
            file_bytes: file_bytes as u64,
            read_bytes: 0,
        }
    }

    /// So many more bytes of the file are read. Tells whoever follows now and then.
    pub(crate) fn advance(&mut self, bytes: usize) -> Result<(), ReadError> {
        const STEP: u64 = 1 << 20;
        let before = self.read_bytes / STEP;
        self.read_bytes += bytes as u64;
        if self.read_bytes / STEP == before {
            return Ok(());
        }
        if let Some(progress) = self.source.options.progress {
            progress.advance(self.read_bytes, self.file_bytes.max(self.read_bytes));
        }
        self.source.check_cancelled()
    }

    /// Records a finding.
    pub(crate) fn report(
        &mut self,
        code: Code,
        at: PlaceFn<'_>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let at = || {
            let mut place = at();
            place.element = printable(&place.element);
            place
        };
        let message = || printable(&message());
        self.layout.diagnostics.push(code, at, message, remedy);
    }

    /// Appends a path and returns its row.
    pub(crate) fn push_path(&mut self, path: &NewPath<'_>) -> Result<usize, ReadError> {
        self.charge_text(path.id)?;
        let limits = &self.source.options.limits;
        let geometry = self.layout.paths.geometry();
        let points = geometry.point_count() + path.runs.points().len();
        self.check("control points", limits.control_points, points as u64)?;
        self.check_paths()?;
        let points = path.runs.points().len() as u64;
        self.points_left = self.points_left.saturating_sub(points);
        Ok(self.layout.paths.push(path))
    }

    /// Whether a curve fits into what the file may become. From the first that does not, none does: looking
    /// for one that still fits could take for ever.
    pub(crate) fn within_point_budget(&mut self, runs: &Runs) -> bool {
        let fits = self.points_left > 0 && runs.points().len() as u64 <= self.points_left;
        if !fits {
            self.points_left = 0;
        }
        fits
    }

    /// Whether a curve can be drawn: no part of it is beyond the largest coordinate, or not finite.
    pub(crate) fn within_coordinate_limit(&self, runs: &Runs) -> bool {
        let most = self.source.options.limits.coordinate_m;
        let mut points = runs.points().iter();
        points.all(|p| p.x.abs() <= most && p.y.abs() <= most)
    }

    /// Records a path that cannot be drawn.
    pub(crate) fn refuse(&mut self, id: &str, code: Code, detail: &str) -> Result<(), ReadError> {
        let detail = &printable(detail);
        self.charge_text(id)?;
        self.charge_text(detail)?;
        self.check_paths()?;
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
        self.charge_text(id)?;
        Ok(self.layout.nodes.push(id, position_m, level))
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
        Ok(self.layout.stations.push(id, position_m, nodes, level))
    }

    /// Sets an attribute of a row.
    pub(crate) fn set(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        value: Value<'_>,
    ) -> Result<(), ReadError> {
        if let Value::Text(text) = value {
            self.charge_text(text)?;
        }
        self.attributes(table).set(row, name, value);
        Ok(())
    }

    /// The attributes of a table.
    pub(crate) fn attributes(&mut self, table: Table) -> &mut Attributes {
        match table {
            Table::Paths => &mut self.layout.paths.attributes,
            Table::Nodes => &mut self.layout.nodes.attributes,
            Table::Stations => &mut self.layout.stations.attributes,
        }
    }

    /// Whether a point can be drawn; says so if not.
    pub(crate) fn check_point(&mut self, point: Point<f64>, at: PlaceFn<'_>) -> bool {
        let limit = self.source.options.limits.coordinate_m;
        if !point.is_finite() {
            let message = || format!("the position ({}, {}) is not finite", point.x, point.y);
            self.report(Code::NonFinite, at, message, "Correct the position");
            return false;
        }
        if point.x.abs().max(point.y.abs()) > limit {
            let message = || {
                let [x, y] = [point.x, point.y].map(short);
                format!("the position ({x} m, {y} m) is beyond {limit} m")
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

    /// Refuses a text that is longer than any name should be.
    pub(crate) fn check_text(&self, text: &str) -> Result<(), ReadError> {
        let limit = self.source.options.limits.text_bytes as u64;
        self.check("bytes in one text", limit, text.len() as u64)
    }

    /// Refuses a curve of more points or knots than any curve should have.
    pub(crate) fn check_curve_points(&self, count: usize) -> Result<(), ReadError> {
        let limit = self.source.options.limits.curve_points as u64;
        self.check("control points or knots of one curve", limit, count as u64)
    }

    fn charge_text(&mut self, text: &str) -> Result<(), ReadError> {
        self.text_bytes += text.len() as u64;
        let what = "bytes of names and attributes";
        self.check(what, self.most_text_bytes, self.text_bytes)
    }

    fn check_paths(&self) -> Result<(), ReadError> {
        let paths = self.layout.path_count() as u64 + 1;
        if paths.is_multiple_of(1024) {
            self.source.check_cancelled()?;
        }
        self.check("paths", self.source.options.limits.paths, paths)
    }

    fn check(&self, what: &'static str, limit: u64, actual: u64) -> Result<(), ReadError> {
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

/// A number, by its exponent where its digits would fill the line.
fn short(number: f64) -> String {
    if number.abs() < 1e15 {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}

/// Most text that a file of this size may become. Names and reasons that a reader makes up are longer
/// than what they are made from, but not without end; and no column can overflow.
fn most_text(file_bytes: u64) -> u64 {
    let most = file_bytes.saturating_mul(64).saturating_add(1 << 20);
    most.min(TextColumn::MAX_BYTES as u64)
}
