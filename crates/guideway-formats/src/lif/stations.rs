//! LIF stations: maps a station with its position and the nodes that serve it.

use guideway_spline::Point;

use super::mapper::Mapper;
use super::members::OTHER;
use super::model::Station;
use super::type_entries::{ColumnCell, other_cell};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{LazyItem, OtherMembers, field_place, items};

impl Mapper<'_> {
    /// Maps a station.
    pub(super) fn map_station(
        &mut self,
        item: &LazyItem<'_, Station<'_>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.counts.stations += 1;
        let Some(station) = self.builder.record(&item.record, at) else {
            return Ok(());
        };
        self.builder.check_repeated(station.repeated, at);
        self.builder
            .check_array(&station.nodes, at, "interactionNodeIds");
        let id = self.builder.id(&station.id, at, "stationId")?;
        let mut nodes = Vec::new();
        for (i, name) in items(&station.nodes) {
            let at_name: PlaceFn<'_> = &|| field_place(at, &format!("interactionNodeIds[{i}]"));
            let Some(name) = self.builder.text(name, at_name)? else {
                continue;
            };
            match self.node(name, level) {
                Some(row) => nodes.push(row),
                None => self.builder.report_unknown_node(name, &id, at_name),
            }
        }
        let mut other = OtherMembers::default();
        let mut cells = Vec::new();
        let position = self.station_position(station, &mut cells, &mut other, at)?;
        let row = self
            .builder
            .push_station(&id, position, nodes, Some(level))? as usize;
        cells.extend(self.cells(&station.attributes, &self.columns.station, &mut other, at)?);
        cells.extend(other_cell(other, OTHER));
        for cell in &cells {
            cell.set(self, Table::Stations, row)?;
        }
        Ok(())
    }

    /// Returns the position of a station; adds its orientation to the cells.
    fn station_position<'f>(
        &mut self,
        station: &Station<'f>,
        cells: &mut Vec<ColumnCell<'f>>,
        other: &mut OtherMembers,
        at: PlaceFn<'_>,
    ) -> Result<Option<Point<f64>>, ReadError> {
        let at: PlaceFn<'_> = &|| field_place(at, "stationPosition");
        if station.position.is_absent() {
            return Ok(None);
        }
        let Some(position) = self.builder.record(&station.position, at) else {
            return Ok(None);
        };
        self.builder.check_repeated(position.repeated, at);
        let mut nested = OtherMembers::default();
        let columns = &self.columns.station_position;
        cells.extend(self.cells(&position.attributes, columns, &mut nested, at)?);
        if let Some(text) = nested.into_text() {
            other.add(None, "stationPosition", &text);
        }
        Ok(self.builder.point(&position.x, &position.y, at))
    }
}
