//! Benchmark of Guideway against the fastest known readers of each format.
//!
//! `readers FILE...` reads each file with all readers of its format, alternating and from memory,
//! and prints one line of JSON per file: median times, and megabytes per second.
//!
//! Guideway reads and checks a whole layout: curves, nodes, attributes, findings. Most other
//! readers build a tree of the text or only a list of events; the key `does` states the result of
//! each.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use std::{env, fs};

use anyhow::{Context, Result, anyhow, bail};
use guideway_formats::{Format, ReadOptions, read_bytes, sniff};
use serde_json::{Value, json};

/// Most rounds; the result is their median.
const ROUNDS: usize = 9;
/// No round starts after this time.
const MAX_S: f64 = 20.0;

/// Reads a whole file and drops the result.
type Read = fn(&[u8]) -> Result<()>;

/// A reader under test.
struct Reader {
    name: &'static str,
    /// Result of the reader: layout, drawing, tree, batches or events.
    does: &'static str,
    read: Read,
}

const fn reader(name: &'static str, does: &'static str, read: Read) -> Reader {
    Reader { name, does, read }
}

const GUIDEWAY: Reader = reader("guideway", "layout", |bytes| {
    let layout = read_bytes("file", bytes, &ReadOptions::default());
    black_box(layout.map_err(|error| anyhow!("{error}"))?);
    Ok(())
});

const JSON: &[Reader] = &[
    reader("sonic-rs", "tree", |bytes| {
        black_box(sonic_rs::from_slice::<sonic_rs::Value>(bytes)?);
        Ok(())
    }),
    reader("simd-json", "tree", |bytes| {
        // simd-json modifies its input.
        black_box(simd_json::to_borrowed_value(&mut bytes.to_vec())?);
        Ok(())
    }),
    reader("serde_json", "tree", |bytes| {
        black_box(serde_json::from_slice::<Value>(bytes)?);
        Ok(())
    }),
];

const DXF: &[Reader] = &[reader("dxf", "drawing", |mut bytes| {
    black_box(dxf::Drawing::load(&mut bytes)?);
    Ok(())
})];

const XML: &[Reader] = &[
    reader("quick-xml", "events", |bytes| {
        let mut reader = quick_xml::Reader::from_reader(bytes);
        while !matches!(
            black_box(reader.read_event()?),
            quick_xml::events::Event::Eof
        ) {}
        Ok(())
    }),
    reader("roxmltree", "tree", |bytes| {
        black_box(roxmltree::Document::parse(std::str::from_utf8(bytes)?)?);
        Ok(())
    }),
];

const SVG: &[Reader] = &[reader("usvg", "drawing", |bytes| {
    black_box(usvg::Tree::from_data(bytes, &usvg::Options::default())?);
    Ok(())
})];

const YAML: &[Reader] = &[reader("saphyr-parser", "events", |bytes| {
    let mut parser = saphyr_parser::Parser::new_from_str(std::str::from_utf8(bytes)?);
    while let Some(event) = parser.next_event() {
        black_box(event?);
    }
    Ok(())
})];

const ARROW: &[Reader] = &[reader("arrow-ipc", "batches", |bytes| {
    let reader = arrow_ipc::reader::FileReader::try_new(std::io::Cursor::new(bytes), None)?;
    for batch in reader {
        black_box(batch?);
    }
    Ok(())
})];

fn main() -> Result<()> {
    let files: Vec<String> = env::args().skip(1).collect();
    if files.is_empty() {
        bail!("usage: readers FILE...");
    }
    for file in files {
        println!("{}", compare(Path::new(&file))?);
    }
    Ok(())
}

/// Times of all readers of a file, in rounds that alternate between them.
fn compare(file: &Path) -> Result<Value> {
    let bytes = fs::read(file).with_context(|| file.display().to_string())?;
    let format = sniff(&bytes).with_context(|| format!("{}: unknown format", file.display()))?;
    let others = match format {
        Format::Lif | Format::GeoJson | Format::Vda5050 => JSON,
        Format::Dxf => DXF,
        Format::OpenTcs | Format::OpenDrive | Format::Lanelet2 => XML,
        Format::Svg => SVG,
        Format::Rmf => YAML,
        Format::Arrow => ARROW,
    };
    let readers: Vec<&Reader> = [&GUIDEWAY].into_iter().chain(others).collect();
    let mut times_s = vec![Vec::new(); readers.len()];
    let began = Instant::now();
    for round in 0..ROUNDS {
        if round > 0 && began.elapsed().as_secs_f64() > MAX_S {
            break;
        }
        for (reader, times_s) in readers.iter().zip(&mut times_s) {
            let start = Instant::now();
            if let Err(error) = (reader.read)(&bytes) {
                eprintln!("{} cannot read {}: {error}", reader.name, file.display());
                continue;
            }
            times_s.push(start.elapsed().as_secs_f64());
        }
    }
    let rows = readers.iter().zip(&mut times_s).map(|(reader, times_s)| {
        times_s.sort_by(f64::total_cmp);
        let median_s = times_s.get(times_s.len() / 2);
        json!({
            "reader": reader.name,
            "does": reader.does,
            "rounds": times_s.len(),
            "ms": median_s.map(|s| s * 1e3),
            "mb_per_s": median_s.map(|s| bytes.len() as f64 / s / 1e6),
        })
    });
    Ok(json!({
        "file": file.file_name().map(|name| name.to_string_lossy()),
        "format": format.name(),
        "bytes": bytes.len(),
        "readers": rows.collect::<Value>(),
    }))
}
