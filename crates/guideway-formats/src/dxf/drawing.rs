//! What a drawing says before its entities: unit, layers, blocks; and where the entities are.

use std::cell::Cell;
use std::collections::HashMap;

use guideway_layout::{Code, Limits};

use super::entity::{Entity, Insert, Polyline, Shape, Vertex, known_kind, plane, shape};
use super::records::{Record, Records};
use super::space::{Affine, Vector};
use super::style::{Layers, decoded};
use crate::Problem;

/// Most kinds of entities that are counted by name.
const MOST_KINDS: usize = 64;

#[derive(Default)]
pub(super) struct Drawing<'b> {
    /// Such as AC1015, empty if the file does not say.
    pub(super) version: String,
    /// Group 70 of `$INSUNITS`.
    pub(super) unit: i64,
    pub(super) layers: Layers,
    pub(super) blocks: Vec<Block<'b>>,
    block_rows: HashMap<String, u32>,
    /// Where each section of entities begins.
    pub(super) entities: Vec<Records<'b>>,
    /// How many records there are of each kind within blocks.
    pub(super) counts: Counts,
}

/// Entities that are put into the drawing by references.
#[derive(Default)]
pub(super) struct Block<'b> {
    pub(super) base: Option<Vector>,
    pub(super) entities: Vec<Entity<'b>>,
    /// How many entities it stands for, once that was asked for.
    count: Cell<Option<u64>>,
}

/// Numbers of records by kind, in the order of the file.
#[derive(Default)]
pub(super) struct Counts(pub(super) Vec<(String, u64)>);

impl Counts {
    /// Counts a record. Vertices that follow their POLYLINE are counted with it.
    pub(super) fn add(&mut self, kind: &[u8]) {
        match kind {
            b"SEQEND" => {}
            b"VERTEX" => self.count("VERTEX without POLYLINE"),
            _ => {
                let name: String = decoded(kind).chars().take(32).collect();
                self.count(&name);
            }
        }
    }

    fn count(&mut self, name: &str) {
        let name = match self.0.len() {
            MOST_KINDS.. if self.0.iter().all(|(known, _)| known != name) => "others",
            _ => name,
        };
        match self.0.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => self.0.push((name.to_owned(), 1)),
        }
    }
}

impl<'b> Drawing<'b> {
    /// Reads everything but the entities of the drawing itself.
    pub(super) fn read(bytes: &'b [u8], limits: &Limits) -> Result<Self, Problem> {
        let mut drawing = Self::default();
        let mut records = Records::new(bytes, limits);
        let mut record = Record::default();
        loop {
            if !records.read(&mut record, |kind, _| kind == b"SECTION")? {
                return Err(no_end(bytes));
            }
            let section = match record.kind {
                b"EOF" => return Ok(drawing),
                b"SECTION" => record.text(2).unwrap_or_default(),
                _ => continue,
            };
            match section {
                b"HEADER" => drawing.read_header(&record),
                b"TABLES" => drawing.read_tables(&mut records, &mut record)?,
                b"BLOCKS" => drawing.read_blocks(&mut records, &mut record)?,
                b"ENTITIES" => drawing.entities.push(records),
                _ => {}
            }
        }
    }

    /// The header has no records: names of variables, each with its value after it.
    fn read_header(&mut self, record: &Record<'b>) {
        for pair in record.pairs.windows(2).filter(|pair| pair[0].code == 9) {
            match pair[0].text() {
                b"$ACADVER" => self.version = decoded(pair[1].text()),
                b"$INSUNITS" => self.unit = pair[1].whole().unwrap_or(0),
                _ => {}
            }
        }
    }

    fn read_tables(
        &mut self,
        records: &mut Records<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        while section_goes_on(records) && records.read(record, |kind, _| kind == b"LAYER")? {
            if record.kind == b"LAYER" {
                self.layers.define(record);
            }
        }
        Ok(())
    }

    fn read_blocks(
        &mut self,
        records: &mut Records<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        // What comes before any block is in none.
        let mut current = Block::default();
        let mut row = None;
        let mut counts = std::mem::take(&mut self.counts);
        let wanted = |kind: &[u8], _| kind == b"BLOCK" || known_kind(kind).is_some();
        while section_goes_on(records) && records.read(record, wanted)? {
            match record.kind {
                b"BLOCK" => {
                    let name = record.text(2).unwrap_or_default();
                    row = Some(self.block_row(name));
                    current.base = Some(record.vector(10).unwrap_or(Vector::ZERO));
                }
                b"ENDBLK" => {
                    let block = std::mem::take(&mut current);
                    if let Some(row) = row.take() {
                        self.blocks[row as usize] = block;
                    }
                }
                kind => {
                    counts.add(kind);
                    let entity = self.entity(records, record, &mut counts)?;
                    current.entities.extend(entity);
                }
            }
        }
        self.counts = counts;
        Ok(())
    }

