//! Scans a file once: reads header variables, layers and blocks, and notes the offset of each
//! ENTITIES section. The entities themselves are read later, one at a time.

use std::cell::Cell;
use std::collections::HashMap;

use guideway_layout::{Code, Limits};

use super::affine3::{Affine3, Vector3};
use super::clips::Clips;
use super::entity::{Entity, known_kind, shape};
use super::entity_counts::EntityCounts;
use super::header::UnitVariables;
use super::records::{Record, RecordReader};
use super::shape::{Insert, Polyline, Shape, Vertex, plane};
use super::style::Layers;
use super::text::TextDecoder;
use crate::Problem;
use crate::pair_reader::{Pair, StrayLines};

/// A scanned drawing.
#[derive(Default)]
pub(super) struct Drawing<'b> {
    /// The value of `$ACADVER`, such as `AC1015`; empty if absent.
    pub(super) version: String,
    /// The variables that tell the unit.
    pub(super) units: UnitVariables,
    /// The value of `$DWGCODEPAGE`.
    pub(super) code_page: Option<&'b [u8]>,
    pub(super) layers: Layers,
    pub(super) blocks: Vec<Block<'b>>,
    block_rows: HashMap<String, u32>,
    /// A reader at the start of each ENTITIES section.
    pub(super) entities: Vec<RecordReader<'b>>,
    /// Number of records per kind inside blocks.
    pub(super) counts: EntityCounts,
    /// Boundaries that clip references to blocks.
    pub(super) clips: Clips<'b>,
    /// The reason why the file is not read to its end.
    pub(super) cut: Option<Cut>,
    /// The lines of an ASCII file that are no part of a pair.
    pub(super) stray: Option<StrayLines>,
}

/// A record outside of sections.
enum Section {
    More,
    Last,
    /// The file has no more records.
    Missing,
}

/// Flags of a block that stands for another drawing, attached or overlaid.
const EXTERNAL: i64 = 4 | 8;

/// The reason why a file is not read to its end.
pub(super) enum Cut {
    /// The EOF record is missing.
    NoEnd,
    /// A binary file is damaged.
    Damage(Problem),
}

/// A block: entities that INSERTs place into the drawing.
#[derive(Default)]
pub(super) struct Block<'b> {
    /// The base point; `None` if the block is referenced but not defined.
    pub(super) base: Option<Vector3>,
    /// The file of the drawing that the block stands for, if it is an external reference.
    pub(super) external: Option<&'b [u8]>,
    /// The name, as first written.
    pub(super) name: String,
    pub(super) entities: Vec<Entity<'b>>,
    /// Cached result of [`Drawing::expanded_count`].
    expanded_count: Cell<Option<u64>>,
}

impl<'b> Drawing<'b> {
    /// Scans a file.
    ///
    /// # Errors
    /// When the file ends or is damaged before its entities, is malformed or exceeds a limit.
    pub(super) fn read(bytes: &'b [u8], limits: &Limits) -> Result<Self, Problem> {
        let mut drawing = Self::default();
        let mut records = RecordReader::new(bytes, limits);
        let mut record = Record::default();
        loop {
            let cut = match drawing.read_section(&mut records, &mut record, bytes) {
                Ok(Section::More) => continue,
                Ok(Section::Last) => break,
                Ok(Section::Missing) if drawing.entities.is_empty() => {
                    return Err(missing_eof(bytes));
                }
                Ok(Section::Missing) => Cut::NoEnd,
                Err(damage @ Problem::Damaged { .. }) if !drawing.entities.is_empty() => {
                    Cut::Damage(damage)
                }
                Err(problem) => return Err(problem),
            };
            drawing.cut = Some(cut);
            break;
        }
        drawing.stray = records.stray();
        Ok(drawing)
    }

    /// Reads the next record outside of sections, with the section that it begins.
    fn read_section(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
        bytes: &'b [u8],
    ) -> Result<Section, Problem> {
        if !records.read(record, |kind, _| kind == b"SECTION")? {
            return Ok(Section::Missing);
        }
        let section = match record.kind {
            b"EOF" => return Ok(Section::Last),
            b"SECTION" => record.text(2).unwrap_or_default(),
            _ => return Ok(Section::More),
        };
        match section {
            b"HEADER" => {
                self.read_header(record);
                self.layers.texts = TextDecoder::new(&self.version, self.code_page, bytes);
            }
            b"TABLES" => self.read_tables(records, record)?,
            b"BLOCKS" => self.read_blocks(records, record)?,
            b"ENTITIES" => self.entities.push(*records),
            b"OBJECTS" => self.clips.read(records, record)?,
            _ => {}
        }
        Ok(Section::More)
    }

    /// Reads the header, which is one record of variable names, each followed by its value.
    fn read_header(&mut self, record: &Record<'b>) {
        for pair in record.pairs.windows(2).filter(|pair| pair[0].code == 9) {
            match pair[0].text() {
                b"$ACADVER" => {
                    self.version = String::from_utf8_lossy(pair[1].text()).into_owned();
                }
                b"$DWGCODEPAGE" => self.code_page = Some(pair[1].text()),
                b"$INSUNITS" => self.units.insertion = pair[1].int().unwrap_or(0),
                b"$LUNITS" => self.units.display = pair[1].int(),
                b"$MEASUREMENT" => self.units.measurement = pair[1].int(),
                _ => {}
            }
        }
    }

    fn read_tables(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        while records.has_more_in_section() && records.read(record, |kind, _| kind == b"LAYER")? {
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
        while records.has_more_in_section() && records.read(record, wanted)? {
            match record.kind {
                b"BLOCK" => {
                    let name = record.text(2).unwrap_or_default();
                    row = Some(self.block_row(name));
                    current.base = Some(record.vector(10).unwrap_or(Vector3::ZERO));
                    let is_external = record.int(70).unwrap_or(0) & EXTERNAL != 0;
                    current.external = record.text(1).filter(|_| is_external);
                }
                b"ENDBLK" => {
                    let mut block = std::mem::take(&mut current);
                    if let Some(row) = row.take() {
                        block.name = std::mem::take(&mut self.blocks[row as usize].name);
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
        let name = self.layers.texts.decode(name);
        let key = name.to_uppercase();
        if let Some(&row) = self.block_rows.get(&key) {
            return row;
        }
        let row = self.blocks.len() as u32;
        self.blocks.push(Block {
            name,
            ..Block::default()
        });
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
            other => {
                // A HELIX is a spline, and after that the turns that it was made from.
                let pairs = &record.pairs;
                let helix = |pair: &Pair<'_>| pair.code == 100 && pair.text() == b"AcDbHelix";
                let turns = pairs.iter().position(helix);
                record.pairs.truncate(turns.unwrap_or(usize::MAX));
                shape(other, record, &self.layers.texts)
            }
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
