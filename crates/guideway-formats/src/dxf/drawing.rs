//! Scans a file once: reads header variables, layers and blocks, and notes the offset of each
//! ENTITIES section. The entities themselves are read later, one at a time.

use std::cell::Cell;
use std::collections::HashMap;

use guideway_layout::{Code, Limits};

use super::affine3::{Affine3, Vector3};
use super::entity::{Entity, Insert, Polyline, Shape, Vertex, known_kind, plane, shape};
use super::entity_counts::EntityCounts;
use super::records::{Record, RecordReader};
use super::style::Layers;
use super::text::decode_text;
use crate::Problem;

/// A scanned drawing.
#[derive(Default)]
pub(super) struct Drawing<'b> {
    /// The value of `$ACADVER`, such as `AC1015`; empty if absent.
    pub(super) version: String,
    /// The value of `$INSUNITS`; 0 if absent.
    pub(super) unit: i64,
    pub(super) layers: Layers,
    pub(super) blocks: Vec<Block<'b>>,
    block_rows: HashMap<String, u32>,
    /// A reader at the start of each ENTITIES section.
    pub(super) entities: Vec<RecordReader<'b>>,
    /// Number of records per kind inside blocks.
    pub(super) counts: EntityCounts,
}

/// A block: entities that INSERTs place into the drawing.
#[derive(Default)]
pub(super) struct Block<'b> {
    /// The base point; `None` if the block is referenced but not defined.
    pub(super) base: Option<Vector3>,
    pub(super) entities: Vec<Entity<'b>>,
    /// Cached result of [`Drawing::expanded_count`].
    expanded_count: Cell<Option<u64>>,
}

