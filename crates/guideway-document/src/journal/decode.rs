//! Decodes journal entries from payload bytes, which may be damaged.

use std::sync::Arc;

use guideway_layout::{Geometry, OwnStyle, WrittenCurve, WrittenCurves};
use guideway_scene::{Edit, Insertion, PathState, Table};
use guideway_spline::{Affine, Point, Runs};

use super::entry::JournalEntry;
use super::tag;
use crate::change::{Change, CopiesOf};
use crate::elements::Elements;

/// The entry of a payload; `None` if the payload is invalid.
pub(super) fn decode(bytes: &[u8]) -> Option<JournalEntry> {
    let mut input = Decoder(bytes);
    let entry = match input.byte()? {
        tag::DO => JournalEntry::Do(input.list(Decoder::change)?),
        tag::TRY => JournalEntry::Try(input.list(Decoder::change)?),
        tag::UNDO => JournalEntry::Undo,
        tag::REDO => JournalEntry::Redo,
        _ => return None,
    };
    input.0.is_empty().then_some(entry)
}

/// The bytes that are left to decode.
pub(super) struct Decoder<'a>(&'a [u8]);

impl Decoder<'_> {
    pub(super) fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }

    pub(super) fn byte(&mut self) -> Option<u8> {
        self.take::<1>().map(|[byte]| byte)
    }

    pub(super) fn number(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    pub(super) fn point(&mut self) -> Option<Point<f64>> {
        let x = f64::from_le_bytes(self.take()?);
        let y = f64::from_le_bytes(self.take()?);
        Some(Point::new(x, y))
    }

    pub(super) fn text(&mut self) -> Option<String> {
        let len = self.number()? as usize;
        let (text, rest) = self.0.split_at_checked(len)?;
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }

    pub(super) fn optional(&mut self) -> Option<Option<u32>> {
        let is_present = self.byte()? != 0;
        let value = self.number()?;
        Some(is_present.then_some(value))
    }

    /// Decodes a list. It grows item by item, and each item consumes bytes: a damaged count cannot
    /// exhaust memory.
    pub(super) fn list<T>(
        &mut self,
        mut item: impl FnMut(&mut Self) -> Option<T>,
    ) -> Option<Vec<T>> {
        let count = self.number()?;
        let mut items = Vec::new();
        for _ in 0..count {
            items.push(item(self)?);
        }
        Some(items)
    }

    pub(super) fn rows(&mut self) -> Option<Arc<[u32]>> {
        self.list(Self::number).map(Arc::from)
    }

    fn change(&mut self) -> Option<Change> {
        let edit = match self.byte()? {
            tag::TRANSFORM => Edit::Transform {
                paths: self.rows()?,
                by: Affine {
                    x: self.point()?,
                    y: self.point()?,
                    origin: self.point()?,
                },
            },
            tag @ (tag::RESHAPE | tag::RESHAPE_AS_WRITTEN) => Edit::Reshape {
                paths: self.rows()?,
                curves: Arc::new(self.geometry()?),
                written: Arc::new(match tag {
                    tag::RESHAPE => WrittenCurves::default(),
                    _ => self.written_curves()?,
                }),
            },
            tag::RESTYLE => {
                let style = |input: &mut Self| Some((input.number()?, input.style()?));
                Edit::Restyle(self.list(style)?.into())
            }
            tag::SET_STATES => {
                let state = |input: &mut Self| Some((input.number()?, input.state()?));
                Edit::SetStates(self.list(state)?.into())
            }
            tag::INSERT => Edit::Insert(self.list(Self::insertion)?.into()),
            tag::INSERT_AS_WRITTEN => {
                let path = |input: &mut Self| {
                    let plain = input.insertion()?;
                    Some(Insertion {
                        rank: input.optional()?.map(u32::cast_signed),
                        written: match input.byte()? {
                            0 => None,
                            _ => Some(Arc::new(input.written_curve()?)),
                        },
                        ..plain
                    })
                };
                Edit::Insert(self.list(path)?.into())
            }
            tag::MOVE_NODES => {
                let node = |input: &mut Self| Some((input.number()?, input.point()?));
                return Some(Change::MoveNodes(self.list(node)?.into()));
            }
            tag::COPY => return Some(Change::Copy(self.copies()?)),
            tag::TABLES => Edit::Tables(self.tables()?),
            _ => return None,
        };
        Some(Change::Scene(edit))
    }

    fn copies(&mut self) -> Option<CopiesOf> {
        let mut elements = Elements::default();
        for of in Table::ALL {
            *elements.rows_mut(of) = self.list(Self::number)?.into_iter().collect();
        }
        Some(CopiesOf {
            elements: Arc::new(elements),
            count: self.number()?,
            step_m: self.point()?,
        })
    }

    fn state(&mut self) -> Option<PathState> {
        match self.byte()? {
            0 => Some(PathState::Shown),
            1 => Some(PathState::Hidden),
            2 => Some(PathState::Removed),
            _ => None,
        }
    }

    fn style(&mut self) -> Option<OwnStyle> {
        Some(OwnStyle {
            width_m: self.optional()?.map(f32::from_bits),
            color_rgba: self.optional()?,
        })
    }

    fn insertion(&mut self) -> Option<Insertion> {
        Some(Insertion {
            id: self.text()?,
            runs: self.runs()?,
            start_node: self.optional()?,
            end_node: self.optional()?,
            direction: self.direction()?,
            level: self.optional()?,
            vehicle_types: self.list(Self::text)?,
            style: self.style()?,
            attributes_of: self.optional()?,
            ..Insertion::default()
        })
    }

    fn runs(&mut self) -> Option<Runs> {
        let mut runs = Runs::default();
        for _ in 0..self.number()? {
            let points = self.points()?;
            if points.len() < 4 {
                return None;
            }
            runs.push(&points);
        }
        Some(runs)
    }

    fn written_curves(&mut self) -> Option<WrittenCurves> {
        let mut curves = WrittenCurves::default();
        for _ in 0..self.number()? {
            let place = self.number()? as usize;
            curves.set(place, Some(self.written_curve()?.into()));
        }
        Some(curves)
    }

    fn written_curve(&mut self) -> Option<WrittenCurve> {
        let (degree, knots, points_m) = (self.number()?, self.numbers()?, self.points()?);
        let has_weights = self.byte()? != 0;
        let weights = self.numbers()?;
        Some(WrittenCurve {
            degree,
            knots,
            points_m,
            weights: has_weights.then_some(weights),
        })
    }

    fn numbers(&mut self) -> Option<Vec<f64>> {
        self.list(|input| input.take().map(f64::from_le_bytes))
    }

    fn points(&mut self) -> Option<Vec<Point<f64>>> {
        self.list(Self::point)
    }

    fn geometry(&mut self) -> Option<Geometry> {
        let mut geometry = Geometry::default();
        for _ in 0..self.number()? {
            geometry.push(&self.runs()?);
        }
        Some(geometry)
    }
}
