//! Encodes journal entries as payload bytes. `decode` is the inverse.

use guideway_layout::{Geometry, OwnStyle, RunPoints, WrittenCurve};
use guideway_scene::{Edit, Insertion, PathState, Table};
use guideway_spline::Point;

use super::entry::JournalEntry;
use super::tag;
use crate::change::Change;

/// The payload of an entry.
pub(super) fn encode(entry: &JournalEntry) -> Vec<u8> {
    let mut out = Encoder::default();
    match entry {
        JournalEntry::Do(changes) => {
            out.byte(tag::DO);
            out.list(changes, |out, change| out.change(change));
        }
        JournalEntry::Try(changes) => {
            out.byte(tag::TRY);
            out.list(changes, |out, change| out.change(change));
        }
        JournalEntry::Undo => out.byte(tag::UNDO),
        JournalEntry::Redo => out.byte(tag::REDO),
    }
    out.0
}

/// Little-endian output.
#[derive(Default)]
pub(super) struct Encoder(Vec<u8>);

impl Encoder {
    pub(super) fn byte(&mut self, value: u8) {
        self.0.push(value);
    }

    pub(super) fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend(bytes);
    }

    pub(super) fn number(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    pub(super) fn point(&mut self, at: Point<f64>) {
        self.0.extend(at.x.to_le_bytes());
        self.0.extend(at.y.to_le_bytes());
    }

    pub(super) fn text(&mut self, text: &str) {
        self.number(text.len() as u32);
        self.0.extend(text.as_bytes());
    }

    pub(super) fn optional(&mut self, value: Option<u32>) {
        self.byte(u8::from(value.is_some()));
        self.number(value.unwrap_or(0));
    }

    pub(super) fn list<T>(&mut self, items: &[T], mut put: impl FnMut(&mut Self, &T)) {
        self.number(items.len() as u32);
        items.iter().for_each(|item| put(self, item));
    }

    fn change(&mut self, change: &Change) {
        match change {
            Change::Scene(edit) => self.edit(edit),
            Change::MoveNodes(nodes) => {
                self.byte(tag::MOVE_NODES);
                self.list(nodes, |out, &(node, at)| {
                    out.number(node);
                    out.point(at);
                });
            }
            Change::Copy(copies) => {
                self.byte(tag::COPY);
                for of in Table::ALL {
                    let rows = copies.elements.rows(of);
                    self.number(rows.len() as u32);
                    rows.iter().for_each(|row| self.number(row));
                }
                self.number(copies.count);
                self.point(copies.step_m);
            }
        }
    }

    fn edit(&mut self, edit: &Edit) {
        match edit {
            Edit::Transform { paths, by } => {
                self.byte(tag::TRANSFORM);
                self.list(paths, |out, &path| out.number(path));
                [by.x, by.y, by.origin]
                    .into_iter()
                    .for_each(|p| self.point(p));
            }
            Edit::Reshape {
                paths,
                curves,
                written,
            } => {
                self.byte(match written.is_empty() {
                    true => tag::RESHAPE,
                    false => tag::RESHAPE_AS_WRITTEN,
                });
                self.list(paths, |out, &path| out.number(path));
                self.geometry(curves);
                if !written.is_empty() {
                    let written: Vec<_> = written.iter().collect();
                    self.list(&written, |out, (place, curve)| {
                        out.number(*place as u32);
                        out.written_curve(curve);
                    });
                }
            }
            Edit::Restyle(styles) => {
                self.byte(tag::RESTYLE);
                self.list(styles, |out, &(path, style)| {
                    out.number(path);
                    out.style(style);
                });
            }
            Edit::SetStates(states) => {
                self.byte(tag::SET_STATES);
                self.list(states, |out, &(path, state)| {
                    out.number(path);
                    out.byte(match state {
                        PathState::Shown => 0,
                        PathState::Hidden => 1,
                        PathState::Removed => 2,
                    });
                });
            }
            Edit::Insert(paths) => {
                let is_plain = |path: &Insertion| path.rank.is_none() && path.written.is_none();
                if paths.iter().all(is_plain) {
                    self.byte(tag::INSERT);
                    self.list(paths, Self::insertion);
                } else {
                    self.byte(tag::INSERT_AS_WRITTEN);
                    self.list(paths, |out, path| {
                        out.insertion(path);
                        out.optional(path.rank.map(i32::cast_unsigned));
                        out.byte(u8::from(path.written.is_some()));
                        if let Some(curve) = &path.written {
                            out.written_curve(curve);
                        }
                    });
                }
            }
            Edit::Tables(edit) => {
                self.byte(tag::TABLES);
                self.tables(edit);
            }
        }
    }

    fn insertion(&mut self, path: &Insertion) {
        self.text(&path.id);
        self.number(path.runs.len() as u32);
        for run in path.runs.iter() {
            self.list(run, |out, &point| out.point(point));
        }
        self.optional(path.start_node);
        self.optional(path.end_node);
        self.direction(path.direction);
        self.optional(path.level);
        self.list(&path.vehicle_types, |out, name| out.text(name));
        self.style(path.style);
        self.optional(path.attributes_of);
    }

    fn style(&mut self, style: OwnStyle) {
        self.optional(style.width_m.map(f32::to_bits));
        self.optional(style.color_rgba);
    }

    fn written_curve(&mut self, curve: &WrittenCurve) {
        self.number(curve.degree);
        self.numbers(&curve.knots);
        self.list(&curve.points_m, |out, &point| out.point(point));
        self.byte(u8::from(curve.weights.is_some()));
        self.numbers(curve.weights.as_deref().unwrap_or_default());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        self.list(numbers, |out, number| out.bytes(&number.to_le_bytes()));
    }

    fn geometry(&mut self, curves: &Geometry) {
        self.number(curves.path_count() as u32);
        for path in 0..curves.path_count() {
            let runs = curves.runs(path);
            self.number(runs.len() as u32);
            for run in runs {
                let points: Vec<_> = RunPoints::iter(run).collect();
                self.list(&points, |out, &point| out.point(point));
            }
        }
    }
}
