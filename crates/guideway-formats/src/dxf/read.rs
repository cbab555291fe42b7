//! Reads a drawing: walks its ENTITIES sections and fills a layout with paths, colors and counts.

use std::collections::HashSet;

use guideway_layout::{Code, Layout, Place, Severity};

use super::affine3::Affine3;
use super::drawing::{Cut, Drawing};
use super::entity::known_kind;
use super::entity_counts::EntityCounts;
use super::entity_mapper::{CLIP_REMEDY, EntityMapper, InsertContext};
use super::header::{insertion_unit_m, release_name};
use super::notes::is_note;
use super::records::{Record, RecordReader};
use super::text::is_known_page;
use crate::builder::{Builder, PlaceFn};
use crate::source::Source;
use crate::{Problem, ReadError};

/// The text budget is at least that of a file of this size: INSERTs repeat layer names and handles,
/// so a small file may legally expand to much text.
const MIN_TEXT_BUDGET_BYTES: usize = 4 << 20;

/// Reads a drawing into a layout.
///
/// # Errors
/// When the file is truncated, is malformed or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let limits = &source.options.limits;
    let mut drawing = Drawing::read(bytes, limits).map_err(|p| source.fail(p))?;
    source.check_cancelled()?;
    let mut builder = Builder::new(source, bytes.len().max(MIN_TEXT_BUDGET_BYTES));
    let unit_m = insertion_unit_m(&mut builder, drawing.units);
    report_text(&mut builder, &drawing, bytes);
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
        region: None,
    };
    let wanted = |kind: &[u8], code| code == 8 || known_kind(kind).is_some();
    for mut records in std::mem::take(&mut drawing.entities) {
        let mut record = Record::default();
        let mut offset = records.position();
        while records.has_more_in_section() {
            let read = records.read(&mut record, wanted);
            if matches!(read, Err(Problem::Damaged { .. })) {
                // The scan met it too: `report_cut` reports it.
                break;
            }
            read.map_err(|p| source.fail(p))?;
            counts.add(record.kind);
            layers.insert(record.text(8).unwrap_or_default());
            let entity = drawing.entity(&mut records, &mut record, &mut counts);
            if let Some(entity) = entity.map_err(|p| source.fail(p))? {
                mapper.map_entity(&drawing, &entity, &context)?;
            }
            let before = std::mem::replace(&mut offset, records.position());
            // A file that is cut may end before the place of its last peek.
            mapper.builder.advance(offset.saturating_sub(before))?;
        }
    }
    let (mut builder, colors) = (mapper.builder, mapper.colors);
    if colors.iter().any(|&color| color != 0) {
        builder.layout.paths.set_color_rgba(colors);
    }
    report_cut(&mut builder, &drawing);
    report_lost_clips(&mut builder, drawing.clips.lost);
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

/// Reports a code page that is not known, if a text needs it.
fn report_text(builder: &mut Builder<'_>, drawing: &Drawing<'_>, bytes: &[u8]) {
    let Some(page) = drawing.code_page.filter(|page| !is_known_page(page)) else {
        return;
    };
    if str::from_utf8(bytes).is_ok() {
        return;
    }
    let message = || {
        let page = String::from_utf8_lossy(page);
        format!("the code page `{page}` is not known; texts are read as Windows-1252")
    };
    let remedy = "Names of layers may be wrong; save the drawing in release 2007 or later";
    let at = || Place::element("$DWGCODEPAGE");
    builder.report(Code::UnknownValue, &at, message, remedy);
}

/// Reports that the file is damaged or ends too early, and lines that are no part of a pair.
fn report_cut(builder: &mut Builder<'_>, drawing: &Drawing<'_>) {
    let error = Severity::Error;
    if let Some(stray) = drawing.stray {
        let at = || Place::on_line("the file", stray.first);
        let message = || {
            let others = match stray.count {
                1 => String::new(),
                count => format!(", nor do {} further lines", count - 1),
            };
            format!("the line does not hold a group code, which is an integer{others}")
        };
        let remedy = "It is skipped; perhaps a text has a line break. Export the drawing again";
        builder.report_as(error, Code::WrongType, &at, message, remedy);
    }
    let Some(cut) = &drawing.cut else {
        return;
    };
    let message = || match cut {
        Cut::NoEnd => "the EOF record at the end of every DXF file is missing".to_owned(),
        Cut::Damage(problem) => problem.to_string(),
    };
    let at = || Place::element("the end of the file");
    let remedy = "What comes before is read; copy or export the file again, it may be incomplete";
    builder.report_as(error, Code::MissingField, &at, message, remedy);
}

/// Reports boundaries that clip an unknown reference.
fn report_lost_clips(builder: &mut Builder<'_>, count: u64) {
    if count > 0 {
        let at = || Place::element("OBJECTS");
        let message = || format!("{count} boundaries clip references that are not stated (XCLIP)");
        let warning = Severity::Warning;
        builder.report_as(warning, Code::ApproximateShape, &at, message, CLIP_REMEDY);
    }
}

/// Reports the number of entities per unsupported kind.
fn report_skipped(builder: &mut Builder<'_>, section: &str, counts: &EntityCounts) {
    for (kind, count) in &counts.0 {
        let is_drawn = known_kind(kind.as_bytes()).is_some() && !is_note(kind);
        if !is_drawn && kind != "VERTEX" {
            let at: PlaceFn<'_> = &|| Place::element(section);
            let message = || format!("{count} entities of the unsupported kind {kind}");
            let remedy = match is_note(kind) {
                true => "They are not drawn; `guideway network` names stations after them",
                false => {
                    "They are left out; Guideway draws lines, arcs, splines, outlines of areas and \
                     blocks"
                }
            };
            builder.report(Code::NotDrawn, at, message, remedy);
        }
    }
}