impl<'b> Drawing<'b> {
    /// Scans a file.
    ///
    /// # Errors
    /// When the file has no EOF record, is malformed or exceeds a limit.
    pub(super) fn read(bytes: &'b [u8], limits: &Limits) -> Result<Self, Problem> {
        let mut drawing = Self::default();
        let mut records = RecordReader::new(bytes, limits);
        let mut record = Record::default();
        loop {
            if !records.read(&mut record, |kind, _| kind == b"SECTION")? {
                return Err(missing_eof(bytes));
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

    /// Reads the header, which is one record of variable names, each followed by its value.
    fn read_header(&mut self, record: &Record<'b>) {
        for pair in record.pairs.windows(2).filter(|pair| pair[0].code == 9) {
            match pair[0].text() {
                b"$ACADVER" => self.version = decode_text(pair[1].text()),
                b"$INSUNITS" => self.unit = pair[1].int().unwrap_or(0),
                _ => {}
            }
        }
    }

    fn read_tables(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        while has_more_in_section(records) && records.read(record, |kind, _| kind == b"LAYER")? {
            if record.kind == b"LAYER" {
                self.layers.define(record);
            }
        }
        Ok(())
    }

    fn read_blocks(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        // Entities before the first BLOCK belong to no block; ENDBLK drops them.
        let mut current = Block::default();
        let mut row = None;
        let mut counts = std::mem::take(&mut self.counts);
        let wanted = |kind: &[u8], _| kind == b"BLOCK" || known_kind(kind).is_some();
        while has_more_in_section(records) && records.read(record, wanted)? {
            match record.kind {
                b"BLOCK" => {
                    let name = record.text(2).unwrap_or_default();
                    row = Some(self.block_row(name));
                    current.base = Some(record.vector(10).unwrap_or(Vector3::ZERO));
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

    /// The row of a block by its case-insensitive name. Adds an undefined block if the name is new.
    fn block_row(&mut self, name: &[u8]) -> u32 {
        let key = decode_text(name).to_uppercase();
        if let Some(&row) = self.block_rows.get(&key) {
            return row;
        }
        let row = self.blocks.len() as u32;
        self.blocks.push(Block::default());
        self.block_rows.insert(key, row);
        row
    }

    /// Parses a record to an entity; `None` for an unsupported kind. For a POLYLINE, also reads the
    /// VERTEX records that follow.
    pub(super) fn entity(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
        counts: &mut EntityCounts,
    ) -> Result<Option<Entity<'b>>, Problem> {
        let Some(kind) = known_kind(record.kind) else {
            return Ok(None);
        };
        let shape = match kind {
            "INSERT" => self.insert(record),
            "POLYLINE" => {
                // `read_vertices` reuses the record, so this extracts its values first.
                let flags = record.int(70).unwrap_or(0);
                let plane = match flags & 8 {
                    0 => plane(record),
                    _ => Affine3::scale(1.0, 1.0, 1.0),
                };
                let mut entity = Entity::of(
                    kind,
                    record,
                    &mut self.layers,
                    Shape::Line([Vector3::ZERO; 2]),
                );
                let vertices = read_vertices(records, record, counts)?;
                let is_mesh = flags & (16 | 64) != 0;
                entity.shape = match (entity.shape, vertices) {
                    (broken @ Shape::Broken(..), _) | (_, Err(broken)) => broken,
                    _ if is_mesh => {
                        Shape::Broken(Code::NotDrawn, "meshes are not supported".into())
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
        let at = record.vector(10).unwrap_or(Vector3::ZERO);
        let scale = [41, 42, 43].map(|code| record.real(code).unwrap_or(1.0));
        let rotated = plane(record)
            .after(&Affine3::translation(at))
            .after(&Affine3::rotation(record.real(50).unwrap_or(0.0)));
        let step = |code| record.real(code).unwrap_or(0.0);
        let cells = |code| record.int(code).unwrap_or(1).clamp(1, i64::from(u32::MAX)) as u32;
        Shape::Insert(Box::new(Insert {
            block,
            transform: rotated.after(&Affine3::scale(scale[0], scale[1], scale[2])),
            steps: [
                rotated.direction(Vector3::new(step(44), 0.0, 0.0)),
                rotated.direction(Vector3::new(0.0, step(45), 0.0)),
            ],
            columns: cells(70),
            rows: cells(71),
        }))
    }

    /// Number of entities that one INSERT of a block expands to, all nested blocks included.
    /// `u64::MAX` if the block contains itself or nests more than `depth` levels deep.
    pub(super) fn expanded_count(&self, row: u32, depth: usize) -> u64 {
        let block = &self.blocks[row as usize];
        if let Some(count) = block.expanded_count.get() {
            return count;
        }
        // A visit of the same block during the recursion means that it contains itself.
        block.expanded_count.set(Some(u64::MAX));
        if depth == 0 {
            return u64::MAX;
        }
        let of_inner = |inner| self.expanded_count(inner, depth - 1);
        let entities = block.entities.iter();
        let counts = entities.map(|entity| entity.expanded_count(of_inner));
        let sum = counts.fold(1, u64::saturating_add);
        block.expanded_count.set(Some(sum));
        sum
    }
}

/// Whether the current section has another record.
pub(super) fn has_more_in_section(records: &RecordReader<'_>) -> bool {
    !matches!(records.peek(), None | Some(b"ENDSEC" | b"EOF" | b"SECTION"))
}

/// The vertices of a POLYLINE, or the broken shape that replaces it.
type Vertices = Result<Vec<Vertex>, Shape>;

/// Reads the VERTEX records after a POLYLINE.
fn read_vertices<'b>(
    records: &mut RecordReader<'b>,
    record: &mut Record<'b>,
    counts: &mut EntityCounts,
) -> Result<Vertices, Problem> {
    /// Flag of a vertex that is a control point of the spline frame, not of the curve.
    const SPLINE_FRAME: i64 = 16;
    let mut vertices = Vec::new();
    let mut bad_code = None;
    while records.peek() == Some(b"VERTEX") && records.read(record, |_, _| true)? {
        counts.count("VERTEX");
        let position = record.vector(10);
        let bulge = record.real(42).unwrap_or(0.0);
        let flags = record.int(70).unwrap_or(0);
        bad_code = bad_code.or(record.bad_code.get());
        if let Some(position) = position.filter(|_| flags & SPLINE_FRAME == 0) {
            vertices.push(Vertex { position, bulge });
        }
    }
    Ok(match bad_code {
        Some(code) => Err(Shape::Broken(
            Code::WrongType,
            format!("the value of group code {code} of a vertex is not a number"),
        )),
        None => Ok(vertices),
    })
}

fn missing_eof(bytes: &[u8]) -> Problem {
    Problem::Truncated {
        at: bytes.len() as u64,
        detail: "the EOF record at the end of every DXF file is missing".into(),
    }
}
