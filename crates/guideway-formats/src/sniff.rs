//! Format detection: finds the format of a file from its first bytes, regardless of its name.

use crate::Format;
use crate::pair_reader::{PairReader, SENTINEL};
use crate::text::without_mark;
use crate::xml::Prolog;

/// Returns the format that bytes begin to be, or `None` if they match no format.
///
/// | first bytes | format |
/// |---|---|
/// | `ARROW1`, or the marker `FF FF FF FF` of a stream | Arrow |
/// | a group code and `SECTION`, or the binary sentinel | DXF |
/// | `{` | by the first key of the root object that one format uses; else LIF |
/// | `[`, the control character RS, or a line with a topic of MQTT before `{` | by a key of the first object |
/// | `<` | by the name of the root element; else openTCS |
/// | a line that begins with `levels:` | Open-RMF |
///
/// The bytes are UTF-8 and unpacked.
///
/// LIF and openTCS are the fallbacks because their readers report what they found instead.
pub fn sniff(bytes: &[u8]) -> Option<Format> {
    // A stream has no magic; it begins with the continuation marker of its first message.
    if bytes.starts_with(b"ARROW1") || bytes.starts_with(&[0xFF; 4]) {
        return Some(Format::Arrow);
    }
    if is_dxf(bytes) {
        return Some(Format::Dxf);
    }
    let text = without_mark(bytes);
    match text.trim_ascii_start().first()? {
        b'{' => Some(
            root_keys(text)
                .find_map(format_of_key)
                .unwrap_or(Format::Lif),
        ),
        b'<' => Some(match root_tag(text) {
            b"svg" => Format::Svg,
            b"OpenDRIVE" => Format::OpenDrive,
            b"osm" => Format::Lanelet2,
            _ => Format::OpenTcs,
        }),
        _ => match first_of_several(text) {
            Some(object) => {
                let format = root_keys(object).find_map(format_of_key);
                format.filter(|format| matches!(format, Format::GeoJson | Format::Vda5050))
            }
            None => is_rmf(text).then_some(Format::Rmf),
        },
    }
}

/// Tells if bytes begin like a DXF file: with the binary sentinel, or with the first SECTION after
/// optional comments.
fn is_dxf(bytes: &[u8]) -> bool {
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

/// Tells if a text has the top-level YAML key `levels` of buildings and graphs.
fn is_rmf(text: &[u8]) -> bool {
    let mut lines = text.split(|&byte| byte == b'\n');
    lines.any(|line| {
        let rest = line.strip_prefix(b"levels:");
        rest.is_some_and(|rest| matches!(rest.first(), None | Some(b' ' | b'\t' | b'\r' | b'#')))
    })
}

/// Returns `true` if the first key of a root object that one format uses is one of LIF.
pub(crate) fn has_lif_key(bytes: &[u8]) -> bool {
    let text = without_mark(bytes);
    text.trim_ascii_start().starts_with(b"{")
        && root_keys(text).find_map(format_of_key) == Some(Format::Lif)
}

/// Returns the local name of the root element of an XML text; any bytes if the text is not XML.
pub(crate) fn root_tag(text: &[u8]) -> &[u8] {
    let Ok(Prolog { root, .. }) = Prolog::scan(text) else {
        return b"";
    };
    let text = text.get(root + 1..).unwrap_or_default();
    let is_name = |byte: &u8| byte.is_ascii_alphanumeric() || b"-_.:".contains(byte);
    let length = text
        .iter()
        .position(|byte| !is_name(byte))
        .unwrap_or(text.len());
    let name = &text[..length];
    match name.iter().position(|&byte| byte == b':') {
        Some(colon) => &name[colon + 1..],
        None => name,
    }
}

/// Returns the format whose root object has this key, if it is the only one.
pub(crate) fn format_of_key(key: &[u8]) -> Option<Format> {
    match key {
        b"layouts" | b"origins" | b"metaInformation" => Some(Format::Lif),
        b"features" | b"geometry" | b"coordinates" | b"geometries" => Some(Format::GeoJson),
        b"format_version" | b"levels" | b"navigation" => Some(Format::Rmf),
        b"nodes" | b"edges" | b"orderId" | b"orderUpdateId" => Some(Format::Vda5050),
        // Other messages of VDA 5050, and the wrapper of a client of MQTT.
        b"headerId" | b"serialNumber" | b"payload" => Some(Format::Vda5050),
        _ => None,
    }
}

/// Returns the text from the first object of a sequence or an array on.
fn first_of_several(text: &[u8]) -> Option<&[u8]> {
    let at = text.iter().position(|&byte| byte == b'{')?;
    let before = text[..at].trim_ascii();
    let is_topic = is_before_payload(before);
    let is_array = matches!(before, b"[" | b"\x1E" | b"\x1E[");
    (is_array || is_topic).then_some(&text[at..])
}

/// Returns `true` if a text may stand before a message in a line of a log: it has a topic of MQTT,
/// perhaps with a time.
pub(crate) fn is_before_payload(text: &[u8]) -> bool {
    let is_markup = text.starts_with(b"<");
    text.contains(&b'/') && !text.contains(&b'\n') && !is_markup
}

/// Iterates over the keys of the root object of a JSON text, escapes unresolved; any bytes if the
/// text is not JSON.
pub(crate) fn root_keys(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let (mut at, mut depth) = (0, 0_u64);
    std::iter::from_fn(move || {
        while let Some(&byte) = text.get(at) {
            at += 1;
            match byte {
                b'{' | b'[' => depth += 1,
                b'}' | b']' => depth = depth.saturating_sub(1),
                b'"' => {
                    let content = &text[at..];
                    let length = string_length(content);
                    at += length + 1;
                    let after = text.get(at..).unwrap_or_default().trim_ascii_start();
                    if depth == 1 && after.first() == Some(&b':') {
                        return Some(&content[..length]);
                    }
                }
                _ => {}
            }
        }
        None
    })
}

/// Returns the number of bytes before the quote that ends a string.
fn string_length(content: &[u8]) -> usize {
    let mut escaped = false;
    let end = content.iter().position(|&byte| {
        let ends = byte == b'"' && !escaped;
        escaped = byte == b'\\' && !escaped;
        ends
    });
    end.unwrap_or(content.len())
}
