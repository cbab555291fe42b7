//! The page of this build: one HTML file with the engine for browsers, into which a layout is put.

use std::io::{self, Write};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use guideway::compose::PageFont;
use guideway::envelope::EnvelopeSource;
use guideway::layout::{Provenance, UserError};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use crate::cli::envelope;
use crate::cli::floor_plan::PackedPlan;
use crate::cli::packed::unpacked;

/// The page without engine and layout, as gzip: `cargo xtask web` makes it.
const PAGE: &[u8] = include_bytes!("../../../page/page.html.gz");
/// The engine that reads Arrow, as gzip.
const ENGINE: &[u8] = include_bytes!("../../../page/engine-arrow.wasm.gz");
/// The places of the page that engine and layout replace.
const ENGINE_PLACE: &str = "<!--ENGINE-->";
const SHARED_PLACE: &str = "<!--SHARED-->";
/// Largest file in a page, packed and as text: browsers hold no longer texts.
const MAX_PACKED_BYTES: usize = 400_000_000;

/// View, colors and decorations in which a page opens: the look of `guideway-web`.
#[derive(Clone, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SharedLook {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) width: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) height: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) center: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) px_per_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) level: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color_by: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) palette: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) range: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) breaks: Option<Vec<f64>>,
    /// The vehicle whose swept areas are shown, as in `--envelope`.
    #[serde(
        skip_serializing_if = "Option::is_none",
        serialize_with = "serialize_vehicle"
    )]
    pub(crate) envelope: Option<EnvelopeSource>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) shade: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) background: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) legend: Option<bool>,
}

fn serialize_vehicle<S: Serializer>(
    vehicle: &Option<EnvelopeSource>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    vehicle.map(envelope::name).serialize(serializer)
}

/// The files that a page holds.
pub(super) struct PageContent<'a> {
    /// The layout as Arrow.
    pub(super) layout: &'a [u8],
    /// The origin of the layout, which Arrow does not hold.
    pub(super) provenance: &'a Provenance,
    /// The floor plan.
    pub(super) plan: Option<&'a PackedPlan>,
    /// The fonts that the layout needs beside that of every page.
    pub(super) fonts: Vec<PageFont>,
}

/// Puts a layout and its floor plan into the page. `name` is the name of the layout's file, by
/// which errors and saved files are named.
///
/// # Errors
/// When layout or plan are larger than a browser can hold.
pub(super) fn page(
    name: &str,
    title: &str,
    look: &SharedLook,
    content: &PageContent<'_>,
) -> Result<Vec<u8>, UserError> {
    let Provenance {
        format,
        format_version,
        ..
    } = content.provenance;
    let mut shared = json!({
        "name": name,
        "title": title,
        "look": look,
        "format": format,
        "formatVersion": format_version,
    });
    let mut files = packed("layout", name, content.layout)?;
    for font in &content.fonts {
        let packed = BASE64_STANDARD.encode(font.packed());
        files += &script("text/plain", font.name(), &packed);
    }
    if let Some(plan) = content.plan {
        shared["floorPlan"] = described(plan);
        files += &packed("floor-plan", &plan.name, &plan.bytes)?;
    }
    // A script must not contain the end of its own element.
    let shared = shared.to_string().replace('<', "\\u003c");
    let engine = script("text/plain", "engine", &BASE64_STANDARD.encode(ENGINE));
    let shared = script("application/json", "shared", &shared);
    let page = unpacked(PAGE, "the page")?;
    let parts = page.split_once(ENGINE_PLACE).and_then(|(head, rest)| {
        let (middle, tail) = rest.split_once(SHARED_PLACE)?;
        Some([head, &engine, middle, &shared, &files, tail].concat())
    });
    let parts = parts.ok_or_else(|| broken("it has no place for a layout"))?;
    Ok(parts.into_bytes())
}

/// Name and placement of a floor plan; the placement of a layout is `null`.
fn described(plan: &PackedPlan) -> Value {
    let placement = plan.placement.map(|placement| {
        json!({
            "pxPerM": placement.px_per_m,
            "rotateDeg": placement.rotate_deg,
            "offset": [placement.offset_m.x, placement.offset_m.y],
        })
    });
    json!({ "name": plan.name, "placement": placement })
}

/// A file as an element of the page.
///
/// # Errors
/// When it is larger than a browser can hold.
fn packed(id: &str, name: &str, bytes: &[u8]) -> Result<String, UserError> {
    let packed = BASE64_STANDARD.encode(pack(bytes));
    if packed.len() > MAX_PACKED_BYTES {
        return Err(UserError::new(
            "limit",
            format!(
                "{name}: the file takes {} bytes in a page, limit {MAX_PACKED_BYTES}",
                packed.len()
            ),
            "Share a part of it, or a picture: `guideway render`",
        ));
    }
    Ok(script("text/plain", id, &packed))
}

fn script(kind: &str, id: &str, content: &str) -> String {
    format!("<script type=\"{kind}\" id=\"{id}\">{content}</script>\n")
}

/// Compresses with gzip, which browsers unpack by themselves.
fn pack(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    let packed: io::Result<Vec<u8>> = encoder.write_all(bytes).and_then(|()| encoder.finish());
    packed.expect("memory takes every byte")
}

fn broken(problem: &str) -> UserError {
    UserError::new(
        "page",
        format!("the page of this build is damaged: {problem}"),
        "Build it again with `cargo xtask web`, and then the command",
    )
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::GzDecoder;

    use super::*;

    #[test]
    fn page_holds_engine_and_layout_and_no_script_of_the_names() {
        let title = "</script><script>alert(1)</script>";
        let content = PageContent {
            layout: b"{}",
            provenance: &Provenance::default(),
            plan: None,
            fonts: PageFont::ALL.to_vec(),
        };
        let made = page("site.json", title, &SharedLook::default(), &content).unwrap();
        let made = String::from_utf8(made).unwrap();
        assert!(!made.contains("alert(1)</script"), "the title is no script");
        assert!(made.contains("connect-src 'none'"));
        let layout = pack(b"{}");
        for (id, content) in [
            ("engine", ENGINE),
            ("layout", &layout),
            ("letters", PageFont::Letters.packed()),
            ("symbols", PageFont::Symbols.packed()),
        ] {
            let start = format!("id=\"{id}\">");
            let (_, rest) = made.split_once(&start).unwrap();
            let (packed, _) = rest.split_once("</script>").unwrap();
            assert_eq!(BASE64_STANDARD.decode(packed).unwrap(), content);
        }
        let mut engine = Vec::new();
        GzDecoder::new(ENGINE).read_to_end(&mut engine).unwrap();
        assert!(engine.starts_with(b"\0asm"));
    }
}
