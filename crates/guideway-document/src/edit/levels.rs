//! Creates, changes and deletes levels, and moves elements to a level.

use std::sync::Arc;

use guideway_layout::{ElementKind, Level, Value};
use guideway_scene::{EditError, Table, TableEdit};

use super::error::OperationError;
use super::property_value::set_all;
use crate::change::Change;
use crate::document::Document;
use crate::elements::Elements;

/// Column of the map that a position refers to.
const MAP: &str = "mapId";

/// The fate of the elements of a deleted level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelContent {
    /// The level is only deleted if it has none.
    Keep,
    /// They move to another level; `None` takes them off all levels.
    MoveTo(Option<u32>),
    /// They are deleted too, except zones, which are on no level then.
    Delete,
}

/// Values to set by the names of their properties; `None` removes one.
pub type PropertyValues<'a> = &'a [(&'a str, Option<Value<'a>>)];

/// The identifier, the name for people, the height and properties of a level.
#[derive(Clone, Copy, Debug, Default)]
pub struct LevelFacts<'a> {
    /// Identifier; `None` makes one, or keeps the present one.
    pub id: Option<&'a str>,
    /// Name for people; an empty one is none.
    pub name: Option<&'a str>,
    /// Height above the ground, in meters.
    pub elevation_m: Option<f64>,
    /// Properties to set. The others stay.
    pub properties: PropertyValues<'a>,
}

impl Document {
    /// Creates a level after the last one, and returns its row. Without an identifier it is called
    /// `level`, with a number if that name is taken.
    ///
    /// # Errors
    /// When another level has the identifier, the height is not finite, or a value does not fit.
    pub fn create_level(&mut self, facts: &LevelFacts<'_>) -> Result<u32, OperationError> {
        let is_free = |id: &String| self.layout().levels.iter().all(|level| level.id != *id);
        let numbered = (2..).map(|number: u64| format!("level {number}"));
        let mut names = std::iter::once("level".to_owned()).chain(numbered);
        let id = match facts.id {
            Some(id) => self.free_level_id(id, None)?,
            None => names.find(is_free).unwrap_or_default(),
        };
        let new = Level {
            id,
            ..Level::default()
        };
        let row = self.layout().levels.len() as u32;
        let level = Arc::new(with_facts(new, facts)?);
        let edit = TableEdit::InsertLevel {
            row,
            level,
            elements: Arc::default(),
        };
        self.perform("create level", vec![edit.into()])?;
        Ok(row)
    }

    /// Sets the facts of a level. Elements follow a new identifier, and so do the maps of its nodes
    /// that have it.
    ///
    /// # Errors
    /// When the level does not exist, the identifier is empty or taken, the height is not finite,
    /// or a value does not fit.
    pub fn change_level(
        &mut self,
        level: u32,
        facts: &LevelFacts<'_>,
    ) -> Result<(), OperationError> {
        let before = self.known_level(level)?;
        let renamed = Level {
            id: self.free_level_id(facts.id.unwrap_or(&before.id), Some(level))?,
            ..before.clone()
        };
        let after = with_facts(renamed, facts)?;
        if *before == after {
            return Ok(());
        }
        let mut changes = Vec::new();
        if before.id != after.id {
            let nodes = 0..self.layout().nodes.len() as u32;
            let on_level = |node: &u32| self.layout().nodes.level(*node) == Some(level);
            changes.extend(self.new_maps(nodes.filter(on_level), Some(&after.id)));
        }
        let edit = TableEdit::SetLevel {
            row: level,
            level: Arc::new(after),
        };
        changes.push(edit.into());
        Ok(self.perform("change level", changes)?)
    }

    /// Deletes a level.
    ///
    /// # Errors
    /// When a level does not exist, or this one has elements that are to be kept.
    pub fn delete_level(
        &mut self,
        level: u32,
        content: LevelContent,
    ) -> Result<(), OperationError> {
        let id = self.known_level(level)?.id.clone();
        let elements = self.elements_of_level(level);
        let zones = self.zones_of_level(level);
        let to = match content {
            LevelContent::MoveTo(to) => to,
            LevelContent::Keep | LevelContent::Delete => None,
        };
        let count = Table::ALL
            .map(|of| elements.rows(of).len())
            .iter()
            .sum::<u64>();
        let is_used = count > 0 || !zones.is_empty();
        match (content, to) {
            (LevelContent::Keep, _) if is_used => {
                return Err(OperationError::LevelInUse {
                    level: id,
                    paths: elements.paths.len(),
                    nodes: elements.nodes.len(),
                    stations: elements.stations.len(),
                    zones: zones.len(),
                });
            }
            (_, Some(to)) if to == level => return Err(OperationError::SameLevel { level: id }),
            (_, Some(to)) => drop(self.known_level(to)?),
            _ => {}
        }
        let mut changes = match content {
            LevelContent::Delete => self.deletion_with_paths(&elements),
            LevelContent::Keep | LevelContent::MoveTo(_) => Vec::new(),
        };
        if matches!(content, LevelContent::MoveTo(_)) {
            changes.extend(self.moves_to(&elements, to));
        }
        if !zones.is_empty() {
            let zones = zones.into_iter().map(|zone| (zone, to)).collect();
            changes.push(TableEdit::SetZoneLevels(zones).into());
        }
        changes.push(TableEdit::RemoveLevel(level).into());
        let was_drawn_on = self.level() == Some(level);
        self.perform("delete level", changes)?;
        match was_drawn_on {
            true => self.show_level(None),
            false => self.apply_levels(),
        }
        Ok(())
    }

