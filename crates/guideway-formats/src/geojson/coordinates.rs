//! GeoJSON coordinates: deserializes nested arrays of positions of any depth into one flat list of
//! points.

use std::fmt;

use guideway_spline::Point;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::json::{Field, FromJson};

/// Positions of a geometry, in the unit of the file.
#[derive(Debug, Default)]
pub(crate) struct Coordinates {
    pub(super) points: Vec<Point<f64>>,
    /// End of each line in `points`.
    pub(super) ends: Vec<usize>,
    /// Nesting depth of the positions: 1 for a point, 2 for a line, 3 for several lines.
    pub(super) depth: usize,
    /// Number of values that are not positions, or have another depth than the first position.
    pub(super) invalid: u64,
    /// Number of positions with a third number, the height.
    pub(super) heights: u64,
}

impl Coordinates {
    /// Iterates over the lines.
    pub(super) fn lines(&self) -> impl Iterator<Item = &[Point<f64>]> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.points[start..end])
    }

    /// Reads an array at a depth; returns whether it is a position.
    fn read<'de, A: SeqAccess<'de>>(
        &mut self,
        mut array: A,
        depth: usize,
    ) -> Result<bool, A::Error> {
        let (mut numbers, mut count, mut has_positions) = ([0.0; 2], 0, false);
        while let Some(found) = array.next_element_seed(Item {
            coordinates: self,
            depth,
        })? {
            match found {
                Found::Number(number) => {
                    if let Some(slot) = numbers.get_mut(count) {
                        *slot = number;
                    }
                    count += 1;
                }
                Found::Array { is_position } => has_positions |= is_position,
                Found::Other => self.invalid += 1,
            }
        }
        let is_first = self.points.is_empty() && self.ends.is_empty();
        let is_position = count > 1 && !has_positions && (is_first || depth == self.depth);
        if is_position {
            self.depth = depth;
            self.heights += u64::from(count > 2);
            self.points.push(Point::new(numbers[0], numbers[1]));
        } else if count > 0 {
            self.invalid += 1;
        } else if has_positions {
            self.ends.push(self.points.len());
        }
        Ok(is_position)
    }
}

impl<'de> FromJson<'de> for Coordinates {
    fn from_array<A: SeqAccess<'de>>(array: A) -> Result<Field<Self>, A::Error> {
        let mut all = Self::default();
        if all.read(array, 1)? {
            all.ends.push(all.points.len());
        }
        Ok(Field::Value(all))
    }
}

/// Reads one item of an array at a depth.
struct Item<'c> {
    coordinates: &'c mut Coordinates,
    depth: usize,
}

enum Found {
    Number(f64),
    Array { is_position: bool },
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
        f.write_str("a number or an array")
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

    fn visit_seq<A: SeqAccess<'de>>(self, array: A) -> Result<Found, A::Error> {
        let is_position = self.coordinates.read(array, self.depth + 1)?;
        Ok(Found::Array { is_position })
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
