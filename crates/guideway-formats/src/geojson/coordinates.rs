//! Lists of positions, however deeply nested, as points in a row.

use std::fmt;

use guideway_spline::Point;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::json::{Field, FromJson};

/// The positions of a geometry, in the file's unit.
#[derive(Debug, Default)]
pub(crate) struct Coordinates {
    pub(super) points: Vec<Point<f64>>,
    /// Where each list of positions ends, in `points`.
    pub(super) ends: Vec<usize>,
    /// How many lists are around the numbers: 1 for a point, 2 for a line, 3 for several lines.
    pub(super) depth: usize,
    /// Positions that are none, or are nested otherwise than the first.
    pub(super) wrong: u64,
    /// Positions with a third number, which is a height.
    pub(super) heights: u64,
}

impl Coordinates {
    /// The lists of positions.
    pub(super) fn lines(&self) -> impl Iterator<Item = &[Point<f64>]> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.points[start..end])
    }

    /// Reads a list at a depth, and tells whether it is a position.
    fn read<'de, A: SeqAccess<'de>>(
        &mut self,
        mut list: A,
        depth: usize,
    ) -> Result<bool, A::Error> {
        let (mut numbers, mut count, mut has_positions) = ([0.0; 2], 0, false);
        while let Some(found) = list.next_element_seed(Item {
            coordinates: self,
            depth,
        })? {
            match found {
                Found::Number(number) => {
                    if let Some(place) = numbers.get_mut(count) {
                        *place = number;
                    }
                    count += 1;
                }
                Found::List { is_position } => has_positions |= is_position,
                Found::Other => self.wrong += 1,
            }
        }
        let first = self.points.is_empty() && self.ends.is_empty();
        let is_position = count > 1 && !has_positions && (first || depth == self.depth);
        if is_position {
            self.depth = depth;
            self.heights += u64::from(count > 2);
            self.points.push(Point::new(numbers[0], numbers[1]));
        } else if count > 0 {
            self.wrong += 1;
        } else if has_positions {
            self.ends.push(self.points.len());
        }
        Ok(is_position)
    }
}

impl<'de> FromJson<'de> for Coordinates {
    fn from_list<A: SeqAccess<'de>>(list: A) -> Result<Field<Self>, A::Error> {
        let mut all = Self::default();
        if all.read(list, 1)? {
            all.ends.push(all.points.len());
        }
        Ok(Field::Value(all))
    }
}

/// Reads one item of a list at a depth.
struct Item<'c> {
    coordinates: &'c mut Coordinates,
    depth: usize,
}

enum Found {
    Number(f64),
    List { is_position: bool },
    Other,
}

impl<'de> DeserializeSeed<'de> for Item<'_> {
    type Value = Found;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Found, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Item<'_> {
    type Value = Found;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a list")
    }

    fn visit_f64<E>(self, number: f64) -> Result<Found, E> {
        Ok(Found::Number(number))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Found, E> {
        Ok(Found::Number(number as f64))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Found, E> {
        Ok(Found::Number(number as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Found, A::Error> {
        let is_position = self.coordinates.read(list, self.depth + 1)?;
        Ok(Found::List { is_position })
    }

    fn visit_bool<E>(self, _: bool) -> Result<Found, E> {
        Ok(Found::Other)
    }

    fn visit_unit<E>(self) -> Result<Found, E> {
        Ok(Found::Other)
    }

    fn visit_str<E>(self, _: &str) -> Result<Found, E> {
        Ok(Found::Other)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Found, A::Error> {
        while object.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Found::Other)
    }
}