    /// The row of a block; it is empty until it is defined. Upper and lower case are one.
    fn block_row(&mut self, name: &[u8]) -> u32 {
        let key = decoded(name).to_uppercase();
        if let Some(&row) = self.block_rows.get(&key) {
            return row;
        }
        let row = self.blocks.len() as u32;
        self.blocks.push(Block::default());
        self.block_rows.insert(key, row);
        row
    }

    /// The entity of a record, if it is a curve or a reference. Reads the vertices after a POLYLINE too.
    pub(super) fn entity(
        &mut self,
        records: &mut Records<'b>,
        record: &mut Record<'b>,
        counts: &mut Counts,
    ) -> Result<Option<Entity<'b>>, Problem> {
        let Some(kind) = known_kind(record.kind) else {
            return Ok(None);
        };
        let shape = match kind {
            "INSERT" => self.insert(record),
            "POLYLINE" => {
                // The record is needed for the vertices, so what is in it comes first.
                let flags = record.whole(70).unwrap_or(0);
                let plane = match flags & 8 {
                    0 => plane(record),
                    _ => Affine::scale(1.0, 1.0, 1.0),
                };
                let mut entity = Entity::of(
                    kind,
                    record,
                    &mut self.layers,
                    Shape::Line([Vector::ZERO; 2]),
                );
                let vertices = read_vertices(records, record, counts)?;
                let is_mesh = flags & (16 | 64) != 0;
                entity.shape = match (entity.shape, vertices) {
                    (broken @ Shape::Broken(..), _) | (_, Err(broken)) => broken,
                    _ if is_mesh => {
                        Shape::Broken(Code::NotDrawn, "it is a mesh, not a line".into())
                    }
                    (_, Ok(vertices)) => Shape::Polyline(Box::new(Polyline {
                        plane,
                        vertices,
                        is_closed: flags & 1 != 0,
                    })),
                };
                return Ok(Some(entity));
            }
            other => shape(other, record),
        };
        Ok(Some(Entity::of(kind, record, &mut self.layers, shape)))
    }

    fn insert(&mut self, record: &Record<'b>) -> Shape {
        let block = self.block_row(record.text(2).unwrap_or_default());
        let at = record.vector(10).unwrap_or(Vector::ZERO);
        let scale = [41, 42, 43].map(|code| record.real(code).unwrap_or(1.0));
        let turned = plane(record)
            .after(&Affine::translation(at))
            .after(&Affine::rotation(record.real(50).unwrap_or(0.0)));
        let step = |code| record.real(code).unwrap_or(0.0);
        let cells = |code| {
            record
                .whole(code)
                .unwrap_or(1)
                .clamp(1, i64::from(u32::MAX)) as u32
        };
        Shape::Insert(Box::new(Insert {
            block,
            placed: turned.after(&Affine::scale(scale[0], scale[1], scale[2])),
            steps: [
                turned.direction(Vector::new(step(44), 0.0, 0.0)),
                turned.direction(Vector::new(0.0, step(45), 0.0)),
            ],
            columns: cells(70),
            rows: cells(71),
        }))
    }

    /// How many entities a block stands for, itself and all blocks within it counted; as many as can be if it
    /// is within itself, or blocks are nested more than `depth` deep.
    pub(super) fn count(&self, row: u32, depth: usize) -> u64 {
        let block = &self.blocks[row as usize];
        if let Some(count) = block.count.get() {
            return count;
        }
        // Who meets it again before it is done is within it.
        block.count.set(Some(u64::MAX));
        if depth == 0 {
            return u64::MAX;
        }
        let counts = block.entities.iter();
        let counts = counts.map(|entity| entity.count(|inner| self.count(inner, depth - 1)));
        let sum = counts.fold(1, u64::saturating_add);
        block.count.set(Some(sum));
        sum
    }
}

/// Whether the section has not ended.
pub(super) fn section_goes_on(records: &Records<'_>) -> bool {
    !matches!(records.peek(), None | Some(b"ENDSEC" | b"EOF" | b"SECTION"))
}

type Vertices = Result<Vec<Vertex>, Shape>;

fn read_vertices<'b>(
    records: &mut Records<'b>,
    record: &mut Record<'b>,
    counts: &mut Counts,
) -> Result<Vertices, Problem> {
    const FRAME_OF_SPLINE: i64 = 16;
    let mut vertices = Vec::new();
    let mut bad = None;
    while records.peek() == Some(b"VERTEX") && records.read(record, |_, _| true)? {
        counts.count("VERTEX");
        let position = record.vector(10);
        let bulge = record.real(42).unwrap_or(0.0);
        let flags = record.whole(70).unwrap_or(0);
        bad = bad.or(record.bad.get());
        if let Some(position) = position.filter(|_| flags & FRAME_OF_SPLINE == 0) {
            vertices.push(Vertex { position, bulge });
        }
    }
    Ok(match bad {
        Some(code) => Err(Shape::Broken(
            Code::WrongType,
            format!("the value of group code {code} of a vertex is not a number"),
        )),
        None => Ok(vertices),
    })
}

fn no_end(bytes: &[u8]) -> Problem {
    Problem::Truncated {
        at: bytes.len() as u64,
        detail: "EOF is missing, which every DXF file ends with".into(),
    }
}
