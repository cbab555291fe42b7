//! Drawings of CAD programs in DXF, ASCII and binary: any unit, y up.
//!
//! Read by a tokenizer of its own rather than by a library: what is not drawn must be named, and not a
//! value may be believed before it was bounded.

mod draw;
mod drawing;
mod entity;
mod pairs;
mod records;
mod shapes;
mod space;
mod style;
mod write;
mod write_frame;
mod write_pairs;

pub use self::write::write_layout;

use std::collections::HashSet;

use guideway_layout::{Code, Layout, Place};

use self::draw::{Around, Painter};
use self::drawing::{Counts, Drawing, section_goes_on};
use self::entity::known_kind;
use self::pairs::{Pairs, SENTINEL};
use self::records::{Record, Records};
use self::space::Affine;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn};
use crate::source::Source;

/// Names and layers of what references make are repeated in the layout, so even a small file may have much text.
const LEAST_TEXT_FOR_BYTES: usize = 4 << 20;

/// Whether bytes begin as a drawing does: by the sentinel of binary files, or by the first section, perhaps
/// after comments.
pub(crate) fn is_dxf(bytes: &[u8]) -> bool {
    if bytes.starts_with(SENTINEL) {
        return true;
    }
    let mut pairs = Pairs::new(bytes);
    while let Ok(Some(pair)) = pairs.next() {
        if pair.code != 999 {
            return pair.code == 0 && pair.text() == b"SECTION";
        }
    }
    false
}

/// Reads a drawing.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let limits = &source.options.limits;
    let mut drawing = Drawing::read(bytes, limits).map_err(|p| source.fail(p))?;
    source.check_cancelled()?;
    let mut builder = Builder::new(source, bytes.len().max(LEAST_TEXT_FOR_BYTES));
    let unit_m = unit(&mut builder, drawing.unit);
    let is_binary = Records::new(bytes, limits).is_binary();
    let provenance = &mut builder.layout.provenance;
    crate::Format::Dxf.name().clone_into(&mut provenance.format);
    provenance.format_version = release(&drawing.version, is_binary);

    let mut counts = Counts::default();
    let mut layers = HashSet::new();
    let mut painter = Painter::new(builder, bytes.len());
    let around = Around {
        map: Affine::scale(unit_m, unit_m, unit_m),
        layer: None,
        color: 0,
        handles: "",
        depth: 0,
    };
    let wanted = |kind: &[u8], code| code == 8 || known_kind(kind).is_some();
    for mut records in std::mem::take(&mut drawing.entities) {
        let mut record = Record::default();
        let mut at = records.position();
        while section_goes_on(&records) {
            let read = records.read(&mut record, wanted);
            read.map_err(|p| source.fail(p))?;
            counts.add(record.kind);
            layers.insert(record.text(8).unwrap_or_default());
            let entity = drawing.entity(&mut records, &mut record, &mut counts);
            if let Some(entity) = entity.map_err(|p| source.fail(p))? {
                painter.draw(&drawing, &entity, &around)?;
            }
            let before = std::mem::replace(&mut at, records.position());
            painter.builder.advance(at - before)?;
        }
    }
    let (mut builder, colors) = (painter.builder, painter.colors);
    if colors.iter().any(|&color| color != 0) {
        builder.layout.paths.set_color_rgba(colors);
    }
    report_others(&mut builder, "ENTITIES", &counts);
    report_others(&mut builder, "BLOCKS", &drawing.counts);
    let blocks = drawing.counts.0.into_iter();
    let blocks = blocks.map(|(kind, count)| (format!("{kind} in blocks"), count));
    let mut all = counts.0;
    all.extend(blocks);
    all.push(("layers".to_owned(), layers.len() as u64));
    builder.layout.provenance.counts = all;
    Ok(builder.layout)
}

/// Says how many entities there are of each kind that is not read.
fn report_others(builder: &mut Builder<'_>, section: &str, counts: &Counts) {
    for (kind, count) in &counts.0 {
        if known_kind(kind.as_bytes()).is_none() && kind != "VERTEX" {
            let at: PlaceFn<'_> = &|| Place::element(section);
            let message = || format!("entities of the kind {kind}: {count}");
            let remedy =
                "They are left out: what is read are lines, arcs, ellipses, splines and blocks";
            builder.report(Code::NotDrawn, at, message, remedy);
        }
    }
}

/// Meters of the units of `$INSUNITS`, as the DXF reference numbers them; 0 is no unit.
const UNITS_M: [f64; 25] = [
    0.0,
    0.0254,
    0.3048,
    1_609.344,
    1e-3,
    1e-2,
    1.0,
    1e3,
    0.0254e-6,
    0.0254e-3,
    0.9144,
    1e-10,
    1e-9,
    1e-6,
    0.1,
    10.0,
    100.0,
    1e9,
    149_597_870_700.0,
    9_460_730_472_580_800.0,
    3.085_677_581_491_367e16,
    // Of the survey of the United States: foot, inch, yard, mile.
    1_200.0 / 3_937.0,
    100.0 / 3_937.0,
    3_600.0 / 3_937.0,
    6_336_000.0 / 3_937.0,
];

fn unit(builder: &mut Builder<'_>, code: i64) -> f64 {
    let known = usize::try_from(code)
        .ok()
        .and_then(|code| UNITS_M.get(code));
    if let Some(&unit_m) = known.filter(|_| code != 0) {
        return unit_m;
    }
    let at = || Place::element("$INSUNITS");
    let message =
        || format!("the unit is {code}, which is none: positions are read as millimeters");
    let remedy = "If that is wrong, set the unit of the drawing in the CAD program";
    builder.report(Code::AssumedUnit, &at, message, remedy);
    1e-3
}

/// The name of a release for people, with that in the file.
fn release(version: &str, is_binary: bool) -> String {
    const RELEASES: &[(&str, &str)] = &[
        ("AC1006", "R10"),
        ("AC1009", "R12"),
        ("AC1012", "R13"),
        ("AC1014", "R14"),
        ("AC1015", "2000"),
        ("AC1018", "2004"),
        ("AC1021", "2007"),
        ("AC1024", "2010"),
        ("AC1027", "2013"),
        ("AC1032", "2018"),
    ];
    let known = RELEASES.iter().find(|(code, _)| *code == version);
    let name = match known {
        Some((code, name)) => format!("{name} ({code})"),
        None => version.chars().take(16).collect(),
    };
    match is_binary {
        true => format!("{name} binary").trim().to_owned(),
        false => name,
    }
}
