//! Lifts, which become stations.

use std::collections::HashMap;

use guideway_layout::{Code, Value};
use guideway_spline::Point;

use super::frame::Frame;
use super::level::Level;
use super::site::{Site, place};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::yaml::Item;

impl<'y> Site<'_, 'y> {
    /// Lifts become stations.
    pub(super) fn map_lifts(
        &mut self,
        root: Item<'y>,
        levels: &[Level<'_>],
        frames: &[Frame],
        reference: usize,
    ) -> Result<(), ReadError> {
        let lifts = root.get("lifts");
        if let Some(odd) = lifts.filter(|lifts| !lifts.is_map() && lifts.kind() != "nothing") {
            self.report_type(&|| place("lifts", odd), "an object of lifts", odd);
        }
        let names = levels
            .iter()
            .enumerate()
            .map(|(row, level)| (level.name, row));
        let rows: HashMap<&str, usize> = names.collect();
        for (name, lift) in lifts.into_iter().flat_map(Item::entries) {
            self.builder.check_text(name)?;
            let floor = lift.get("reference_floor_name").and_then(Item::text);
            let floor = floor.and_then(|name| rows.get(name).copied());
            let given = lift.get("position");
            let x = lift
                .get("x")
                .or_else(|| given?.item(0))
                .and_then(Item::number);
            let y = lift
                .get("y")
                .or_else(|| given?.item(1))
                .and_then(Item::number);
            let frame = frames.get(floor.unwrap_or(reference));
            let position = x.zip(y).zip(frame);
            let position = position.map(|((x, y), frame)| frame.to_meters(Point::new(x, y)));
            let at: PlaceFn<'_> = &|| place(&format!("lifts.{name}"), lift);
            if position.is_none() {
                let message = || "there is no position".to_owned();
                let remedy = "Give it a place in the editor";
                self.builder.report(Code::MissingField, at, message, remedy);
            }
            let position = position.filter(|&p| self.builder.check_point(p, at));
            let row = self
                .builder
                .push_station(name, position, Vec::new(), None)? as usize;
            let element = Value::Text("lift");
            self.builder.set(Table::Stations, row, "element", element)?;
            for key in ["width", "depth"] {
                if let Some(meters) = lift.get(key).and_then(Item::number) {
                    self.builder
                        .set(Table::Stations, row, key, Value::Float(meters))?;
                }
            }
        }
        Ok(())
    }
}
