//! Edits of several levels and vehicle types at once: set facts, delete, copy.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use guideway_layout::{Level, Value, VehicleType};
use guideway_scene::TableEdit;

use super::error::OperationError;
use super::levels::{LevelContent, LevelFacts};
use super::vehicle_types::{TypeUse, set_name};
use crate::PathSet;
use crate::document::Document;
use crate::elements::Elements;

/// A fact of a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LevelFact<'a> {
    /// Its identifier.
    Id(&'a str),
    /// Its name for people; an empty one is none.
    Name(&'a str),
    /// Its height above the ground, in meters.
    Elevation(Option<f64>),
    /// A property by its name; `None` removes it.
    Property(&'a str, Option<Value<'a>>),
}

impl Document {
    /// Sets one fact of several levels.
    ///
    /// # Errors
    /// As [`Self::change_level`]; nothing is changed then.
    pub fn set_level_fact(
        &mut self,
        levels: &PathSet,
        fact: LevelFact<'_>,
    ) -> Result<(), OperationError> {
        self.together("change level", |document| {
            levels.iter().try_for_each(|row| {
                let level = document.known_level(row)?;
                let (name, elevation_m) = (level.name.clone(), level.elevation_m);
                let present = LevelFacts {
                    name: name.as_deref(),
                    elevation_m,
                    ..LevelFacts::default()
                };
                let property;
                let facts = match fact {
                    LevelFact::Id(id) => LevelFacts {
                        id: Some(id),
                        ..present
                    },
                    LevelFact::Name(name) => LevelFacts {
                        name: Some(name),
                        ..present
                    },
                    LevelFact::Elevation(elevation_m) => LevelFacts {
                        elevation_m,
                        ..present
                    },
                    LevelFact::Property(name, value) => {
                        property = [(name, value)];
                        LevelFacts {
                            properties: &property,
                            ..present
                        }
                    }
                };
                document.change_level(row, &facts)
            })
        })
    }

    /// Sets a property that several vehicle types have everywhere; `None` removes it.
    ///
    /// # Errors
    /// As [`Self::change_vehicle_type`]; nothing is changed then.
    pub fn set_type_property(
        &mut self,
        names: &BTreeSet<String>,
        property: &str,
        value: Option<Value<'_>>,
    ) -> Result<(), OperationError> {
        self.together("change vehicle type", |document| {
            let mut names = names.iter();
            names
                .try_for_each(|name| document.change_vehicle_type(name, name, &[(property, value)]))
        })
    }

    /// Deletes elements, vehicle types and levels in one step, with the paths of the nodes.
    /// `content` is the fate of what is on the levels, `uses` that of the entries of the types.
    ///
    /// # Errors
    /// As [`Self::delete_level`] and [`Self::delete_vehicle_type`]; nothing is changed then.
    pub fn delete_all(
        &mut self,
        all: &Elements,
        content: LevelContent,
        uses: TypeUse<'_>,
    ) -> Result<(), OperationError> {
        self.check_exist(all)?;
        self.together("delete", |document| {
            document.perform("delete", document.deletion_with_paths(all))?;
            for name in &all.vehicle_types {
                document.delete_vehicle_type(name, uses)?;
            }
            // From the last one on, so that the rows before it stay.
            let levels: Vec<u32> = all.levels.iter().collect();
            for (number, &level) in levels.iter().enumerate().rev() {
                let content = match content {
                    LevelContent::MoveTo(Some(to)) => {
                        let gone = levels[number + 1..].iter().filter(|row| **row < to);
                        LevelContent::MoveTo(Some(to - gone.count() as u32))
                    }
                    other => other,
                };
                document.delete_level(level, content)?;
            }
            Ok(())
        })
    }

    /// Adds copies of levels of another layout, or of this one, after the last level. Names that
    /// are taken get numbers. Returns their rows.
    pub(super) fn copy_levels(&mut self, levels: &[Level]) -> Result<Vec<u32>, OperationError> {
        let first = self.layout().levels.len() as u32;
        let present = &self.layout().levels;
        let mut ids: HashSet<String> = present.iter().map(|level| level.id.clone()).collect();
        let names = present.iter().filter_map(|level| level.name.clone());
        let mut names: HashSet<String> = names.collect();
        let mut changes = Vec::new();
        for (level, row) in levels.iter().zip(first..) {
            let copy = Level {
                id: free_name(&level.id, &mut ids),
                name: level.name.as_ref().map(|name| free_name(name, &mut names)),
                source: None,
                ..level.clone()
            };
            let edit = TableEdit::InsertLevel {
                row,
                level: Arc::new(copy),
                elements: Arc::default(),
            };
            changes.push(edit.into());
        }
        self.perform("copy level", changes)?;
        Ok((first..first + levels.len() as u32).collect())
    }

    /// Adds a copy of a vehicle type. If this document has a type of that name, the copy gets a
    /// number, and every path and node that names the original names the copy too, with the same
    /// properties. Returns its name.
    pub(super) fn copy_type(&mut self, copied: &VehicleType) -> Result<String, OperationError> {
        let names = self.layout().vehicle_type_names().into_iter();
        let mut names: HashSet<String> = names.map(str::to_owned).collect();
        let name = free_name(&copied.id, &mut names);
        let mut changes = match name == copied.id {
            true => Vec::new(),
            false => self.entries_of_copy(&copied.id, &name),
        };
        let mut types = self.layout().vehicle_types.clone();
        let mut copy = copied.clone();
        if name != copied.id {
            set_name(&mut copy, &name);
        }
        types.push(copy);
        changes.push(TableEdit::SetVehicleTypes(types.into()).into());
        self.perform("copy vehicle type", changes)?;
        Ok(name)
    }
}

/// Takes a name, or the first of `NAME 2`, `NAME 3` and so on that is free.
fn free_name(wanted: &str, taken: &mut HashSet<String>) -> String {
    let numbered = (2..).map(|number: u64| format!("{wanted} {number}"));
    let mut names = std::iter::once(wanted.to_owned()).chain(numbered);
    let name = names.find(|name| !taken.contains(name)).unwrap_or_default();
    taken.insert(name.clone());
    name
}
