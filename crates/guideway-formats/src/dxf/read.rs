//! Reads a drawing: walks its ENTITIES sections and fills a layout with paths, colors and counts.

use std::collections::HashSet;

use guideway_layout::{Code, Layout, Place};

use super::affine3::Affine3;
use super::drawing::{Drawing, has_more_in_section};
use super::entity::known_kind;
use super::entity_counts::EntityCounts;
use super::entity_mapper::{EntityMapper, InsertContext};
use super::header::{insertion_unit_m, release_name};
use super::pair_reader::{PairReader, SENTINEL};
use super::records::{Record, RecordReader};
use crate::ReadError;
use crate::builder::{Builder, PlaceFn};
use crate::source::Source;

/// The text budget is at least that of a file of this size: INSERTs repeat layer names and handles,
/// so a small file may legally expand to much text.
const MIN_TEXT_BUDGET_BYTES: usize = 4 << 20;

/// Whether bytes begin like a DXF file: with the binary sentinel, or with the first SECTION after
/// optional comments.
pub(crate) fn is_dxf(bytes: &[u8]) -> bool {
    if bytes.starts_with(SENTINEL) {
        return true;
    }
    let mut pairs = PairReader::new(bytes);
    while let Ok(Some(pair)) = pairs.next() {
        if pair.code != 999 {
            return pair.code == 0 && pair.text() == b"SECTION";
        }
    }
    false
}

/// Reads a drawing into a layout.
///
/// # Errors
/// When the file is truncated, is malformed or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let limits = &source.options.limits;
    let mut drawing = Drawing::read(bytes, limits).map_err(|p| source.fail(p))?;
    source.check_cancelled()?;
    let mut builder = Builder::new(source, bytes.len().max(MIN_TEXT_BUDGET_BYTES));
    let unit_m = insertion_unit_m(&mut builder, drawing.unit);
    let is_binary = RecordReader::new(bytes, limits).is_binary();
    let provenance = &mut builder.layout.provenance;
    crate::Format::Dxf.name().clone_into(&mut provenance.format);
    provenance.format_version = release_name(&drawing.version, is_binary);

    let mut counts = EntityCounts::default();
    let mut layers = HashSet::new();
    let mut mapper = EntityMapper::new(builder, bytes.len());
    let context = InsertContext {
        transform: Affine3::scale(unit_m, unit_m, unit_m),
        layer: None,
        color: 0,
        handle_prefix: "",
        depth: 0,
    };
    let wanted = |kind: &[u8], code| code == 8 || known_kind(kind).is_some();
    for mut records in std::mem::take(&mut drawing.entities) {
        let mut record = Record::default();
        let mut offset = records.position();
        while has_more_in_section(&records) {
            let read = records.read(&mut record, wanted);
            read.map_err(|p| source.fail(p))?;
            counts.add(record.kind);
            layers.insert(record.text(8).unwrap_or_default());
            let entity = drawing.entity(&mut records, &mut record, &mut counts);
            if let Some(entity) = entity.map_err(|p| source.fail(p))? {
                mapper.map_entity(&drawing, &entity, &context)?;
            }
            let before = std::mem::replace(&mut offset, records.position());
            mapper.builder.advance(offset - before)?;
        }
    }
    let (mut builder, colors) = (mapper.builder, mapper.colors);
    if colors.iter().any(|&color| color != 0) {
        builder.layout.paths.set_color_rgba(colors);
    }
    report_skipped(&mut builder, "ENTITIES", &counts);
    report_skipped(&mut builder, "BLOCKS", &drawing.counts);
    let blocks = drawing.counts.0.into_iter();
    let blocks = blocks.map(|(kind, count)| (format!("{kind} in blocks"), count));
    let mut all = counts.0;
    all.extend(blocks);
    all.push(("layers".to_owned(), layers.len() as u64));
    builder.layout.provenance.counts = all;
    Ok(builder.layout)
}

/// Reports the number of entities per unsupported kind.
fn report_skipped(builder: &mut Builder<'_>, section: &str, counts: &EntityCounts) {
    for (kind, count) in &counts.0 {
        if known_kind(kind.as_bytes()).is_none() && kind != "VERTEX" {
            let at: PlaceFn<'_> = &|| Place::element(section);
            let message = || format!("{count} entities of the unsupported kind {kind}");
            let remedy =
                "They are left out; Guideway draws lines, arcs, ellipses, splines and blocks";
            builder.report(Code::NotDrawn, at, message, remedy);
        }
    }
}
