//! Reads a level: YAML in; vertices, measurements and fiducials in file units out.

use guideway_layout::{Code, Place};
use guideway_spline::Point;

use crate::ReadError;
use crate::builder::{Builder, PlaceFn};
use crate::yaml::YamlNode;

/// A level, with positions in the unit of the file.
pub(super) struct Level<'y> {
    pub(super) name: &'y str,
    pub(super) content: YamlNode<'y>,
    /// Position per vertex; `None` for a malformed vertex.
    pub(super) positions: Vec<Option<Point<f64>>>,
    pub(super) measurements: Vec<Measurement>,
    /// Name and position of every alignment mark.
    pub(super) fiducials: Vec<(&'y str, Point<f64>)>,
}

/// A measured distance between two vertices.
pub(super) struct Measurement {
    pub(super) ends: [usize; 2],
    pub(super) distance_m: f64,
    pub(super) line: u32,
}

impl<'y> Level<'y> {
    /// Reads a level. Reports malformed elements as findings.
    ///
    /// # Errors
    /// When the name exceeds the text limit.
    pub(super) fn read(
        builder: &mut Builder<'_>,
        name: &'y str,
        content: YamlNode<'y>,
    ) -> Result<Self, ReadError> {
        builder.check_text(name)?;
        if !content.is_map() {
            let at: PlaceFn<'_> = &|| Place::on_line(format!("levels.{name}"), content.line());
            let message = || format!("expected an object, found {}", content.kind());
            let remedy = "The level is empty; give it vertices and lanes";
            builder.report(Code::WrongType, at, message, remedy);
        }
        let mut level = Self {
            name,
            content,
            positions: Vec::new(),
            measurements: Vec::new(),
            fiducials: Vec::new(),
        };
        for (index, vertex) in level.list(builder, "vertices").enumerate() {
            let position = position(vertex);
            if position.is_none() {
                let at: PlaceFn<'_> = &|| level.item_place("vertices", index, vertex);
                let kind = vertex.kind();
                let message = || format!("expected a list that begins with x and y, found {kind}");
                let remedy = "Write it as [x, y, ...]; lanes that end there are not drawn";
                builder.report(Code::MissingField, at, message, remedy);
            }
            level.positions.push(position);
        }
        for measured in level.list(builder, "measurements") {
            let distance = measured.item(2).and_then(|p| p.get("distance"));
            level.measurements.push(Measurement {
                ends: ends(measured).unwrap_or([usize::MAX; 2]),
                distance_m: distance
                    .and_then(|d| d.item(1))
                    .and_then(YamlNode::number)
                    .unwrap_or(f64::NAN),
                line: measured.line(),
            });
        }
        for fiducial in level.list(builder, "fiducials") {
            let name = fiducial.item(2).and_then(YamlNode::text);
            level.fiducials.extend(name.zip(position(fiducial)));
        }
        Ok(level)
    }

    /// The items of a list of the level. Reports a finding if the value is not a list.
    pub(super) fn list(
        &self,
        builder: &mut Builder<'_>,
        key: &str,
    ) -> impl Iterator<Item = YamlNode<'y>> + use<'y> {
        let found = self.content.get(key);
        // The editor writes an empty list as nothing or as {}.
        let odd =
            found.filter(|f| !f.is_list() && f.entries().next().is_some() || f.value().is_some());
        if let Some(odd) = odd {
            let at: PlaceFn<'_> = &|| self.place(key);
            let message = || format!("expected a list, found {}", odd.kind());
            builder.report(
                Code::WrongType,
                at,
                message,
                "It is left out; make it a list",
            );
        }
        found.into_iter().flat_map(YamlNode::items)
    }

    /// Number of items of a list or an object of the level.
    pub(super) fn count(&self, key: &str) -> u64 {
        let found = self.content.get(key);
        found.map_or(0, |f| (f.items().len() + f.entries().count()) as u64)
    }

    /// The position of a vertex, if it exists and is well-formed.
    pub(super) fn position(&self, vertex: usize) -> Option<Point<f64>> {
        self.positions.get(vertex).copied().flatten()
    }

    /// The place of a value of the level.
    pub(super) fn place(&self, key: &str) -> Place {
        let found = self.content.get(key).unwrap_or(self.content);
        Place::on_line(format!("levels.{}.{key}", self.name), found.line())
    }

    /// The place of an item of a list of the level.
    pub(super) fn item_place(&self, key: &str, index: usize, item: YamlNode<'_>) -> Place {
        Place {
            line: Some(item.line()),
            ..self.place(&format!("{key}[{index}]"))
        }
    }
}

/// The indices of the two vertices of a lane, a wall or a measurement.
pub(super) fn ends(edge: YamlNode<'_>) -> Option<[usize; 2]> {
    let vertex = |index| usize::try_from(edge.item(index)?.text()?.parse::<u64>().ok()?).ok();
    Some([vertex(0)?, vertex(1)?])
}

fn position(list: YamlNode<'_>) -> Option<Point<f64>> {
    Some(Point::new(list.item(0)?.number()?, list.item(1)?.number()?))
}
