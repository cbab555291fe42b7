//! What a drawing has to have around its entities so that CAD programs open it: header, tables, blocks and
//! objects, each by the DXF reference, and no more than must be.

use std::io::{self, Write};

use super::write::APPLICATION;
use super::write_pairs::{MODEL_SPACE, Pairs};

/// Handles: of tables and their records, then of layers, then of entities.
const PAPER_SPACE: u64 = 0x1B;
const ROOT: u64 = 0xC;
const GROUPS: u64 = 0xD;
const FIRST_TABLE: u64 = 0x1;
const FIRST_RECORD: u64 = 0x20;
const BLOCKS: u64 = 0x30;
const FIRST_LAYER: u64 = 0x100;

/// Everything before the first entity. There are `most_entities` to come at most.
pub(super) fn write_start<W: Write>(
    pairs: &mut Pairs<'_, W>,
    layers: &[String],
    most_entities: u64,
) -> io::Result<()> {
    let first_handle = FIRST_LAYER + layers.len() as u64;
    begin_section(pairs, "HEADER")?;
    pairs.text(9, "$ACADVER")?;
    pairs.text(1, "AC1021")?;
    pairs.text(9, "$DWGCODEPAGE")?;
    pairs.text(3, "ANSI_1252")?;
    pairs.text(9, "$HANDSEED")?;
    pairs.handle(5, first_handle + most_entities)?;
    // Meters, by the metric defaults.
    pairs.text(9, "$INSUNITS")?;
    pairs.whole(70, 6)?;
    pairs.text(9, "$MEASUREMENT")?;
    pairs.whole(70, 1)?;
    end_section(pairs)?;

    begin_section(pairs, "TABLES")?;
    write_tables(pairs, layers)?;
    end_section(pairs)?;

    begin_section(pairs, "BLOCKS")?;
    for (i, (owner, name)) in SPACES.into_iter().enumerate() {
        let handle = BLOCKS + 2 * i as u64;
        for (kind, class, handle) in [
            ("BLOCK", "AcDbBlockBegin", handle),
            ("ENDBLK", "AcDbBlockEnd", handle + 1),
        ] {
            pairs.text(0, kind)?;
            pairs.handle(5, handle)?;
            pairs.handle(330, owner)?;
            pairs.text(100, "AcDbEntity")?;
            if owner == PAPER_SPACE {
                pairs.whole(67, 1)?;
            }
            pairs.text(8, "0")?;
            pairs.text(100, class)?;
            if kind == "BLOCK" {
                pairs.text(2, name)?;
                pairs.whole(70, 0)?;
                pairs.point(10, [0.0, 0.0], true)?;
                pairs.text(3, name)?;
                pairs.text(1, "")?;
            }
        }
    }
    end_section(pairs)?;
    pairs.set_next_handle(first_handle);
    begin_section(pairs, "ENTITIES")
}

/// Everything after the last entity.
pub(super) fn write_end<W: Write>(pairs: &mut Pairs<'_, W>) -> io::Result<()> {
    end_section(pairs)?;
    begin_section(pairs, "OBJECTS")?;
    for (handle, owner, entry) in [
        (ROOT, 0, Some(("ACAD_GROUP", GROUPS))),
        (GROUPS, ROOT, None),
    ] {
        pairs.text(0, "DICTIONARY")?;
        pairs.handle(5, handle)?;
        pairs.handle(330, owner)?;
        pairs.text(100, "AcDbDictionary")?;
        pairs.whole(281, 1)?;
        if let Some((name, handle)) = entry {
            pairs.text(3, name)?;
            pairs.handle(350, handle)?;
        }
    }
    end_section(pairs)?;
    pairs.text(0, "EOF")
}

const SPACES: [(u64, &str); 2] = [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")];

/// The tables but that of layers, in the order that programs expect: name, class of a record, records.
const TABLES: [(&str, &str, &[&str]); 9] = [
    ("VPORT", "AcDbViewportTableRecord", &[]),
    (
        "LTYPE",
        "AcDbLinetypeTableRecord",
        &["ByBlock", "ByLayer", "Continuous"],
    ),
    ("LAYER", "AcDbLayerTableRecord", &[]),
    ("STYLE", "AcDbTextStyleTableRecord", &["Standard"]),
    ("VIEW", "AcDbViewTableRecord", &[]),
    ("UCS", "AcDbUCSTableRecord", &[]),
    ("APPID", "AcDbRegAppTableRecord", &["ACAD", APPLICATION]),
    ("DIMSTYLE", "AcDbDimStyleTableRecord", &["Standard"]),
    ("BLOCK_RECORD", "AcDbBlockTableRecord", &[]),
];

fn write_tables<W: Write>(pairs: &mut Pairs<'_, W>, layers: &[String]) -> io::Result<()> {
    let mut handle = FIRST_RECORD;
    for (i, (table, class, names)) in TABLES.into_iter().enumerate() {
        let own = FIRST_TABLE + i as u64;
        let mut records: Vec<(u64, &str)> = Vec::new();
        match table {
            "LAYER" => records.extend((FIRST_LAYER..).zip(layers.iter().map(String::as_str))),
            "BLOCK_RECORD" => records.extend(SPACES),
            _ => records.extend((handle..).zip(names.iter().copied())),
        }
        handle += names.len() as u64;
        pairs.text(0, "TABLE")?;
        pairs.text(2, table)?;
        pairs.handle(5, own)?;
        pairs.handle(330, 0)?;
        pairs.text(100, "AcDbSymbolTable")?;
        pairs.whole(70, records.len() as u64)?;
        if table == "DIMSTYLE" {
            pairs.text(100, "AcDbDimStyleTable")?;
        }
        for (handle, name) in records {
            pairs.text(0, table)?;
            // Of this one table, 5 has another meaning.
            pairs.handle(if table == "DIMSTYLE" { 105 } else { 5 }, handle)?;
            pairs.handle(330, own)?;
            pairs.text(100, "AcDbSymbolTableRecord")?;
            pairs.text(100, class)?;
            pairs.text(2, name)?;
            write_record(pairs, table)?;
        }
        pairs.text(0, "ENDTAB")?;
    }
    Ok(())
}

/// What a record has to have beside its name.
fn write_record<W: Write>(pairs: &mut Pairs<'_, W>, table: &str) -> io::Result<()> {
    match table {
        "LTYPE" => {
            pairs.whole(70, 0)?;
            pairs.text(3, "")?;
            pairs.whole(72, 65)?;
            pairs.whole(73, 0)?;
            pairs.real(40, 0.0)
        }
        "LAYER" => {
            pairs.whole(70, 0)?;
            // Black on paper, white on a screen.
            pairs.whole(62, 7)?;
            pairs.text(6, "Continuous")
        }
        "STYLE" => {
            pairs.whole(70, 0)?;
            pairs.real(40, 0.0)?;
            pairs.real(41, 1.0)?;
            pairs.real(50, 0.0)?;
            pairs.whole(71, 0)?;
            pairs.real(42, 1.0)?;
            pairs.text(3, "txt")?;
            pairs.text(4, "")
        }
        "BLOCK_RECORD" => pairs.handle(340, 0),
        _ => pairs.whole(70, 0),
    }
}

fn begin_section<W: Write>(pairs: &mut Pairs<'_, W>, name: &str) -> io::Result<()> {
    pairs.text(0, "SECTION")?;
    pairs.text(2, name)
}

fn end_section<W: Write>(pairs: &mut Pairs<'_, W>) -> io::Result<()> {
    pairs.text(0, "ENDSEC")
}
