/// A file format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The Layout Interchange Format of the VDMA, 1.0 and 2.0.
    Lif,
    /// A plant model of openTCS, 0.0.2 to 7.0.0.
    OpenTcs,
    /// An order of VDA 5050, 1.1 to 3.1.
    Vda5050,
    /// GeoJSON, plain or a route graph of Nav2.
    GeoJson,
    /// A DXF drawing, ASCII or binary.
    Dxf,
    /// A drawing in SVG.
    Svg,
    /// A building or a navigation graph of Open-RMF.
    Rmf,
    /// Roads of ASAM OpenDRIVE.
    OpenDrive,
    /// A map of Lanelet2.
    Lanelet2,
    /// A table of paths in an Apache Arrow IPC file.
    Arrow,
}

impl Format {
    /// Every format there is.
    pub const ALL: &[Self] = &[
        Self::Lif,
        Self::OpenTcs,
        Self::Vda5050,
        Self::GeoJson,
        Self::Dxf,
        Self::Svg,
        Self::Rmf,
        Self::OpenDrive,
        Self::Lanelet2,
        Self::Arrow,
    ];

    /// The name, as in [`guideway_layout::Provenance::format`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Lif => "LIF",
            Self::OpenTcs => "openTCS",
            Self::Vda5050 => "VDA 5050",
            Self::GeoJson => "GeoJSON",
            Self::Dxf => "DXF",
            Self::Svg => "SVG",
            Self::Rmf => "Open-RMF",
            Self::OpenDrive => "OpenDRIVE",
            Self::Lanelet2 => "Lanelet2",
            Self::Arrow => "Arrow",
        }
    }

    /// The name with what a file of it looks like.
    pub fn description(self) -> &'static str {
        match self {
            Self::Lif => "VDMA LIF 1.0 and 2.0 (JSON)",
            Self::OpenTcs => "openTCS plant models (XML)",
            Self::Vda5050 => "VDA 5050 orders (JSON)",
            Self::GeoJson => "GeoJSON and Nav2 route graphs",
            Self::Dxf => "DXF drawings",
            Self::Svg => "SVG drawings",
            Self::Rmf => "Open-RMF buildings and navigation graphs (YAML)",
            Self::OpenDrive => "OpenDRIVE roads (XML)",
            Self::Lanelet2 => "Lanelet2 maps (OSM XML)",
            Self::Arrow => "Arrow IPC files of paths",
        }
    }
}

/// The only format that the bytes can be of; the file name has no say.
///
/// The first byte tells JSON from XML, and the first telling key of its outermost object tells which JSON
/// it is; of XML, the outermost element. JSON without such a key is taken for LIF, and XML with another
/// element for openTCS. Whether they truly are is for the reader to find, which can then say what it found
/// instead. YAML has no mark: it is what has the key `levels` at the beginning of a line.
pub fn sniff(bytes: &[u8]) -> Option<Format> {
    // A stream has no magic; it begins with the mark that every one of its messages begins with.
    if bytes.starts_with(b"ARROW1") || bytes.starts_with(&[0xFF; 4]) {
        return Some(Format::Arrow);
    }
    if crate::dxf::is_dxf(bytes) {
        return Some(Format::Dxf);
    }
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    match text.trim_ascii_start().first()? {
        b'{' => Some(root_keys(text).find_map(json_of).unwrap_or(Format::Lif)),
        b'<' => Some(match root_tag(text) {
            b"svg" => Format::Svg,
            b"OpenDRIVE" => Format::OpenDrive,
            b"osm" => Format::Lanelet2,
            _ => Format::OpenTcs,
        }),
        _ => crate::rmf::is_rmf(text).then_some(Format::Rmf),
    }
}

/// The name of the outermost element of an XML text, without its prefix. Of text that is no XML, anything.
fn root_tag(mut text: &[u8]) -> &[u8] {
    loop {
        let Some(start) = text.iter().position(|&byte| byte == b'<') else {
            return b"";
        };
        text = &text[start + 1..];
        let end = match text.first() {
            Some(b'?') => "?>",
            Some(b'!') if text.starts_with(b"!--") => "-->",
            // Its declarations hold brackets of both kinds.
            Some(b'!')
                if text
                    .split(|&b| b == b'>')
                    .next()
                    .is_some_and(|t| t.contains(&b'[')) =>
            {
                "]"
            }
            Some(b'!') => ">",
            _ => break,
        };
        let found = text
            .windows(end.len())
            .position(|window| window == end.as_bytes());
        text = &text[found.map_or(text.len(), |at| at + end.len())..];
    }
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

/// The format whose root object has a key, if no other's has.
fn json_of(key: &[u8]) -> Option<Format> {
    match key {
        b"layouts" | b"origins" | b"metaInformation" => Some(Format::Lif),
        b"features" | b"geometry" | b"coordinates" | b"geometries" => Some(Format::GeoJson),
        b"nodes" | b"edges" | b"orderId" | b"orderUpdateId" => Some(Format::Vda5050),
        _ => None,
    }
}

/// The keys of the outermost object of a JSON text, escapes as they are. Of text that is no JSON, anything.
fn root_keys(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let (mut at, mut depth) = (0, 0_u64);
    std::iter::from_fn(move || {
        while let Some(&byte) = text.get(at) {
            at += 1;
            match byte {
                b'{' | b'[' => depth += 1,
                b'}' | b']' => depth = depth.saturating_sub(1),
                b'"' => {
                    let content = &text[at..];
                    let length = text_length(content);
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

/// Bytes up to the quote that ends a text.
fn text_length(content: &[u8]) -> usize {
    let mut escaped = false;
    let end = content.iter().position(|&byte| {
        let ends = byte == b'"' && !escaped;
        escaped = byte == b'\\' && !escaped;
        ends
    });
    end.unwrap_or(content.len())
}
