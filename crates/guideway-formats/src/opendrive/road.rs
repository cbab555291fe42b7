//! From roads to a layout.

use guideway_layout::{Code, Direction, Layout, NewPath, Place, Value};
use guideway_spline::{Point, Runs};
use roxmltree::Node;

use super::fit::Stretch;
use super::lanes::{Section, offsets, sections};
use super::polynomial::Piecewise;
use super::reference::Line;
use crate::ReadError;
use crate::builder::{Builder, POINT_BUDGET_EXCEEDED, PlaceFn, Table};
use crate::source::Source;
use crate::xml::{Xml, child, children};

/// Stretches shorter than this are rounding of the tool that wrote the file, in meters.
const SHORT_M: f64 = 1e-9;

/// What stands beside roads, and a picture of paths does not show.
const NOT_DRAWN: [(&str, &str); 4] = [
    ("objects", "object"),
    ("signals", "signal"),
    ("objects", "bridge"),
    ("objects", "tunnel"),
];

/// Fills a layout from roads.
pub(super) struct Mapper<'a, 'd, 't> {
    pub(super) builder: Builder<'a>,
    pub(super) xml: &'d Xml<'t>,
    /// How many lines of the plan view there are of each shape.
    pub(super) shapes: [(&'static str, u64); 5],
    lanes: u64,
}

/// What the lanes of a road have in common.
struct Road<'d, 't> {
    node: Node<'d, 't>,
    id: &'d str,
    lines: Vec<Line>,
    offsets: Piecewise,
    is_left_hand: bool,
}

impl<'a, 'd, 't> Mapper<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            xml,
            shapes: ["line", "arc", "spiral", "poly3", "paramPoly3"].map(|name| (name, 0)),
            lanes: 0,
        }
    }

    pub(super) fn map(mut self, root: Node<'d, 't>) -> Result<Layout, ReadError> {
        let roads = || children(root, "road");
        for road in roads() {
            self.map_road(road)?;
        }
        for (list, tag) in NOT_DRAWN {
            let lists = roads().flat_map(|road| children(road, list));
            let count = lists.flat_map(|list| children(list, tag)).count();
            if count > 0 {
                let at: PlaceFn<'_> = &|| Place::element(list);
                let remedy = "They are left out: what is read are the lanes of roads";
                let message = || format!("elements <{tag}>: {count}");
                self.builder.report(Code::NotDrawn, at, message, remedy);
            }
        }
        let header = child(root, "header");
        let revision = |key| header.and_then(|h| h.attribute(key)).unwrap_or("?");
        let version = format!("{}.{}", revision("revMajor"), revision("revMinor"));
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::OpenDrive
            .name()
            .clone_into(&mut provenance.format);
        provenance.format_version = version.chars().take(16).collect();
        let mut counts = vec![
            ("roads", roads().count() as u64),
            ("junctions", children(root, "junction").count() as u64),
            ("lanes", self.lanes),
        ];
        counts.extend(self.shapes);
        let counts = counts
            .into_iter()
            .map(|(name, count)| (name.to_owned(), count));
        provenance.counts = counts.collect();
        Ok(self.builder.layout)
    }

    fn map_road(&mut self, node: Node<'d, 't>) -> Result<(), ReadError> {
        let id = node.attribute("id").unwrap_or_default();
        self.builder.check_text(id)?;
        let mut lines = Vec::new();
        let plan = children(node, "planView");
        for geometry in plan.flat_map(|plan| children(plan, "geometry")) {
            lines.extend(self.line(geometry));
        }
        lines.sort_by(|a: &Line, b| a.start_m.total_cmp(&b.start_m));
        let offsets = offsets(self, child(node, "lanes"));
        let sections = sections(self, node)?;
        let road = Road {
            node,
            id,
            lines,
            offsets,
            is_left_hand: node.attribute("rule") == Some("LHT"),
        };
        if sections.is_empty() {
            let message = || "the road has no lanes".to_owned();
            self.report(Code::NotDrawn, node, message, "Give it a lane section");
        }
        let ends = sections.iter().skip(1).map(|next| next.start_m);
        let road_end_m = road
            .lines
            .iter()
            .map(Line::end_m)
            .fold(f64::NEG_INFINITY, f64::max);
        for (index, (section, end_m)) in sections.iter().zip(ends.chain([road_end_m])).enumerate() {
            self.map_section(&road, index, section, end_m.min(road_end_m))?;
        }
        Ok(())
    }

    fn map_section(
        &mut self,
        road: &Road<'d, 't>,
        index: usize,
        section: &Section<'d, 't>,
        end_m: f64,
    ) -> Result<(), ReadError> {
        let mut cuts = vec![section.start_m, end_m];
        let lines = road.lines.iter();
        cuts.extend(lines.flat_map(|line| [line.start_m, line.end_m()]));
        cuts.extend(road.offsets.starts().chain(section.starts()));
        cuts.retain(|&s| (section.start_m..=end_m).contains(&s));
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < SHORT_M);
        // Every lane is a curve or more for every cut: lists of both could be very many together.
        let pieces = (cuts.len() as u64).saturating_mul(section.lanes.len() as u64);
        let mut stretches: Vec<Vec<Stretch<'_>>> = vec![Vec::new(); section.lanes.len()];
        if pieces <= self.builder.points_left {
            for cut in cuts.windows(2) {
                let middle_m = 0.5 * (cut[0] + cut[1]);
                let after = road.lines.partition_point(|line| line.start_m <= middle_m);
                let line = after.checked_sub(1).map(|i| &road.lines[i]);
                let Some(line) = line.filter(|line| middle_m <= line.end_m()) else {
                    continue;
                };
                let middle = road.offsets.from(cut[0]);
                let centers = section.centers(middle, cut[0]);
                for (stretches, offset) in stretches.iter_mut().zip(centers) {
                    stretches.push(Stretch {
                        line,
                        start_m: cut[0] - line.start_m,
                        length_m: cut[1] - cut[0],
                        offset,
                    });
                }
            }
        } else {
            self.builder.points_left = 0;
        }
        for (lane, stretches) in section.lanes.iter().zip(&stretches) {
            self.lanes += 1;
            if section.shows(lane) {
                let id = format!("{}.{index}.{}", road.id, lane.id);
                self.map_lane(road, &id, lane.node, lane.id, stretches)?;
            }
        }
        Ok(())
    }

    fn map_lane(
        &mut self,
        road: &Road<'d, 't>,
        id: &str,
        lane: Node<'d, 't>,
        number: i64,
        stretches: &[Stretch<'_>],
    ) -> Result<(), ReadError> {
        let mut runs = Runs::default();
        let tolerance_m = self.builder.source.options.limits.conversion_tolerance_m;
        let mut error_m = 0.0_f64;
        for stretch in stretches {
            let most = self.builder.points_left;
            error_m = error_m.max(stretch.append(tolerance_m, most, &mut runs));
            if runs.points().len() as u64 > most {
                break;
            }
        }
        let refused = if !self.builder.within_point_budget(&runs) {
            Some((Code::Implausible, POINT_BUDGET_EXCEEDED))
        } else if runs.is_empty() {
            Some((
                Code::MissingField,
                "the road has no reference line along it",
            ))
        } else if !runs.points().iter().all(|p| p.is_finite()) {
            Some((
                Code::NonFinite,
                "the reference line stops, or its numbers are too large to compute with",
            ))
        } else if !self.builder.within_coordinate_limit(&runs) {
            Some((Code::OutOfRange, "it goes beyond the largest coordinate"))
        } else {
            None
        };
        if let Some((code, detail)) = refused {
            let remedy = "It is left out; correct the road in the tool that wrote the file";
            self.report(code, lane, || detail.to_owned(), remedy);
            return self.builder.refuse(id, code, detail);
        }
        if error_m > tolerance_m {
            let message =
                || format!("the curve is drawn within {error_m} m, not within {tolerance_m} m");
            let remedy = "The reference line stops or is very bent there; look whether it is right";
            self.report(Code::ApproximateShape, lane, message, remedy);
        }
        // Traffic keeps to one side: what is on the other side comes toward.
        if (number > 0) != road.is_left_hand && number != 0 {
            runs = reversed(&runs);
        }
        let row = self.builder.push_path(&NewPath {
            id,
            runs: &runs,
            direction: match number {
                0 => Direction::Both,
                _ => Direction::Forward,
            },
            ..NewPath::default()
        })?;
        let kind = lane.attribute("type").unwrap_or("none");
        for (name, value) in [
            ("type", Some(kind)),
            ("road", road.node.attribute("name")),
            (
                "junction",
                road.node.attribute("junction").filter(|&j| j != "-1"),
            ),
        ] {
            if let Some(value) = value.filter(|value| !value.is_empty()) {
                self.builder.check_text(value)?;
                self.builder
                    .set(Table::Paths, row, name, Value::Text(value))?;
            }
        }
        Ok(())
    }

    /// Refuses a lane that cannot be told from others.
    pub(super) fn refuse_lane(
        &mut self,
        lane: Node<'d, 't>,
        detail: &str,
    ) -> Result<(), ReadError> {
        self.lanes += 1;
        let remedy = "It is left out; correct the file";
        self.report(Code::MissingField, lane, || detail.to_owned(), remedy);
        let id = self.xml.place(lane).to_string();
        self.builder.refuse(&id, Code::MissingField, detail)
    }

    /// A finite number. Says so if there is none.
    pub(super) fn number(&mut self, node: Node<'d, 't>, key: &'static str) -> Option<f64> {
        let text = node.attribute(key);
        let number = text.and_then(|text| text.trim().parse::<f64>().ok());
        if let Some(number) = number.filter(|n| n.is_finite()) {
            return Some(number);
        }
        let (code, message) = match text {
            None => (Code::MissingField, format!("there is no `{key}`")),
            Some(text) => (Code::WrongType, {
                let start: String = text.chars().take(40).collect();
                format!("{key} is \"{start}\", a finite number was expected")
            }),
        };
        let remedy = "What depends on it is left out; correct the number";
        self.report(code, node, || message, remedy);
        None
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
}

/// The same curve from its end to its start.
fn reversed(runs: &Runs) -> Runs {
    let mut reversed = Runs::default();
    let all: Vec<&[Point<f64>]> = runs.iter().collect();
    for run in all.into_iter().rev() {
        let points: Vec<Point<f64>> = run.iter().rev().copied().collect();
        reversed.push(&points);
    }
    reversed
}