    fn zones_of_level(&self, level: u32) -> Vec<u32> {
        let zones = self.layout().zones.iter().zip(0..);
        let zones = zones.filter(|(zone, _)| zone.level == Some(level));
        zones.map(|(_, row)| row).collect()
    }

    /// Moves elements to another level. The maps of nodes that have the name of their level follow.
    fn moves_to(&self, elements: &Elements, to: Option<u32>) -> Vec<Change> {
        let mut changes = Vec::new();
        for of in Table::ALL {
            let levels: Arc<[_]> = elements.rows(of).iter().map(|row| (row, to)).collect();
            if !levels.is_empty() {
                changes.push(TableEdit::SetLevels { of, levels }.into());
            }
        }
        let levels = &self.layout().levels;
        let new = to.and_then(|level| Some(levels.get(level as usize)?.id.as_str()));
        changes.extend(self.new_maps(elements.nodes.iter(), new));
        changes
    }

    /// Other maps for the nodes whose map has the name of their level.
    fn new_maps(&self, nodes: impl Iterator<Item = u32>, new: Option<&str>) -> Option<Change> {
        let layout = self.layout();
        let has_map = |node: &u32| {
            let map = layout.nodes.attributes.value(*node as usize, MAP);
            let level = layout.nodes.level(*node);
            let level = level.and_then(|level| layout.levels.get(level as usize));
            level.is_some_and(|level| map == Some(Value::Text(&level.id)))
        };
        let rows: Arc<[u32]> = nodes.filter(has_map).collect();
        let edit = TableEdit::SetValues {
            of: Table::Nodes,
            vehicle_type: None,
            column: MAP.into(),
            quantity: None,
            values: Arc::new([new.map(Value::Text)].into_iter().collect()),
            rows: Arc::clone(&rows),
        };
        (!rows.is_empty()).then(|| edit.into())
    }

    pub(super) fn known_level(&self, level: u32) -> Result<&Level, EditError> {
        let known = self.layout().levels.get(level as usize);
        known.ok_or(EditError::UnknownReference {
            what: "level",
            row: level,
        })
    }

    /// The identifier, if no other level than `own` has it.
    fn free_level_id(&self, id: &str, own: Option<u32>) -> Result<String, OperationError> {
        let what = "level";
        if id.is_empty() {
            return Err(OperationError::EmptyId { what });
        }
        let mut others = self.layout().levels.iter().zip(0..);
        match others.any(|(level, row)| level.id == id && Some(row) != own) {
            true => Err(OperationError::IdTaken {
                what,
                id: id.to_owned(),
            }),
            false => Ok(id.to_owned()),
        }
    }

    /// Moves elements to a level; `None` takes them off all levels. The nodes whose paths all move
    /// go along, and the stations whose nodes all move.
    ///
    /// # Errors
    /// When an element or the level does not exist.
    pub fn set_level(
        &mut self,
        elements: &Elements,
        level: Option<u32>,
    ) -> Result<(), OperationError> {
        self.check_exist(elements)?;
        let nodes = &self.nodes_of_only(&elements.paths) | &elements.nodes;
        let stations = &self.stations_of_only(&nodes) | &elements.stations;
        let moved = Elements {
            paths: elements.paths.clone(),
            nodes,
            stations,
            ..Elements::default()
        };
        let changes = self.moves_to(&moved, level);
        Ok(self.perform("set level", changes)?)
    }
}

fn with_facts(mut level: Level, facts: &LevelFacts<'_>) -> Result<Level, OperationError> {
    level.name = facts
        .name
        .filter(|name| !name.is_empty())
        .map(str::to_owned);
    level.elevation_m = facts.elevation_m;
    set_all(ElementKind::Level, &mut level.attributes, facts.properties)?;
    Ok(level)
}
