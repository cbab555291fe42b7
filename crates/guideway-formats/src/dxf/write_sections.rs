//! Writes the sections around the entities that CAD programs require: HEADER, TABLES and BLOCKS
//! before them, OBJECTS after them. Source: DXF reference; the minimum that CAD programs require.

use std::io::{self, Write};

use super::pair_writer::{MODEL_SPACE, PairWriter};
use super::xdata::APP_ID;

// Handles are unique per file. Fixed ranges, ascending: tables, objects and spaces, table records,
// blocks, layers; entities follow the layers.
const PAPER_SPACE: u64 = 0x1B;
const ROOT: u64 = 0xC;
const GROUPS: u64 = 0xD;
const FIRST_TABLE: u64 = 0x1;
const FIRST_RECORD: u64 = 0x20;
const BLOCKS: u64 = 0x30;
const FIRST_LAYER: u64 = 0x100;

/// Writes everything before the first entity. At most `max_entities` may follow.
pub(super) fn write_before_entities<W: Write>(
    pairs: &mut PairWriter<'_, W>,
    layers: &[String],
    max_entities: u64,
) -> io::Result<()> {
    let first_handle = FIRST_LAYER + layers.len() as u64;
    begin_section(pairs, "HEADER")?;
    pairs.text(9, "$ACADVER")?;
    pairs.text(1, "AC1021")?;
    pairs.text(9, "$DWGCODEPAGE")?;
    pairs.text(3, "ANSI_1252")?;
    pairs.text(9, "$HANDSEED")?;
    pairs.handle(5, first_handle + max_entities)?;
    // 6 is meters; $MEASUREMENT 1 selects metric hatches and line types.
    pairs.text(9, "$INSUNITS")?;
    pairs.int(70, 6)?;
    pairs.text(9, "$MEASUREMENT")?;
    pairs.int(70, 1)?;
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
                pairs.int(67, 1)?;
            }
            pairs.text(8, "0")?;
            pairs.text(100, class)?;
            if kind == "BLOCK" {
                pairs.text(2, name)?;
                pairs.int(70, 0)?;
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

/// Writes everything after the last entity.
pub(super) fn write_after_entities<W: Write>(pairs: &mut PairWriter<'_, W>) -> io::Result<()> {
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
        pairs.int(281, 1)?;
        if let Some((name, handle)) = entry {
            pairs.text(3, name)?;
            pairs.handle(350, handle)?;
        }
    }
    end_section(pairs)?;
    pairs.text(0, "EOF")
}

/// Handle and name of the two block records that every drawing has.
const SPACES: [(u64, &str); 2] = [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")];

/// The tables in the order that CAD programs expect: name, class of its records, names of its
/// records. LAYER and BLOCK_RECORD get their records at run time.
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
    ("APPID", "AcDbRegAppTableRecord", &["ACAD", APP_ID]),
    ("DIMSTYLE", "AcDbDimStyleTableRecord", &["Standard"]),
    ("BLOCK_RECORD", "AcDbBlockTableRecord", &[]),
];

fn write_tables<W: Write>(pairs: &mut PairWriter<'_, W>, layers: &[String]) -> io::Result<()> {
    let mut handle = FIRST_RECORD;
    for (i, (table, class, names)) in TABLES.into_iter().enumerate() {
        let table_handle = FIRST_TABLE + i as u64;
        let mut records: Vec<(u64, &str)> = Vec::new();
        match table {
            "LAYER" => records.extend((FIRST_LAYER..).zip(layers.iter().map(String::as_str))),
            "BLOCK_RECORD" => records.extend(SPACES),
            _ => records.extend((handle..).zip(names.iter().copied())),
        }
        handle += names.len() as u64;
        pairs.text(0, "TABLE")?;
        pairs.text(2, table)?;
        pairs.handle(5, table_handle)?;
        pairs.handle(330, 0)?;
        pairs.text(100, "AcDbSymbolTable")?;
        pairs.int(70, records.len() as u64)?;
        if table == "DIMSTYLE" {
            pairs.text(100, "AcDbDimStyleTable")?;
        }
        for (handle, name) in records {
            pairs.text(0, table)?;
            // In this table, group code 5 has another meaning.
            pairs.handle(if table == "DIMSTYLE" { 105 } else { 5 }, handle)?;
            pairs.handle(330, table_handle)?;
            pairs.text(100, "AcDbSymbolTableRecord")?;
            pairs.text(100, class)?;
            pairs.text(2, name)?;
            write_record(pairs, table)?;
        }
        pairs.text(0, "ENDTAB")?;
    }
    Ok(())
}

/// Writes the required values of a table record after its name.
fn write_record<W: Write>(pairs: &mut PairWriter<'_, W>, table: &str) -> io::Result<()> {
    match table {
        "LTYPE" => {
            pairs.int(70, 0)?;
            pairs.text(3, "")?;
            pairs.int(72, 65)?;
            pairs.int(73, 0)?;
            pairs.real(40, 0.0)
        }
        "LAYER" => {
            pairs.int(70, 0)?;
            // Color 7: black on paper, white on a screen.
            pairs.int(62, 7)?;
            pairs.text(6, "Continuous")
        }
        "STYLE" => {
            pairs.int(70, 0)?;
            pairs.real(40, 0.0)?;
            pairs.real(41, 1.0)?;
            pairs.real(50, 0.0)?;
            pairs.int(71, 0)?;
            pairs.real(42, 1.0)?;
            pairs.text(3, "txt")?;
            pairs.text(4, "")
        }
        "BLOCK_RECORD" => pairs.handle(340, 0),
        _ => pairs.int(70, 0),
    }
}

fn begin_section<W: Write>(pairs: &mut PairWriter<'_, W>, name: &str) -> io::Result<()> {
    pairs.text(0, "SECTION")?;
    pairs.text(2, name)
}

fn end_section<W: Write>(pairs: &mut PairWriter<'_, W>) -> io::Result<()> {
    pairs.text(0, "ENDSEC")
}
